#include "planner/arm/transit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/obstacles/confines_check.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/steering/holding.h"

namespace prehensile {
namespace {

using Way = std::vector<HandPose>;

constexpr double kResolution = 5e-6;  // [m]
constexpr double kLeastReach = 1e-3;  // [m]
constexpr double kRounding = 1e-9;    // of limits, [m] and [rad]
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStepOfTurn = 0.05;  // [rad] between two looks at gravity
constexpr int kMostLooks = 5000;      // at one straight way: it would hug an obstacle

/// Length that no point of hand and object exceeds on a straight way [m].
double longest_way(const HandPose& from, const HandPose& to, double reach) {
  const Vec3 d(to.X_WH.x - from.X_WH.x, to.X_WH.y - from.X_WH.y, to.z - from.z);
  return d.norm() + reach * std::abs(to.X_WH.theta - from.X_WH.theta);
}

bool is_clear(const TransitRoom& room, const Way& way) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (!room.is_clear(way[i - 1], way[i])) return false;
  }
  return true;
}

/// Over the fixture, or under it, as low as a few heights allow.
Way over_fixture(const TransitRoom& room, const HandPose& from, const HandPose& to) {
  const TransitRoom::Box box = room.box_around(from, to);
  for (const double share : {0.25, 0.5, 1.0}) {
    for (const double end : {box.high.z(), box.low.z()}) {
      HandPose up = from;
      HandPose across = to;
      up.z += share * (end - from.z);
      across.z = up.z;
      const Way way = {from, up, across, to};
      if (is_clear(room, way)) return way;
    }
  }
  return {};
}

/// Leaves out way-points where the straight way past them is clear.
Way shortened(const TransitRoom& room, const Way& way) {
  Way shorter = {way.front()};
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = way.size() - 1;
    while (next > at + 1 && !room.is_clear(way[at], way[next])) --next;
    shorter.push_back(way[next]);
    at = next;
  }
  return shorter;
}

Way any_way(const TransitRoom& room, const HandPose& from, const HandPose& to,
            std::uint64_t seed) {
  if (room.is_clear(from, to)) return {from, to};
  Way way = over_fixture(room, from, to);
  if (way.empty()) way = search_transit(room, from, to, seed);
  return way.empty() ? way : shortened(room, way);
}

}  // namespace

TransitRoom::TransitRoom(const Model& model, const HeldObject& held)
    : model_(model),
      held_(held),
      bodies_(model),
      clearance_(model.scene.obstacles.value_or(Obstacles{}).clearance) {
  const double object = translation(held.X_HO).norm() + bodies_.object_reach();
  reach_ = std::max({bodies_.hand_reach(), object, kLeastReach});
}

bool TransitRoom::is_clear(const HandPose& from, const HandPose& to) const {
  return stays_within_limits(from, to) && holds(from, to) &&
         (!model_.scene.obstacles || keeps_clear(from, to));
}

/// Boxes are convex; angles are counted from the whole turn below the limits.
bool TransitRoom::stays_within_limits(const HandPose& from, const HandPose& to) const {
  const GraspLimits limits = model_.scene.limits.value_or(GraspLimits{});
  for (const HandPose* pose : {&from, &to}) {
    const Vec2 p = translation(pose->X_WH);
    if (limits.hand_low && !(p.array() >= limits.hand_low->array() - kRounding).all()) {
      return false;
    }
    if (limits.hand_high && !(p.array() <= limits.hand_high->array() + kRounding).all()) {
      return false;
    }
  }
  if (!limits.hand_angle_low) return true;
  const auto [low, high] = std::minmax(from.X_WH.theta, to.X_WH.theta);
  const double turns = std::ceil((*limits.hand_angle_low - low - kRounding) / kTurn);
  return high + kTurn * turns <= *limits.hand_angle_high + kRounding ||
         *limits.hand_angle_high - *limits.hand_angle_low >= kTurn;
}

bool TransitRoom::holds(const HandPose& from, const HandPose& to) const {
  const Vec2 g_W = model_.scene.g_W / held_.grip_share;
  if (g_W.isZero(0.0)) return true;
  const double turn = to.X_WH.theta - from.X_WH.theta;
  const int parts = static_cast<int>(std::ceil(std::abs(turn) / kStepOfTurn));
  Work work;
  for (int i = 0; i <= parts; ++i) {
    const double share = parts > 0 ? static_cast<double>(i) / parts : 0.0;
    const double angle = std::lerp(from.X_WH.theta, to.X_WH.theta, share);
    const Vec2 g_O = rotated(-angle - held_.X_HO.theta, g_W);
    if (!pads_hold_gravity(model_, held_.X_HO, g_O, work)) return false;
  }
  return true;
}

bool TransitRoom::keeps_clear(const HandPose& from, const HandPose& to) const {
  // What touches has a distance of 0, so something has to be left of any need.
  const double need = std::max(0.0, clearance_ - 0.5 * kClearanceTolerance);
  const double way = longest_way(from, to, reach_);
  double done = 0.0;
  for (int look = 0; look < kMostLooks; ++look) {
    const double left = way - done;
    // Far above what is compared with it: sums with the clearance are rounded.
    const double enough = left + 2.0 * kResolution;
    const HandPose at = between(from, to, way > 0.0 ? done / way : 0.0);
    const double hand = bodies_.hand_distance(at.X_WH, need + enough, at.z) - need;
    const double object =
        bodies_.object_distance(compose(at.X_WH, held_.X_HO), enough, at.z);
    const double room = std::min(hand, object);
    if (room < kResolution) return false;
    if (room >= left) return true;
    done += room - 0.5 * kResolution;
  }
  return false;
}

TransitRoom::Box TransitRoom::box_around(const HandPose& a, const HandPose& b) const {
  const Vec3 p(a.X_WH.x, a.X_WH.y, a.z);
  const Vec3 q(b.X_WH.x, b.X_WH.y, b.z);
  Box box{p.cwiseMin(q), p.cwiseMax(q)};
  const Obstacles obstacles = model_.scene.obstacles.value_or(Obstacles{});
  for (const ConvexBody& body : obstacles.fixture) {
    ConvexBody centred = body;
    centred.position.setZero();
    const double radius = reach_about_z(centred);
    if (!std::isfinite(radius)) continue;
    box.low = box.low.cwiseMin((body.position.array() - radius).matrix());
    box.high = box.high.cwiseMax((body.position.array() + radius).matrix());
  }
  double height = model_.half_thickness;
  for (const ConvexBody& body : obstacles.hand) {
    ConvexBody upright = body;
    upright.position.setZero();
    height = std::max(height, std::abs(body.position.z()) + reach_about_z(upright));
  }
  const double beside = reach_ + 2.0 * clearance_;
  const Vec3 room(beside, beside, height + 2.0 * clearance_);
  return {box.low - room, box.high + room};
}

std::optional<Way> find_transit(const Model& model, const HeldObject& held,
                                const HandPose& from, const HandPose& to,
                                std::uint64_t seed) {
  const Way way = any_way(TransitRoom(model, held), from, to, seed);
  if (way.empty()) return std::nullopt;
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (!transit_is_clear(model, held, way[i - 1], way[i])) return std::nullopt;
  }
  return way;
}

}  // namespace prehensile
