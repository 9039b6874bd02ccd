/// Sections of prisms for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/scene.h"
#include "tests/support/random.h"

namespace prehensile::testing {

/// Regular, with flat sides at the bottom; inner radius [m].
inline std::vector<Vec2> regular_section(int sides, double inner) {
  const double step = 2.0 * std::numbers::pi / sides;
  std::vector<Vec2> section;
  for (int i = 0; i < sides; ++i) {
    const double angle = -0.5 * std::numbers::pi + (i + 0.5) * step;
    section.push_back(rotated(angle, {inner / std::cos(0.5 * step), 0.0}));
  }
  return section;
}

/// Corners on an ellipse in order of their angles: convex, counter-clockwise.
inline std::vector<Vec2> any_convex_section(Random& random) {
  const int sides = 3 + random.below(8);
  std::vector<double> angles;
  double angle = random.in(0.0, 1.0);
  for (int i = 0; i < sides; ++i) {
    angles.push_back(angle);
    angle += random.in(0.4, 1.6);
  }
  const double scale = 2.0 * std::numbers::pi / (angle - angles.front());
  const Vec2 axes(random.in(0.01, 0.03), random.in(0.01, 0.03));
  std::vector<Vec2> section;
  for (const double a : angles) {
    const double turned = angles.front() + (a - angles.front()) * scale;
    section.push_back({axes.x() * std::cos(turned), axes.y() * std::sin(turned)});
  }
  return section;
}

}  // namespace prehensile::testing
