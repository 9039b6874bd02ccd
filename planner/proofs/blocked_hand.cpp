#include "planner/proofs/blocked_hand.h"

#include <algorithm>
#include <cmath>

#include "planner/obstacles/closeness.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/obstacles/placement.h"
#include "planner/proofs/goal_cover.h"

namespace prehensile {
namespace {

/// More than the collision check allows for rounding [m].
constexpr double kRoom = 1e-4;
constexpr int kLooksAway = 5;  // of the approach
constexpr int kMostBoxes = 300;

PlanarPose moved(const PlanarPose& pose, const Vec2& by) {
  return {pose.x + by.x(), pose.y + by.y(), pose.theta};
}

/// Poses of the object in the hand, and how far off them others may be.
struct Grasps {
  double theta = 0.0, half_turn = 0.0;   ///< [rad]
  double x = 0.0, y = 0.0, slack = 0.0;  ///< [m]
};

/// Places of a pusher along its face.
struct Places {
  double middle = 0.0, half = 0.0;  ///< [m]
};

/// Bodies that move together.
struct Group {
  std::vector<ConvexBody> bodies;
  double reach = 0.0;  ///< [m] of its farthest point from the z axis

  explicit Group(std::vector<ConvexBody> members) : bodies(std::move(members)) {
    for (const ConvexBody& body : bodies) reach = std::max(reach, reach_about_z(body));
  }
};

/// Looks at boxes of grasps and places: the middle of a box is hit so deep that all of it
/// is, or the box is divided, or a middle is free and nothing is proved.
class BlockedHand {
 public:
  explicit BlockedHand(const Model& model)
      : model_(model),
        obstacles_(*model.scene.obstacles),
        hand_(obstacles_.hand),
        palm_(palm_bodies(model)),
        object_(object_bodies(model)) {
    for (const ConvexBody& fixed : obstacles_.fixture) {
      ConvexBody centred = fixed;
      centred.position.setZero();
      radii_.push_back(reach_about_z(centred));
    }
  }

  bool blocks_all_contacts(const Grasps& grasps) {
    if (palm_blocks(grasps)) return true;
    boxes_ = 0;
    return std::ranges::all_of(model_.contacts, [&](const PushContact& contact) {
      return blocks(contact, grasps, {0.0, farthest_place(contact)});
    });
  }

 private:
  /// Whether the object is nearer to the palm than it may be at all grasps: no matter
  /// which contact.
  bool palm_blocks(const Grasps& grasps) {
    if (++boxes_ > kMostBoxes) return false;
    const double turned = grasps.half_turn * object_.reach;
    const double depth = obstacles_.clearance - kRoom - palm_closeness(grasps);
    if (depth > turned + grasps.slack) return true;
    if (!(depth > grasps.slack) || turned < kRoom) return false;
    Grasps half = grasps;
    half.half_turn *= 0.5;
    half.theta -= half.half_turn;
    if (!palm_blocks(half)) return false;
    half.theta += 2.0 * half.half_turn;
    return palm_blocks(half);
  }

  /// At the middle of a box.
  double palm_closeness(const Grasps& grasps) const {
    const Eigen::Isometry3d X_HO = in_space({grasps.x, grasps.y, grasps.theta}, 0.0);
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexBody& body : object_.bodies) {
      const PlacedBody placed{&body, X_HO * pose_of(body)};
      for (const ConvexBody& palm : palm_.bodies) {
        least = std::min(least, closeness(placed, {&palm, pose_of(palm)}));
      }
    }
    return least;
  }

  bool blocks(const PushContact& contact, const Grasps& grasps, const Places& places) {
    if (++boxes_ > kMostBoxes) return false;
    const double turned =
        grasps.half_turn * (hand_.reach + std::hypot(grasps.x, grasps.y));
    const double depth = depth_at(contact, grasps, places.middle, places.half, turned);
    if (depth > places.half + turned + grasps.slack) return true;
    if (!(depth > grasps.slack) || std::max(places.half, turned) < kRoom) return false;
    Grasps grasps_half = grasps;
    Places places_half = places;
    if (turned > places.half) {
      grasps_half.half_turn *= 0.5;
      grasps_half.theta -= grasps_half.half_turn;
      if (!blocks(contact, grasps_half, places)) return false;
      grasps_half.theta += 2.0 * grasps_half.half_turn;
      return blocks(contact, grasps_half, places);
    }
    places_half.half *= 0.5;
    places_half.middle -= places_half.half;
    if (!blocks(contact, grasps, places_half)) return false;
    places_half.middle += 2.0 * places_half.half;
    return blocks(contact, grasps, places_half);
  }

  /// How much nearer something comes to the fixture than it may, at the middle of a box,
  /// somewhere in the approach [m]; as soon as that is enough for the whole box.
  double depth_at(const PushContact& contact, const Grasps& grasps, double place,
                  double half_place, double turned) const {
    const PlanarPose X_WO = object_at_pusher(model_, contact, place);
    const PlanarPose X_WH = compose(X_WO, inverse({grasps.x, grasps.y, grasps.theta}));
    const Vec2 n = rotated(X_WO.theta, contact.n);
    const double enough = half_place + turned + grasps.slack;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kLooksAway && most <= enough; ++i) {
      const double off = obstacles_.approach * i / (kLooksAway - 1);
      const double of_hand =
          obstacles_.clearance - kRoom - closeness_of(hand_, moved(X_WH, off * n));
      // The object is where the pusher is, however it is held.
      const double of_object =
          -kRoom - closeness_of(object_, moved(X_WO, (kTouch + off) * n));
      most = std::max({most, of_hand, of_object + turned + grasps.slack});
    }
    return most;
  }

  double closeness_of(const Group& group, const PlanarPose& pose) const {
    double least = std::numeric_limits<double>::infinity();
    const Eigen::Isometry3d X_W = in_space(pose, 0.0);
    for (const ConvexBody& body : group.bodies) {
      const PlacedBody placed{&body, X_W * pose_of(body)};
      for (std::size_t i = 0; i < obstacles_.fixture.size(); ++i) {
        const ConvexBody& fixed = obstacles_.fixture[i];
        const double apart =
            (fixed.position.head<2>() - translation(pose)).norm() - radii_[i];
        if (apart > group.reach + obstacles_.clearance) continue;
        least = std::min(least, closeness(placed, {&fixed, pose_of(fixed)}));
      }
    }
    return least;
  }

  const Model& model_;
  const Obstacles& obstacles_;
  Group hand_, palm_, object_;
  std::vector<double> radii_;  // [m] of balls around the bodies of the fixture
  int boxes_ = 0;
};

}  // namespace

bool is_blocked_at_start(const Model& model) {
  if (!model.scene.obstacles) return false;
  const PlanarPose& start = model.scene.start.X_HO;
  BlockedHand blocked(model);
  return blocked.blocks_all_contacts({.theta = start.theta, .x = start.x, .y = start.y});
}

bool is_blocked_at_goal(const Model& model) {
  const Goal& goal = *model.scene.goal;
  // A roll would end with the hand at another height.
  if (!model.scene.obstacles || model.cross_section || goal.psi) return false;
  if (!goal.x || !goal.y || !goal.theta) return false;
  BlockedHand blocked(model);
  return blocked.blocks_all_contacts(
      {.theta = *goal.theta,
       .half_turn = std::min(angle_tolerance(goal), std::numbers::pi),
       .x = *goal.x,
       .y = *goal.y,
       .slack = place_tolerance(goal)});
}

}  // namespace prehensile
