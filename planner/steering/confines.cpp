#include "planner/steering/confines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/obstacles/confines_check.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/obstacles/placement.h"
#include "planner/obstacles/separation.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

bool in_box(const Vec2& p, const Vec2& low, const Vec2& high) {
  return (p.array() >= low.array() - kLimitRounding).all() &&
         (p.array() <= high.array() + kLimitRounding).all();
}

TurnWindow wider(const TurnWindow& window, double by) {
  return {window.low - by, window.high + by};
}

/// Nearer to a limit than this counts as beyond it [m]: each look clears at least half of
/// that of the way, and the rest is left for what the library's distances are too great.
/// The object comes as close to a pusher as kTouch; the hand keeps its clearance.
constexpr double kResolutionOfObject = 5e-5;
constexpr double kResolution = 2e-4;

constexpr std::int64_t kWorkOfQuery = 10;  // of a pair of bodies, in stick tests
constexpr int kBlockedTurns = 12;

/// Where no more than this share of the rest of a way is cleared by a look, the look is
/// made as well as can be.
constexpr double kCoarseLook = 0.25;

/// Whether all points of a way keep `need` of distance. `distance(done, enough, coarse)`
/// is that after this part of the way [m], or `enough` where it is more, or something
/// between `coarse` and the distance; no point of the body moves farther than the way is
/// long.
template <class Distance>
bool stays_clear(double way, double need, double resolution, const Distance& distance) {
  for (double done = 0.0;;) {
    const double left = way - done;
    const double coarse = need + std::max(kCoarseLook * left, resolution);
    const double room = distance(done, need + left + resolution, coarse) - need;
    if (room < resolution) return false;
    if (room >= left) return true;
    done += room - 0.5 * resolution;
  }
}

/// The same of a hand that reaches so far from its z axis, all along a move, with the
/// object at X_WO. `distance(X_WH, enough, coarse)` as above.
template <class Distance>
bool hand_stays_clear(const PlanarPose& X_WO, const Move& move, double reach, double need,
                      const Distance& distance) {
  const Vec2 d = move.to.p_OF - move.from.p_OF;
  const double turn = move.to.theta - move.from.theta;
  const double way = d.norm() + reach * std::abs(turn);
  return stays_clear(
      way, need, kResolution, [&](double done, double enough, double coarse) {
        const double s = way > 0.0 ? done / way : 0.0;
        const PlanarPose X_WH =
            hand_in_world(X_WO, move.from.p_OF + s * d, move.from.theta + s * turn);
        return distance(X_WH, enough, coarse);
      });
}

PlanarPose moved(const PlanarPose& pose, const Vec2& by) {
  return {pose.x + by.x(), pose.y + by.y(), pose.theta};
}

/// How near palm bodies come to the finger axis, as far along it as the object reaches
/// [m]; infinity without any.
double palm_from_axis(const Model& model) {
  CapsuleShape axis;
  for (const ConvexBody& body : object_bodies(model)) {
    for (const Vec3& up : {Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ())}) {
      const double height = up.dot(support({&body, pose_of(body)}, up));
      axis.length = std::max(axis.length, 2.0 * height);
    }
  }
  const ConvexBody finger_axis{.shape = axis};
  double least = kInfinity;
  for (const ConvexBody& palm : palm_bodies(model)) {
    least = std::min(least, separation({&finger_axis}, {&palm, pose_of(palm)}));
  }
  return least;
}

bool has_place(const SearchContact& contact) {
  return contact.place_low == contact.place_high;
}

}  // namespace

TurnWindow theta_window(const Scene& scene) {
  if (!scene.limits) return {};
  return {scene.limits->theta_low.value_or(-kInfinity),
          scene.limits->theta_high.value_or(kInfinity)};
}

bool limits_admit(const Scene& scene, const FlatState& state) noexcept {
  if (!scene.limits) return true;
  const GraspLimits& limits = *scene.limits;
  const Vec2 far = Vec2::Constant(kInfinity);
  return wider(theta_window(scene), kLimitRounding).contains(state.theta) &&
         in_box(state.p_OF, limits.finger_low.value_or(-far),
                limits.finger_high.value_or(far));
}

Goal goal_within_limits(const Scene& scene) {
  Goal goal = *scene.goal;
  const TurnWindow window = theta_window(scene);
  const bool bounded = std::isfinite(window.low) && std::isfinite(window.high);
  if (!goal.theta || goal.theta_is == ThetaMeaning::kNumber || !bounded) return goal;
  const double slack = goal.test == GoalTest::kWeightedSum
                           ? goal.position_tolerance / goal.characteristic_length
                           : goal.angle_tolerance;
  const double room = slack + kLimitTolerance;
  const double first = std::ceil((window.low - room - *goal.theta) / kTurn);
  const double last = std::floor((window.high + room - *goal.theta) / kTurn);
  if (first != last) return goal;
  *goal.theta += kTurn * first;
  goal.theta_is = ThetaMeaning::kNumber;
  return goal;
}

std::shared_ptr<const Confines> Confines::of(const SearchModel& search) {
  const Scene& scene = search.model->scene;
  if (!scene.limits && !scene.obstacles) return nullptr;
  return std::make_shared<const Confines>(search);
}

Confines::Confines(const SearchModel& search)
    : model_(*search.model), theta_(theta_window(model_.scene)) {
  const Vec2 far = Vec2::Constant(kInfinity);
  const GraspLimits limits = model_.scene.limits.value_or(GraspLimits{});
  has_finger_box_ = limits.finger_low || limits.finger_high;
  finger_low_ = limits.finger_low.value_or(-far);
  finger_high_ = limits.finger_high.value_or(far);
  limits_hand_ = limits.hand_low || limits.hand_high || limits.hand_angle_low;
  hand_low_ = limits.hand_low.value_or(-far);
  hand_high_ = limits.hand_high.value_or(far);
  hand_angle_ = {limits.hand_angle_low.value_or(-kInfinity),
                 limits.hand_angle_high.value_or(kInfinity)};
  const Obstacles obstacles = model_.scene.obstacles.value_or(Obstacles{});
  approach_ = obstacles.approach;
  clearance_ = obstacles.clearance;
  if (!model_.scene.obstacles) return;
  bodies_ = std::make_unique<CollisionBodies>(model_);
  palm_from_axis_ = palm_from_axis(model_);
  for (const SearchContact& contact : search.contacts) {
    const PushContact& touched = model_.contacts[contact.contact];
    const PlanarPose X_WO = object_at_pusher(model_, touched, contact.place);
    object_collides_.push_back(has_place(contact) && object_collides(touched, X_WO));
  }
}

bool Confines::hand_is_out(const PushContact& contact, const Move& move,
                           const PlanarPose& X_WO) const noexcept {
  const Vec2 away = approach_ * rotated(X_WO.theta, contact.n);
  for (const FlatState& end : {move.from, move.to}) {
    const Vec2 p = transform(X_WO, end.p_OF);
    if (!in_box(p, hand_low_, hand_high_)) return true;
    if (!in_box(p + away, hand_low_, hand_high_)) return true;
  }
  if (!std::isfinite(hand_angle_.low)) return false;
  const double a = X_WO.theta - move.from.theta;
  const double b = X_WO.theta - move.to.theta;
  const double low = std::min(a, b) + kLimitRounding;
  const double turns = std::ceil((hand_angle_.low - low) / kTurn);
  return std::max(a, b) + kTurn * turns > hand_angle_.high + kLimitRounding;
}

/// On the way to the pusher and back, and while it is pushed.
bool Confines::object_collides(const PushContact& contact,
                               const PlanarPose& X_WO) const noexcept {
  const Vec2 n = rotated(X_WO.theta, contact.n);
  const double way = std::max(0.0, approach_ - kTouch);
  return !stays_clear(way, 0.0, kResolutionOfObject,
                      [&](double done, double enough, double coarse) {
                        return bodies_->object_distance(moved(X_WO, (kTouch + done) * n),
                                                        enough, 0.0, coarse);
                      });
}

bool Confines::hand_collides_along(const PlanarPose& X_WO,
                                   const Move& move) const noexcept {
  return !hand_stays_clear(X_WO, move, bodies_->hand_reach(), clearance_,
                           [&](const PlanarPose& X_WH, double enough, double coarse) {
                             return bodies_->hand_distance(X_WH, enough, 0.0, coarse);
                           });
}

/// However the object is turned.
bool Confines::palm_is_far(const Vec2& p_OF) const noexcept {
  const double near = clearance_ + kResolution;
  return p_OF.norm() + bodies_->object_reach() + near <= palm_from_axis_;
}

/// As seen from O: on the way to the pusher and back it keeps its distance.
bool Confines::palm_collides_along(const Move& move) const noexcept {
  if (palm_is_far(move.from.p_OF) && palm_is_far(move.to.p_OF)) return false;
  return !hand_stays_clear({}, move, bodies_->hand_reach(), clearance_,
                           [&](const PlanarPose& X_OH, double enough, double coarse) {
                             return bodies_->palm_distance(X_OH, enough, coarse);
                           });
}

bool Confines::hand_collides_away(const PushContact& contact, const PlanarPose& X_WO,
                                  const FlatState& state) const noexcept {
  const PlanarPose X_WH = hand_in_world(X_WO, state.p_OF, state.theta);
  const Vec2 n = rotated(X_WO.theta, contact.n);
  return !stays_clear(
      approach_, clearance_, kResolution, [&](double done, double enough, double coarse) {
        return bodies_->hand_distance(moved(X_WH, done * n), enough, 0.0, coarse);
      });
}

bool Confines::collides(const SearchModel& search, const Move& move,
                        const PlanarPose& X_WO) const noexcept {
  const SearchContact& contact = search.contacts[move.contact];
  const PushContact& touched = model_.contacts[contact.contact];
  return (!has_place(contact) && object_collides(touched, X_WO)) ||
         palm_collides_along(move) || hand_collides_along(X_WO, move) ||
         hand_collides_away(touched, X_WO, move.from) ||
         hand_collides_away(touched, X_WO, move.to);
}

std::optional<PushConstraint> Confines::broken_between(
    int contact, const Vec2& from_p_OF, const Vec2& to_p_OF) const noexcept {
  if (has_finger_box_ && !(in_box(from_p_OF, finger_low_, finger_high_) &&
                           in_box(to_p_OF, finger_low_, finger_high_))) {
    return PushConstraint::kReach;
  }
  if (bodies_ && object_collides_[static_cast<std::size_t>(contact)]) {
    return PushConstraint::kCollision;
  }
  return std::nullopt;
}

bool Confines::is_blocked(const SearchModel& search, int contact, const Vec2& p_OF,
                          Work& work) const noexcept {
  const SearchContact& pushed = search.contacts[contact];
  if (!bodies_ || !has_place(pushed)) return false;
  const PushContact& touched = model_.contacts[pushed.contact];
  const PlanarPose X_WO = object_at_pusher(model_, touched, pushed.place);
  const double low = std::max(theta_.low, -std::numbers::pi);
  const double high = std::min(theta_.high, low + kTurn);
  const std::int64_t before = bodies_->queries();
  const double near = clearance_ + kResolution;
  const bool far = palm_is_far(p_OF);
  bool blocked = true;
  for (int i = 0; i < kBlockedTurns && blocked; ++i) {
    const double theta = std::lerp(low, high, (i + 0.5) / kBlockedTurns);
    const PlanarPose X_WH = hand_in_world(X_WO, p_OF, theta);
    const PlanarPose X_OH = hand_in_world({}, p_OF, theta);
    blocked = bodies_->hand_distance(X_WH, near, 0.0, near) < near ||
              (!far && bodies_->palm_distance(X_OH, near, near) < near);
  }
  work.other += kWorkOfQuery * (bodies_->queries() - before);
  return blocked;
}

std::optional<PushConstraint> Confines::broken_by(const SearchModel& search,
                                                  const Move& move,
                                                  Work& work) const noexcept {
  const TurnWindow theta = wider(theta_, kLimitRounding);
  if (!theta.contains(move.from.theta) || !theta.contains(move.to.theta)) {
    return PushConstraint::kThetaLimit;
  }
  const auto broken = broken_between(move.contact, move.from.p_OF, move.to.p_OF);
  if (broken || (!limits_hand_ && !bodies_)) return broken;
  const PushContact& contact = model_.contacts[search.contacts[move.contact].contact];
  const PlanarPose X_WO = object_at_pusher(model_, contact, push_of(search, move).place);
  if (limits_hand_ && hand_is_out(contact, move, X_WO)) return PushConstraint::kReach;
  if (!bodies_) return std::nullopt;
  const std::int64_t before = bodies_->queries();
  const bool hit = collides(search, move, X_WO);
  work.other += kWorkOfQuery * (bodies_->queries() - before);
  return hit ? std::optional(PushConstraint::kCollision) : std::nullopt;
}

}  // namespace prehensile
