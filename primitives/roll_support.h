/// What rolls of round and of prismatic objects share: whether lines of contact keep the
/// object from tilting and yawing. Internal to roll.cpp and roll_prism.cpp.
#pragma once

#include <array>

#include "mechanics/model.h"

namespace prehensile {

/// Resultant of each contact (by CrossSectionContact) and how far along the object's axis
/// it can act.
struct RollLoads {
  std::array<double, 3> along_z;  ///< [N] on the object
  std::array<double, 3> along_u;  ///< [N]
  std::array<double, 3> low;      ///< [m] along t of the contact, from the finger axis
  std::array<double, 3> high;     ///< [m]
  double weight = 0.0;            ///< [N] along -u
  double arm_of_weight = 0.0;     ///< [m] of the centre of mass, as low and high
  double length = 0.0;            ///< [m] of the object: unit
};

/// Whether places of the resultants exist such that the moments about z and about n
/// vanish.
bool lines_suffice(const RollLoads& loads) noexcept;

/// `low` and `high` of the support, and the arm of the weight.
void add_support(const Model& model, const PushContact& contact, const Grasp& grasp,
                 RollLoads& loads) noexcept;

}  // namespace prehensile
