/// What rolls of round and of prismatic objects share: whether lines of contact keep the
/// object from tilting and yawing, and where along them they press. Internal to the
/// rolls.
#pragma once

#include <array>

#include "mechanics/model.h"
#include "primitives/push.h"

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

/// Where the support's resultant acts, as `low` and `high` [m]: in the middle of its line
/// if the jaws can balance that, else as near to it as they can. NaN if no place does.
double support_place(const RollLoads& loads) noexcept;

/// `low` and `high` of the support, and the arm of the weight.
void add_support(const Model& model, const PushContact& contact, const Grasp& grasp,
                 RollLoads& loads) noexcept;

/// A roll of Model::cross_section in its section, with the grip of the roll.
struct SectionRoll {
  CrossSectionModel section;
  CrossSectionDrive drive;
};
SectionRoll section_roll(const Model& model, const Roll& roll, double weight) noexcept;

/// Of a cylinder at an instant of its section.
RollLoads cylinder_loads(const Model& model, const PushContact& contact,
                         const Grasp& grasp, const CrossSectionInstant& instant,
                         double weight) noexcept;

}  // namespace prehensile
