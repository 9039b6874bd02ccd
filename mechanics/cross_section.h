/// Rolling in the cross-section of a round object between flat jaws: v_z
/// along the closing direction, v_u along the support normal, roll rate, jaw rate; three
/// contacts with four modes each, all 64 combinations examined, so that the answer comes
/// with its verdict on uniqueness.
///
/// Contacts: jaw 1 at -r and jaw 2 at +r along z, the support ("sheet") at -r along u.
/// Positive roll rate turns z towards u. Source: paper section VII-C.
#pragma once

#include <array>
#include <string_view>

#include "mechanics/instant.h"
#include "scene/scene.h"

namespace prehensile {

/// Constants of the cross-section.
struct CrossSectionModel {
  double radius = 0.0;                          ///< [m]
  double mass = 0.0;                            ///< [kg]
  double grip_force = 0.0;                      ///< [N] per finger
  std::array<double, 2> friction = {0.0, 0.0};  ///< of jaw 1 and jaw 2
  JawMode jaw_mode = JawMode::kCoupled;
};

/// The support that moves along the closing direction.
struct CrossSectionDrive {
  double mu = 0.0;          ///< friction of the support
  double sheet_rate = 0.0;  ///< [m/s] along z, not zero
  double weight =
      0.0;  ///< [N] gravity pressing on the support, along -u; may be negative
};

enum CrossSectionContact { kJaw1 = 0, kJaw2 = 1, kSheet = 2 };

struct CrossSectionInstant {
  InstantStatus status = InstantStatus::kNotRun;
  double v_z = kNan;                                     ///< [m/s]
  double v_u = kNan;                                     ///< [m/s]
  double roll_rate = kNan;                               ///< [rad/s]
  double jaw_rate = kNan;                                ///< [m/s] closing
  std::array<double, 3> normal_force{kNan, kNan, kNan};  ///< [N] by CrossSectionContact
  std::array<double, 3> tangential_force{kNan, kNan, kNan};  ///< [N]; jaws along u, sheet
                                                             ///< along z; on the object
  std::array<ContactMode, 3> mode{ContactMode::kOpen, ContactMode::kOpen,
                                  ContactMode::kOpen};
  double push_force = kNan;  ///< |force of the sheet on the object| [N]

  /// Range of the sheet's normal force over all force solutions at this motion [N].
  double sheet_force_low = kNan;
  double sheet_force_high = kNan;

  /// kAmbiguous: another motion that also satisfies every law.
  double other_roll_rate = kNan;
  double other_v_z = kNan;
  int motions_found = 0;  ///< distinct motions over the 64 mode combinations
};

/// All solutions in the quasi-static limit. No exceptions.
CrossSectionInstant solve_cross_section(const CrossSectionModel& model,
                                        const CrossSectionDrive& drive) noexcept;

/// Largest violation of balance, cones, complementarity and slip directions by an answer,
/// dimensionless; derived independently of the solver.
double cross_section_residual(const CrossSectionModel& model,
                              const CrossSectionDrive& drive,
                              const CrossSectionInstant& answer) noexcept;

/// Least friction of the support for which the object rolls (closed form D), for equal
/// finger frictions mu <= 1; the closed form's own domain is the caller's business.
double rolling_threshold(const CrossSectionModel& model, double sheet_rate,
                         double weight);

}  // namespace prehensile
