#include "planner/obstacles/confines_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "mechanics/pad_law.h"
#include "mechanics/violation.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/obstacles/placement.h"
#include "planner/obstacles/prism_path.h"
#include "planner/obstacles/separation.h"

namespace prehensile {
namespace {

/// Limits are linear along a push, so that its ends would do.
constexpr int kSamples = 9;

bool is_beyond(double value, const std::optional<double>& low,
               const std::optional<double>& high) {
  return (low && !(value >= *low - kLimitTolerance)) ||
         (high && !(value <= *high + kLimitTolerance));
}

bool is_beyond(const Vec2& p, const std::optional<Vec2>& low,
               const std::optional<Vec2>& high) {
  return (low && !(p.array() >= low->array() - kLimitTolerance).all()) ||
         (high && !(p.array() <= high->array() + kLimitTolerance).all());
}

/// Whether a hand that turns from one angle to another leaves its limits, or a whole turn
/// of them, on the way.
bool turns_beyond(double from, double to, double low, double high) {
  const double turn = 2.0 * std::numbers::pi;
  if (high - low + kLimitTolerance >= turn) return false;
  const auto [least, greatest] = std::minmax(from, to);
  const double turns = turn * std::floor((least - low + kLimitTolerance) / turn);
  return greatest > high + turns + kLimitTolerance;
}

std::string grasp_fault(const GraspLimits& limits, const PlanarPose& X_HO) {
  if (is_beyond(X_HO.theta, limits.theta_low, limits.theta_high)) {
    return "the angle of the object leaves its limits";
  }
  if (is_beyond(finger_in_object(X_HO), limits.finger_low, limits.finger_high)) {
    return "the finger axis leaves its limits in the object";
  }
  return {};
}

std::string hand_fault(const GraspLimits& limits, const PlanarPose& X_WH,
                       const Vec2& away) {
  const Vec2 p = translation(X_WH);
  if (is_beyond(p, limits.hand_low, limits.hand_high)) {
    return "the hand leaves its limits";
  }
  if (is_beyond(p + away, limits.hand_low, limits.hand_high)) {
    return "the hand leaves its limits before or after";
  }
  return {};
}

bool rolls(const PlannedPush& planned) {
  return std::holds_alternative<Roll>(planned.push);
}

const PushContact& contact_of(const Model& model, const PlannedPush& planned) {
  return model.contacts[static_cast<std::size_t>(contact_of(planned.push))];
}

PlanarPose pose_at(const PlannedPush& planned, double s) {
  if (rolls(planned)) return planned.start.X_HO;
  return pusher_pose(as_linear(planned.push), planned.start.X_HO, s);
}

PlanarPose object_in_world(const Model& model, const PlannedPush& planned) {
  const double place = rolls(planned) ? 0.0 : as_linear(planned.push).place;
  return object_at_pusher(model, contact_of(model, planned), place);
}

/// Where a pusher stands along its face puts the hand elsewhere in the world.
std::string place_fault(const Model& model, const PlannedPush& planned) {
  if (rolls(planned)) return {};
  const double most = farthest_place(contact_of(model, planned));
  if (std::abs(as_linear(planned.push).place) <= most + kLimitTolerance) return {};
  return "the pusher would stand beside its place, neither on its face whole nor over it";
}

std::string limits_fault(const Model& model, const PlannedPush& planned) {
  const GraspLimits& limits = *model.scene.limits;
  const PushContact& contact = contact_of(model, planned);
  const PlanarPose X_WO = object_in_world(model, planned);
  const double approach = model.scene.obstacles.value_or(Obstacles{}).approach;
  const Vec2 away = approach * rotated(X_WO.theta, contact.n);
  const auto hand_at = [&](double s) {
    return compose(X_WO, inverse(pose_at(planned, s)));
  };
  if (limits.hand_angle_low &&
      turns_beyond(hand_at(0.0).theta, hand_at(1.0).theta, *limits.hand_angle_low,
                   *limits.hand_angle_high)) {
    return "the hand turns beyond its limits";
  }
  for (int i = 0; i < kSamples; ++i) {
    const double s = static_cast<double>(i) / (kSamples - 1);
    std::string fault = grasp_fault(limits, pose_at(planned, s));
    if (fault.empty()) fault = hand_fault(limits, hand_at(s), away);
    if (!fault.empty()) return fault;
  }
  return grasp_fault(limits, planned.end.X_HO);
}

/// Looks for collisions of one plan.
class CollisionCheck {
 public:
  explicit CollisionCheck(const Model& model)
      : model_(model),
        obstacles_(*model.scene.obstacles),
        palm_(palm_bodies(model)),
        object_(object_bodies(model)) {
    for (const ConvexBody& body : obstacles_.hand) {
      reach_ = std::max(reach_, reach_about_z(body));
    }
  }

  std::string fault(const PlannedPush& planned) const {
    const PushContact& contact = contact_of(model_, planned);
    const PlanarPose X_WO = object_in_world(model_, planned);
    const Vec2 n = rotated(X_WO.theta, contact.n);
    const auto* roll = std::get_if<Roll>(&planned.push);
    const double rise = roll ? -roll->travel : 0.0;
    const auto hand = [&](double s, double off) {
      return in_space(moved(compose(X_WO, inverse(pose_at(planned, s))), off * n),
                      s * rise);
    };
    const auto object = [&](double s, double off) {
      return in_space(moved(X_WO, (kTouch + off) * n), s * rise);
    };
    if (hits(obstacles_.hand, obstacles_.clearance, way(planned),
             [&](double s) { return hand(s, 0.0); })) {
      return "the hand comes too near to an obstacle";
    }
    const bool object_hits =
        roll && model_.prism
            ? prism_hits(contact, planned.end.psi - planned.start.psi, object(0.0, 0.0))
            : hits(object_, 0.0, std::abs(rise),
                   [&](double s) { return object(s, 0.0); });
    if (object_hits) return "the object hits an obstacle";
    if (palm_hits(planned)) return "the object comes too near to a body of the hand";
    for (const double end : {0.0, 1.0}) {
      const std::string when = end == 0.0 ? "approaches" : "retreats";
      if (hits(obstacles_.hand, obstacles_.clearance, obstacles_.approach,
               [&](double s) { return hand(end, s * obstacles_.approach); })) {
        return "the hand comes too near to an obstacle while it " + when;
      }
      if (hits(object_, 0.0, obstacles_.approach,
               [&](double s) { return object(end, s * obstacles_.approach); })) {
        return "the object hits an obstacle while the hand " + when;
      }
    }
    return {};
  }

  bool transit_hits(const HeldObject& held, const HandPose& from,
                    const HandPose& to) const {
    const PlanarPose& X_HO = held.X_HO;
    double reach = reach_;
    for (const ConvexBody& body : object_) {
      reach = std::max(reach, translation(X_HO).norm() + reach_about_z(body));
    }
    const Vec3 d(to.X_WH.x - from.X_WH.x, to.X_WH.y - from.X_WH.y, to.z - from.z);
    const double length = d.norm() + reach * std::abs(to.X_WH.theta - from.X_WH.theta);
    return hits(obstacles_.hand, obstacles_.clearance, length,
                [&](double s) {
                  const HandPose at = between(from, to, s);
                  return in_space(at.X_WH, at.z);
                }) ||
           hits(object_, 0.0, length, [&](double s) {
             const HandPose at = between(from, to, s);
             return in_space(compose(at.X_WH, X_HO), at.z);
           });
  }

 private:
  static PlanarPose moved(const PlanarPose& pose, const Vec2& by) {
    return {pose.x + by.x(), pose.y + by.y(), pose.theta};
  }

  /// No point of the hand moves farther than this during a push [m].
  double way(const PlannedPush& planned) const {
    if (const auto* roll = std::get_if<Roll>(&planned.push)) {
      return std::abs(roll->travel);
    }
    const LinearPush push = as_linear(planned.push);
    return push.travel + reach_ * std::abs(push.turn);
  }

  /// Whether bodies that go this way [m] come nearer to the fixture than they may.
  template <class Path>
  bool hits(const std::vector<ConvexBody>& bodies, double clearance, double length,
            const Path& path) const {
    return hits(bodies, obstacles_.fixture, clearance, length, path);
  }

  /// The same of others that stand still.
  template <class Path>
  static bool hits(const std::vector<ConvexBody>& bodies,
                   const std::vector<ConvexBody>& others, double clearance, double length,
                   const Path& path) {
    for (double done = 0.0;;) {
      const double s = length > 0.0 ? done / length : 0.0;
      const double room =
          distance(bodies, path(s), others) - clearance + 2.0 * kClearanceTolerance;
      if (!(room > kClearanceTolerance)) return true;
      done += room;
      if (done > length) return false;
    }
  }

  /// A prism that rolls over its edges from where it lies.
  bool prism_hits(const PushContact& contact, double dpsi,
                  const Eigen::Isometry3d& X_WO) const {
    const PrismPath path(model_, contact, dpsi);
    return hits(object_, 0.0, path.length(), [&](double s) { return X_WO * path.at(s); });
  }

  /// The palm in O; of a prism that rolls, which leaves the pad plane, that in H. A round
  /// object rolls about its axis.
  bool palm_hits(const PlannedPush& planned) const {
    const double clearance = obstacles_.clearance;
    const auto* roll = std::get_if<Roll>(&planned.push);
    if (roll && model_.prism) {
      const double dpsi = planned.end.psi - planned.start.psi;
      const PrismPath path(model_, contact_of(model_, planned), dpsi);
      const double length = path.length() + std::abs(roll->travel);
      return hits(object_, palm_, clearance, length, [&](double s) {
        return in_space(planned.start.X_HO, s * roll->travel) * path.at(s);
      });
    }
    const double length = roll ? 0.0 : way(planned);
    return hits(palm_, object_, clearance, length,
                [&](double s) { return in_space(inverse(pose_at(planned, s)), 0.0); });
  }

  static double distance(const std::vector<ConvexBody>& bodies,
                         const Eigen::Isometry3d& X_W,
                         const std::vector<ConvexBody>& others) {
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexBody& body : bodies) {
      const PlacedBody placed{&body, X_W * pose_of(body)};
      for (const ConvexBody& fixed : others) {
        least = tighter(least, separation(placed, {&fixed, pose_of(fixed)}));
      }
    }
    return least;
  }

  const Model& model_;
  const Obstacles& obstacles_;
  std::vector<ConvexBody> palm_, object_;
  double reach_ = 0.0;
};

/// The slack of gravity, in units of the friction force and a lever that is no shorter
/// than half of the torque radius, changes by no more than gravity does in these.
bool holds_all_along(const Model& model, const HeldObject& held, const HandPose& from,
                     const HandPose& to) {
  constexpr double kStep = 0.01;  // [rad]
  const Vec2 g_W = model.scene.g_W / held.grip_share;
  if (g_W.isZero(0.0)) return true;
  const double turn = to.X_WH.theta - from.X_WH.theta;
  const int parts = static_cast<int>(std::ceil(std::abs(turn) / kStep));
  const double lever = (model.p_OCom - finger_in_object(held.X_HO)).norm();
  const double rate = model.mass * g_W.norm() / model.F * (1.0 + lever / (0.5 * model.c));
  const double reserve = parts > 0 ? 0.5 * rate * std::abs(turn) / parts : 0.0;
  for (int i = 0; i <= parts; ++i) {
    const double share = parts > 0 ? static_cast<double>(i) / parts : 0.0;
    const double angle = between(from, to, share).X_WH.theta + held.X_HO.theta;
    const PlanarGrasp grasp = grasp_at(model, held.X_HO, rotated(-angle, g_W));
    if (!(grasp.count > 0 && gravity_slack_by_pad_law(model, grasp) > reserve)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string confinement_fault(const Model& model,
                              const std::vector<PlannedPush>& pushes) {
  if (!model.scene.limits && !model.scene.obstacles) return {};
  std::optional<CollisionCheck> collisions;
  if (model.scene.obstacles) collisions.emplace(model);
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    std::string fault = place_fault(model, pushes[i]);
    if (fault.empty() && model.scene.limits) fault = limits_fault(model, pushes[i]);
    if (fault.empty() && collisions) fault = collisions->fault(pushes[i]);
    if (!fault.empty()) return "push " + std::to_string(i + 1) + ": " + fault;
  }
  return {};
}

bool hand_stays_within(const GraspLimits& limits, const HandPose& from,
                       const HandPose& to) {
  for (const HandPose* pose : {&from, &to}) {
    if (is_beyond(translation(pose->X_WH), limits.hand_low, limits.hand_high)) {
      return false;
    }
  }
  if (!limits.hand_angle_low) return true;
  const double low = *limits.hand_angle_low;
  const double high = *limits.hand_angle_high;
  return !turns_beyond(from.X_WH.theta, to.X_WH.theta, low, high);
}

bool transit_is_clear(const Model& model, const HeldObject& held, const HandPose& from,
                      const HandPose& to) {
  if (model.scene.limits && !hand_stays_within(*model.scene.limits, from, to)) {
    return false;
  }
  return holds_all_along(model, held, from, to) &&
         !(model.scene.obstacles && CollisionCheck(model).transit_hits(held, from, to));
}

}  // namespace prehensile
