/// Random numbers for tests: the same on every machine and in every order of tests.
#pragma once

#include <cmath>
#include <numbers>

#include "problems/random_stream.h"
#include "scene/frames.h"

namespace prehensile::testing {

/// The stream of the problem sets, with vectors.
class Random : public RandomStream {
 public:
  using RandomStream::RandomStream;

  Vec2 direction() {
    return rotated(in(-std::numbers::pi, std::numbers::pi), {1.0, 0.0});
  }

  Vec2 in_disc(double radius) { return radius * std::sqrt(in(0.0, 1.0)) * direction(); }

  Vec2 in_box(double half_x, double half_y) {
    const double x = in(-half_x, half_x);
    return {x, in(-half_y, half_y)};
  }
};

}  // namespace prehensile::testing
