/// Convex bodies of all shapes that end somewhere, anywhere near the origin.
#pragma once

#include <cmath>

#include "scene/confines.h"
#include "tests/support/random.h"

namespace prehensile::testing {

inline BodyShape any_body_shape(Random& random) {
  switch (random.below(5)) {
    case 0:
      return BoxShape{{random.in(0.01, 0.1), random.in(0.01, 0.1), random.in(0.01, 0.1)}};
    case 1:
      return SphereShape{random.in(0.005, 0.05)};
    case 2:
      return CylinderShape{random.in(0.005, 0.05), random.in(0.01, 0.1),
                           static_cast<Axis>(random.below(3))};
    case 3:
      return CapsuleShape{random.in(0.005, 0.05), random.in(0.01, 0.1),
                          static_cast<Axis>(random.below(3))};
    default: {
      PrismShape prism{{}, random.in(0.01, 0.1), static_cast<Axis>(random.below(3))};
      for (int i = 0; i < 5; ++i) {
        prism.outline.push_back(rotated(1.2566 * i, {random.in(0.04, 0.05), 0.0}));
      }
      return prism;
    }
  }
}

inline ConvexBody any_body(Random& random) {
  ConvexBody body{.name = "body", .shape = any_body_shape(random)};
  for (int i = 0; i < 3; ++i) body.position[i] = random.in(-0.1, 0.1);
  const double half = random.in(-3.0, 3.0);
  const double tilt = random.in(-3.0, 3.0);
  body.quaternion = {std::sin(half) * std::cos(tilt), std::sin(half) * std::sin(tilt),
                     0.0, std::cos(half)};
  body.turn = random.in(-3.0, 3.0);
  return body;
}

}  // namespace prehensile::testing
