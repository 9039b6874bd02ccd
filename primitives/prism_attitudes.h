/// The attitudes of a prism that a support rolls between the jaws: contacts, instants and
/// how far the support has moved at each. Internal to roll_prism.cpp and roll_load.cpp.
#pragma once

#include <array>

#include "mechanics/model.h"
#include "mechanics/prism_section.h"
#include "primitives/push_record.h"
#include "primitives/roll_support.h"

namespace prehensile {

inline constexpr double kSameAngle = 1e-9;   ///< [rad]
inline constexpr double kJustBefore = 1e-5;  ///< [rad] before a flat

/// Half extents of a rectangular pad along u and along the object's axis [m]; 0 if the
/// pad is no rectangle or askew.
Vec2 half_pad(const Pad& pad, const Vec2& n_H);

/// A look at one attitude.
struct PrismLook {
  PrismContacts contacts;
  PrismInstant instant;
  double certificate = kNan;
  bool rolls = false;  ///< the support sticks, both jaws touch, and it turns as it should
};

/// A roll of Model::prism by one contact. Attitudes are roll angles phi [rad] about t of
/// the contact. Keeps references to its arguments.
class PrismRoll {
 public:
  PrismRoll(const Model& model, const Grasp& start, const Roll& roll);

  double first() const { return attitude(start_.psi); }
  double attitude(double psi) const { return sign_ * psi; }
  double way() const { return way_; }  ///< sign of the change of phi
  const SectionPolygon& polygon() const { return polygon_; }

  PrismContacts contacts(double phi) const;
  PrismLook look(double phi) const;

  /// What the contacts of a look put on the object, along its axis.
  RollLoads loads(const PrismLook& look) const;

  /// Of what stands still in the hand, from the origin of O and up to a constant [m].
  double hand_z(const PrismContacts& contacts) const;

  /// Vertex about which the section tips from this attitude.
  int pivot(const PrismContacts& contacts) const;

  /// How far the support has moved when the section stands on the pivot at phi, from an
  /// origin of the pivot's own [m].
  double place(int pivot, double phi, const PrismContacts& contacts) const;

  /// The next attitude at which a side is parallel to support or jaws, at most `longest`
  /// away.
  double next(double phi, double longest, bool& is_flat) const;

  Sample sample(double phi, double s, const PrismLook& look) const;
  Grasp grasp(double phi) const;

  /// Why a look is no roll.
  PushStop why_not(double phi, const PrismLook& look) const;

 private:
  PadReach pads(double phi) const;
  bool keeps_straight(const PrismLook& look) const;

  const Model& model_;
  const PushContact& contact_;
  const Grasp& start_;
  double travel_;
  double way_;
  double sign_;  // roll angle about t over psi
  SectionPolygon polygon_;
  std::array<double, SectionPolygon::kCapacity> direction_{};  // [rad] of its sides
  Vec2 half_pad_ = Vec2::Zero();
  double finger_t_ = 0.0;
  double finger_height_ = 0.0;  // above the support
  PrismGrip grip_;
  CrossSectionDrive drive_;
};

}  // namespace prehensile
