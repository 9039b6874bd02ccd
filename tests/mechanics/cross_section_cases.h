/// Random cross-sections that several tests share.
#pragma once

#include <algorithm>
#include <array>

#include "mechanics/cross_section.h"
#include "tests/support/random.h"

namespace prehensile::testing {

inline constexpr std::array kJawModes = {JawMode::kCoupled, JawMode::kFixedJaw1,
                                         JawMode::kFixedJaw2};

inline double units_of_force(const CrossSectionModel& model,
                             const CrossSectionDrive& drive) {
  return std::max(2.0 * model.grip_force, std::abs(drive.weight));
}

/// Sections of every kind: lifted, weightless, frictionless, locked, ungripped.
struct AnySection {
  CrossSectionModel model;
  CrossSectionDrive drive;

  explicit AnySection(Random& random) {
    const auto friction = [&](double high) {
      return random.chance(0.1) ? 0.0 : random.in(0.0, high);
    };
    model.radius = random.log_in(1e-3, 0.1);
    model.grip_force = random.chance(0.05) ? 0.0 : random.log_in(0.02, 200.0);
    model.friction = {friction(2.0), friction(2.0)};
    if (random.chance(0.3)) model.friction[1] = model.friction[0];
    model.jaw_mode = kJawModes[random.below(3)];
    drive.mu = friction(3.0);
    drive.sheet_rate = random.log_in(1e-4, 10.0) * (random.chance(0.5) ? 1.0 : -1.0);
    drive.weight = random.log_in(0.02, 200.0) * (random.chance(0.3) ? -1.0 : 1.0);
    if (random.chance(0.05)) drive.weight = 0.0;
  }
};

}  // namespace prehensile::testing
