/// Rolling in the cross-section of a round object between flat jaws (paper section
/// VII-C).
///
/// The section is cut across the object's long axis: z along the closing direction, u
/// along the normal of the support ("sheet") into the object. Unknown motion (v_z, v_u,
/// roll rate, jaw rate); three contacts, each open, sticking or slipping either way: 64
/// combinations, all examined, so that the answer comes with its verdict on uniqueness.
///
/// Signs. Jaw 1 touches at z = -r and pushes along +z, jaw 2 at z = +r and pushes along
/// -z, the sheet touches at u = -r and pushes along +u. A positive roll rate turns z
/// towards u; the surface that touches the sheet then moves along +z, so a sheet that
/// moves along +z rolls the object at +rate / r. The sheet drags the object towards the
/// downstream jaw: jaw 2 if it moves along +z, jaw 1 otherwise. A positive jaw rate
/// closes.
///
/// Everything is taken in the quasi-static limit, where the balance of forces knows
/// nothing of the rates: the motions that a combination of modes allows and the forces
/// that it allows are two polyhedra that do not see each other.
#pragma once

#include <array>
#include <string_view>

#include "mechanics/instant.h"
#include "scene/scene.h"

namespace prehensile {

/// Constants of the cross-section.
struct CrossSectionModel {
  double radius = 0.0;                          ///< [m], > 0
  double mass = 0.0;                            ///< [kg]
  double grip_force = 0.0;                      ///< [N] per finger, >= 0
  std::array<double, 2> friction = {0.0, 0.0};  ///< of jaw 1 and jaw 2, >= 0
  JawMode jaw_mode = JawMode::kCoupled;
};

/// The support that moves along the closing direction.
struct CrossSectionDrive {
  double mu = 0.0;          ///< friction of the support, >= 0
  double sheet_rate = 0.0;  ///< [m/s] along +z, not zero
  double weight = 0.0;      ///< [N] gravity along -u: positive presses on the support,
                            ///< negative lifts off it
};

enum CrossSectionContact { kJaw1 = 0, kJaw2 = 1, kSheet = 2 };

struct CrossSectionMotion {
  double v_z = kNan;        ///< [m/s] of the axis
  double v_u = kNan;        ///< [m/s] of the axis
  double roll_rate = kNan;  ///< [rad/s]
  double jaw_rate = kNan;   ///< [m/s] closing
};

/// Forces on the object by CrossSectionContact.
struct CrossSectionForces {
  std::array<double, 3> normal{kNan, kNan, kNan};  ///< [N], >= 0
  std::array<double, 3> tangential{kNan, kNan,
                                   kNan};  ///< [N]; jaws along u, sheet along z
};

/// Statuses: kMoves, kHolds (the object stands still, the sheet slides under it),
/// kNonuniqueForces, kAmbiguous, kDynamic, kJammed, kBadInput; kOutOfIterations only if a
/// linear programme was lost to rounding.
struct CrossSectionInstant {
  InstantStatus status = InstantStatus::kNotRun;
  double v_z = kNan;                                     ///< [m/s]
  double v_u = kNan;                                     ///< [m/s]
  double roll_rate = kNan;                               ///< [rad/s]
  double jaw_rate = kNan;                                ///< [m/s] closing
  std::array<double, 3> normal_force{kNan, kNan, kNan};  ///< [N] by CrossSectionContact
  std::array<double, 3> tangential_force{kNan, kNan, kNan};  ///< [N]; jaws along u, sheet
                                                             ///< along z; on the object
  /// By the motion: open if the gap grows, else stick or slip by the sign of the rate of
  /// the object relative to the contact, along u at the jaws and along z at the sheet.
  std::array<ContactMode, 3> mode{ContactMode::kOpen, ContactMode::kOpen,
                                  ContactMode::kOpen};
  double push_force = kNan;  ///< |force of the sheet on the object| [N]

  /// Range of the sheet's normal force over all force solutions at this motion [N]; the
  /// forces above are from its middle. The upper end is infinite if jaw and sheet can
  /// wedge the object between them; the forces above are then from the lower end.
  double sheet_force_low = kNan;
  double sheet_force_high = kNan;

  /// Distinct motions among all solutions; a continuum of motions counts as two.
  int motions_found = 0;

  /// kAmbiguous: a second motion and its forces, which also satisfy every law.
  CrossSectionMotion other;
  CrossSectionForces other_forces;

  /// kDynamic: a motion off the sheet that no force of the jaws opposes while gravity and
  /// grip gain power from it: the object falls.
  CrossSectionMotion evidence;
  /// kJammed: forces that balance without gravity and grip and take power from the sheet,
  /// which wedges the object against the fixed jaw.
  /// Both are signatures; the proof is that none of the 64 combinations has a solution.
  CrossSectionForces evidence_forces;

  CrossSectionMotion motion() const { return {v_z, v_u, roll_rate, jaw_rate}; }
  CrossSectionForces forces() const { return {normal_force, tangential_force}; }
};

/// All solutions in the quasi-static limit. No heap, no exceptions. kBadInput for jaws
/// that are locked or driven independently: they do not have one jaw rate.
CrossSectionInstant solve_cross_section(const CrossSectionModel& model,
                                        const CrossSectionDrive& drive) noexcept;

/// Largest violation of balance, cones, complementarity and slip directions by an answer,
/// and of what its status claims, dimensionless (units: greater of twice the grip force
/// and the weight, sheet rate, radius); derived independently of the solver. NaN for an
/// answer without claim (kNotRun, kOutOfIterations, kBadInput).
double cross_section_residual(const CrossSectionModel& model,
                              const CrossSectionDrive& drive,
                              const CrossSectionInstant& answer) noexcept;

/// Least friction of the support for which the object can roll: traction of the jaws over
/// the load on the sheet, both in closed form. Infinite if no friction suffices: the
/// downstream jaw has friction above 1 and locks, or the jaws lift the object off.
/// Sharp and unique if the weight exceeds what the jaws can carry, else a second solution
/// (the fingers carry the object) exists at any friction.
double rolling_threshold(const CrossSectionModel& model, double sheet_rate,
                         double weight) noexcept;

}  // namespace prehensile
