/// What confines a search besides contact: limits on the grasp and the hand, and
/// obstacles. Internal to the planner.
///
/// During a push the object stands still in W and the finger axis moves straight in O, at
/// a rate of turn in proportion: theta, the finger axis in O and the origin of H in W are
/// linear in the share of the push, and boxes and intervals are convex. So limits that
/// hold at both ends of a push hold all along it. Distances from obstacles change by no
/// more than the hand's fastest point moves, so that a distance at one pose clears the
/// poses after it up to where that point might touch.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "planner/obstacles/collision_bodies.h"
#include "planner/push_constraint.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// Angles that O may have in H, or turns that are left of them [rad].
struct TurnWindow {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  bool contains(double angle) const { return angle >= low && angle <= high; }
};

/// What rounding may add to a limit in a search [m] and [rad].
inline constexpr double kLimitRounding = 1e-9;

TurnWindow theta_window(const Scene& scene);

/// Whether the limits of a scene admit a state; those of the hand are no matter of it.
bool limits_admit(const Scene& scene, const FlatState& state) noexcept;

/// The goal as the limits leave it: where they admit one winding of its angle only, that
/// angle as a number.
Goal goal_within_limits(const Scene& scene);

class Confines {
 public:
  /// Null where the scene of the search confines nothing. `search` needs its contacts.
  static std::shared_ptr<const Confines> of(const SearchModel& search);

  explicit Confines(const SearchModel& search);

  const TurnWindow& theta() const { return theta_; }

  /// What a move does not keep to, if anything.
  std::optional<PushConstraint> broken_by(const SearchModel& search, const Move& move,
                                          Work& work) const noexcept;

  /// The same of what is true of every move of a contact between these places, however it
  /// turns: cheap, and asked before its turn is known.
  std::optional<PushConstraint> broken_between(int contact, const Vec2& from_p_OF,
                                               const Vec2& to_p_OF) const noexcept;

  /// Whether the hand would hit the fixture or the object at this place for each of some
  /// turns within the limits: not worth a look. False for point pushers, whose place is
  /// open.
  bool is_blocked(const SearchModel& search, int contact, const Vec2& p_OF,
                  Work& work) const noexcept;

 private:
  bool hand_is_out(const PushContact& contact, const Move& move,
                   const PlanarPose& X_WO) const noexcept;
  bool collides(const SearchModel& search, const Move& move,
                const PlanarPose& X_WO) const noexcept;
  bool object_collides(const PushContact& contact, const PlanarPose& X_WO) const noexcept;
  bool hand_collides_along(const PlanarPose& X_WO, const Move& move) const noexcept;
  bool palm_is_far(const Vec2& p_OF) const noexcept;
  bool palm_collides_along(const Move& move) const noexcept;
  bool hand_collides_away(const PushContact& contact, const PlanarPose& X_WO,
                          const FlatState& state) const noexcept;

  const Model& model_;
  TurnWindow theta_;
  bool has_finger_box_ = false, limits_hand_ = false;
  Vec2 finger_low_, finger_high_, hand_low_, hand_high_;
  TurnWindow hand_angle_;
  double approach_ = 0.0;
  double clearance_ = 0.0;
  double palm_from_axis_ = 0.0;
  std::unique_ptr<CollisionBodies> bodies_;  // null without obstacles
  std::vector<char> object_collides_;        // by search contact; never of a point pusher
};

/// Whether a move keeps to limits and obstacles, if the scene has any; counts what it
/// breaks.
inline bool is_confined(const SearchModel& search, const Move& move, Work& work) {
  if (!search.confines) return true;
  const auto broken = search.confines->broken_by(search, move, work);
  if (broken) work.stopped_by.add(*broken);
  return !broken;
}

/// Whether a contact's hand is in the way of obstacles at this place, however it turns,
/// by a few looks; counted.
inline bool is_blocked(const SearchModel& search, int contact, const Vec2& p_OF,
                       Work& work) {
  if (!search.confines || !search.confines->is_blocked(search, contact, p_OF, work)) {
    return false;
  }
  work.stopped_by.add(PushConstraint::kCollision);
  return true;
}

/// Turns that are left from an angle, with half of the rounding that is_confined allows.
inline TurnWindow turns_from(const SearchModel& search, double theta) {
  if (!search.confines) return {};
  const TurnWindow& window = search.confines->theta();
  return {window.low - theta - 0.5 * kLimitRounding,
          window.high - theta + 0.5 * kLimitRounding};
}

}  // namespace prehensile
