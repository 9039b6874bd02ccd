/// Rolling a prism over its edges between flat jaws (paper section VII-C): where its
/// section touches jaws and support at an attitude, and what happens at that instant.
///
/// Axes and signs are those of mechanics/cross_section.h: z along the closing direction,
/// u along the normal of the support into the object, a positive roll turns z towards u,
/// a support that moves along +z rolls the object that way. Points and moments are about
/// the origin of O; the section is drawn in the hand's directions.
///
/// A jaw is a straight pad along u of finite length. It touches a corner of the section
/// with its flat, or a side of the section with its end (the normal is then that of the
/// side), or lies flat on a side. Where something lies flat, an instant distinguishes
/// three cases: the object turns one way, the other way (one point of each flat contact
/// stays), or not at all (forces may act anywhere along it).
#pragma once

#include <array>
#include <vector>

#include "mechanics/cross_section.h"
#include "scene/frames.h"

namespace prehensile {

/// A convex section in (z, u) at roll 0, counter-clockwise, about the origin of O.
struct SectionPolygon {
  static constexpr int kCapacity = 200;
  int count = 0;  ///< 3..kCapacity
  std::array<Vec2, kCapacity> vertex;
  Vec2 com = Vec2::Zero();  ///< [m] centre of mass
  double size = 0.0;        ///< [m] farthest vertex from the origin, > 0
};

/// The section of a lying prism as seen where the support touches its lateral side
/// `side`: +1 if the support's normal points along the lateral axis, else -1.
SectionPolygon section_polygon(const std::vector<Vec2>& section, int side,
                               const Vec2& com) noexcept;

/// Extent of both pads along u [m], from the origin of O.
struct PadReach {
  double low = 0.0;
  double high = 0.0;
};

/// Where one contact touches: one point, or the two ends of a flat contact. For a flat
/// jaw the first is the lower one, for a flat support the one at less z.
struct SectionTouch {
  int count = 0;                         ///< 0: no contact
  std::array<Vec2, 2> point;             ///< [m]
  std::array<int, 2> vertex = {-1, -1};  ///< of the section; -1: an end of the pad
  Vec2 normal = Vec2::Zero();            ///< into the object
};

/// All contacts of a section that lies on the support between closed jaws.
struct PrismContacts {
  std::array<SectionTouch, 3> touch;           ///< by CrossSectionContact
  std::array<double, 2> jaw_z = {kNan, kNan};  ///< [m] of the jaws' surfaces
  double sheet_u = kNan;                       ///< [m] of the support

  bool held() const { return touch[kJaw1].count > 0 && touch[kJaw2].count > 0; }
  bool any_flat() const {
    return touch[0].count == 2 || touch[1].count == 2 || touch[2].count == 2;
  }
};
PrismContacts prism_contacts(const SectionPolygon& polygon, double roll,
                             const PadReach& pads) noexcept;

/// Height of the support below the origin at this roll, as sheet_u [m].
double support_height(const SectionPolygon& polygon, double roll) noexcept;

/// Which of the touching points stays in touch when the object turns, by the sign of the
/// turn: the other one lifts off.
int staying_point(const SectionTouch& touch, int turn) noexcept;

/// Resultant of each contact on the object, along its normal and its tangent (the normal
/// turned by a quarter towards +u at the jaws, towards +z at the support).
struct SectionForces {
  std::array<double, 3> normal{kNan, kNan, kNan};      ///< [N], >= 0
  std::array<double, 3> tangential{kNan, kNan, kNan};  ///< [N]
  std::array<Vec2, 3> point;      ///< [m] where it acts; a touching point if it is zero
  std::array<Vec2, 3> direction;  ///< the normal, into the object
};

/// The grip on a prism: constants of an instant besides its attitude.
struct PrismGrip {
  double grip_force = 0.0;                      ///< [N] per finger, >= 0
  std::array<double, 2> friction = {0.0, 0.0};  ///< of jaw 1 and jaw 2, >= 0
  JawMode jaw_mode = JawMode::kCoupled;
};

/// Statuses as in CrossSectionInstant. Fields are set as there.
struct PrismInstant {
  InstantStatus status = InstantStatus::kNotRun;
  /// kOutOfIterations: every contact mode was tried and none has a solution, so there is
  /// no quasi-static motion; but no single motion or wedge proves it, as those below do.
  bool exhausted = false;
  CrossSectionMotion motion;  ///< v_z, v_u of the origin of O
  SectionForces forces;
  std::array<ContactMode, 3> mode{ContactMode::kOpen, ContactMode::kOpen,
                                  ContactMode::kOpen};
  double push_force = kNan;  ///< |force of the support on the object| [N]

  /// The forces with the least and the greatest load on the support among all force
  /// solutions at this motion; `forces` is their mean. Where the load has no upper bound
  /// (jaw and support wedge the object) both are the least ones and `wedges` is set.
  SectionForces least, greatest;
  bool wedges = false;

  int motions_found = 0;
  CrossSectionMotion other;    ///< kAmbiguous: a second motion,
  SectionForces other_forces;  ///< and its forces
  /// kDynamic: a motion that no force of any contact opposes while gravity and grip gain
  /// power from it: nothing balances them, the object tips or falls.
  CrossSectionMotion evidence;
  SectionForces evidence_forces;  ///< kJammed: the wedge, as in CrossSectionInstant
};

/// All solutions in the quasi-static limit, by going through all contact modes. No heap,
/// no exceptions. kBadInput for jaws that are locked or independent, for a section that
/// is not held, and for numbers out of range.
PrismInstant solve_prism(const SectionPolygon& polygon, double roll,
                         const PrismContacts& contacts, const PrismGrip& grip,
                         const CrossSectionDrive& drive) noexcept;

/// Largest violation of balance, cones, unilateral law and slip directions by an answer,
/// and of what its status claims, dimensionless; derived from the polygon, independently
/// of solver and prism_contacts. NaN for an answer without claim.
double prism_residual(const SectionPolygon& polygon, double roll, const PadReach& pads,
                      const PrismGrip& grip, const CrossSectionDrive& drive,
                      const PrismInstant& answer) noexcept;

}  // namespace prehensile
