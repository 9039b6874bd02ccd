/// What discs that the face clips let a contact do at an instant: whether a sticking push
/// can carry the finger axis across a straight line, whatever the object turns by and at
/// whatever angle. Internal to the planner.
///
/// The friction is that of the points spread over all angles (spread_pads.h), whose power
/// P is a convex function of the motion xi. So for any motion eta, any t > 0 and the
/// friction w of any motion, w(xi).eta <= (P(xi + t eta) - P(xi)) / t and P(xi) >= w.xi:
/// over a triangle of motions the corners bound what an inequality of a sticking instant
/// can be. Places between two that are looked at count by widening. A push by a point
/// sticks with these too (exact_check.h), as the points at the object's own angle turn
/// it.
#pragma once

#include <array>

#include "planner/pads/local_law.h"
#include "planner/pads/spread_pads.h"

namespace prehensile {

/// Whether laws of clipped discs hold for every push of the scene: not for those that
/// need the mechanics in space.
bool has_clipped_law(const Model& model);

/// Friction (force, moment / c) over F of pads such as SpreadPads in a motion (velocity
/// of the object at the finger axis, c times its rate of turn).
template <class Pads>
Eigen::Vector3d friction_in(const Pads& pads, const Eigen::Vector3d& motion, double c) {
  const PadDrag drag = pads.drag(motion.head<2>(), motion[2] / c);
  return {drag.force.x(), drag.force.y(), drag.moment / c};
}

class ClippedLaw {
 public:
  /// Lines may be so long, in torque radii: the widening was measured up to there.
  static constexpr double kLongest = 0.07;

  /// Of motions across `line`, kLongest at most, towards `out`.
  /// `model` has clipped discs (has_clipped_discs) and must outlive the law.
  ClippedLaw(const Model& model, const PlaceSpan& line, const Vec2& out);

  /// The discs touch the object at both ends.
  bool is_known() const;

  /// Whether the contact, wherever along its face its pusher stands, may stick and move
  /// the finger axis across the line.
  bool may_cross(int contact) const;

  /// Whether gravity's power in the twist, about the finger axis, exceeds that of
  /// friction by a share of it at both ends.
  bool falls(const PushContact& contact, const PlanarTwist& twist, double share) const;

 private:
  const Model& model_;
  PlaceSpan line_;
  Vec2 out_;
  SpreadPads at_a_, at_b_;
};

/// What sticking asks of the friction of pads at a place, as inequalities over F.
class StickDemands {
 public:
  StickDemands(const Model& model, const PushContact& contact, const Vec2& p_OF);

  /// eta . friction + constant >= 0 with friction = (force, moment / c); eta of length 1.
  struct Inequality {
    Eigen::Vector3d eta;
    double constant = 0.0;
  };
  int count() const { return count_; }
  const Inequality& operator[](int i) const { return inequalities_[i]; }

  /// The least of what they leave.
  double slack(const Eigen::Vector3d& friction) const;

 private:
  void add(const Eigen::Vector3d& eta, double constant);

  std::array<Inequality, 5> inequalities_;
  int count_ = 0;
};

/// So much more than at both ends of a line (ClippedLaw::kLongest at most) an inequality
/// of a sticking instant may leave at a place between them, over F. Measured, not proved.
double widening_between(const SpreadPads& at_a, const SpreadPads& at_b,
                        const PlaceSpan& line, double c);

/// Rate at which the pusher advances at an end of its face, for a motion (velocity of the
/// object at the finger axis, c times its rate of turn).
double advance_at(const Vec2& end, const PushContact& contact, const Vec2& p_OF, double c,
                  const Eigen::Vector3d& motion);

}  // namespace prehensile
