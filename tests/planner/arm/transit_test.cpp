#include "planner/arm/transit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/pad_law.h"
#include "planner/arm/arm_motion.h"
#include "planner/obstacles/confines_check.h"
#include "planner/planner.h"
#include "planner/search/frame.h"
#include "problems/confined_regrasps.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// A box in a hand with a palm, and a wall of this height across the way from one side to
/// the other, with a gap of this width if it is above 0.
Scene divided(double height, double gap) {
  Scene scene = published_square(0);
  scene.obstacles.emplace();
  scene.obstacles->hand.push_back({.name = "palm",
                                   .shape = BoxShape{{0.03, 0.03, 0.06}},
                                   .position = {0.08, 0.0, 0.0}});
  const double half = 0.5 * (1.0 - gap);
  for (const double side : {-1.0, 1.0}) {
    ConvexBody wall{.name = side < 0.0 ? "low wall" : "high wall",
                    .shape = BoxShape{{0.01, half, height}}};
    wall.position.y() = side * 0.5 * (gap + half);
    scene.obstacles->fixture.push_back(wall);
  }
  return scene;
}

/// A pose of the hand with the object at the origin of H.
HandPose at(double x, double y, double theta) { return {{x, y, theta}, 0.0}; }

/// Every millimetre and degree of a way keeps the distances.
void expect_clear(const Model& model, const PlanarPose& X_HO,
                  const std::vector<HandPose>& way) {
  const CollisionBodies bodies(model);
  const double least = model.scene.obstacles->clearance - kClearanceTolerance;
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (int k = 0; k <= 500; ++k) {
      const HandPose pose = between(way[i - 1], way[i], k / 500.0);
      EXPECT_GE(bodies.hand_distance(pose.X_WH, 1.0, pose.z), least);
      EXPECT_GT(bodies.object_distance(compose(pose.X_WH, X_HO), 1.0, pose.z), 0.0);
    }
  }
}

TEST(Transit, IsStraightWhereThatIsClear) {
  const Model model = prepare(divided(0.2, 0.5));
  const auto way = find_transit(model, {}, at(-0.3, 0.0, 0.0), at(0.3, 0.0, 0.0), 1);
  ASSERT_EQ(way.has_value(), collisions_are_built());
  if (!way) return;
  EXPECT_EQ(way->size(), 2U);
  expect_clear(model, {}, *way);
}

TEST(Transit, GoesOverALowWall) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const Model model = prepare(divided(0.05, 0.0));
  const auto way = find_transit(model, {}, at(-0.3, 0.0, 0.0), at(0.3, 0.1, 1.0), 1);
  ASSERT_TRUE(way);
  ASSERT_EQ(way->size(), 4U);
  EXPECT_NE((*way)[1].z, 0.0);
  expect_clear(model, {}, *way);
}

/// The palm fits through the gap only if the hand turns.
TEST(Transit, IsSearchedForWhereTheHandHasToTurn) {
  if (!collisions_are_built() || !frame_is_built()) {
    GTEST_SKIP() << "built without FCL or OMPL";
  }
  Scene scene = divided(4.0, 0.16);
  const Model model = prepare(scene);
  const double quarter = 0.5 * std::numbers::pi;
  const HandPose from = at(-0.3, 0.1, quarter), to = at(0.3, -0.1, quarter);
  EXPECT_FALSE(transit_is_clear(model, {}, from, to));
  const auto way = find_transit(model, {}, from, to, 3);
  ASSERT_TRUE(way);
  EXPECT_GT(way->size(), 2U);
  EXPECT_EQ(way->front().X_WH.theta, from.X_WH.theta);
  EXPECT_NEAR(std::remainder(way->back().X_WH.theta - quarter, 4.0 * quarter), 0.0, 1e-9);
  expect_clear(model, {}, *way);
  const auto again = find_transit(model, {}, from, to, 3);
  ASSERT_EQ(again->size(), way->size());
  for (std::size_t i = 0; i < way->size(); ++i) {
    EXPECT_EQ((*again)[i].X_WH.x, (*way)[i].X_WH.x);
    EXPECT_EQ((*again)[i].X_WH.theta, (*way)[i].X_WH.theta);
  }
}

TEST(Transit, IsNotFoundThroughAWall) {
  Scene within = divided(4.0, 0.02);
  for (const double side : {-1.0, 1.0}) {
    ConvexBody lid{.name = side < 0.0 ? "floor" : "lid",
                   .shape = BoxShape{{2.0, 2.0, 0.01}}};
    lid.position.z() = 0.12 * side;
    within.obstacles->fixture.push_back(lid);
  }
  within.limits.emplace();
  within.limits->hand_low = Vec2(-0.4, -0.3);
  within.limits->hand_high = Vec2(0.4, 0.3);
  const Model limited = prepare(within);
  EXPECT_FALSE(find_transit(limited, {}, at(-0.3, 0.0, 0.0), at(0.3, 0.0, 0.0), 1));
  EXPECT_FALSE(transit_is_clear(limited, {}, at(-0.3, 0.0, 0.0), at(0.3, 0.0, 0.0)));
}

/// Where nothing is near every clearance is kept, whatever its digits, at poses as on
/// ways of any length.
TEST(Transit, TheDigitsOfTheClearanceDoNotMatter) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  Random random(11);
  Scene scene = divided(0.2, 0.5);
  const HandPose here = at(-0.3, 0.0, 0.0);
  for (int i = 1; i <= 2000; ++i) {
    const double clearance = i <= 200 ? 1e-4 * i : std::pow(10.0, random.in(-4.0, -1.0));
    scene.obstacles->clearance = clearance;
    const Model model = prepare(scene);
    const TransitRoom room(model, {});
    EXPECT_TRUE(room.admits(here)) << clearance;
    const double step = std::pow(10.0, random.in(-19.0, -2.0));
    EXPECT_TRUE(room.is_clear(here, at(-0.3 - step, 0.0, 0.0))) << clearance;
  }
}

/// Bodies that overlap, and a hand that may touch, are not mistaken for clear.
TEST(Transit, NoClearanceIsNotOverlap) {
  Scene scene = divided(0.2, 0.0);
  scene.obstacles->clearance = 0.0;
  const Model model = prepare(scene);
  EXPECT_FALSE(TransitRoom(model, {}).admits(at(0.0, 0.0, 0.0)));
  EXPECT_FALSE(transit_is_clear(model, {}, at(0.0, 0.0, 0.0), at(0.0, 0.0, 0.0)));
}

TEST(Transit, KeepsTheLimitsOfTheHandsAngle) {
  GraspLimits limits;
  limits.hand_angle_low = -1.0;
  limits.hand_angle_high = 2.0;
  const auto stays = [&](double from, double to) {
    return hand_stays_within(limits, at(0.0, 0.0, from), at(0.0, 0.0, to));
  };
  const double turn = 2.0 * std::numbers::pi;
  EXPECT_TRUE(stays(-1.0, 2.0));
  EXPECT_TRUE(stays(2.0 + turn, -1.0 + turn));
  EXPECT_FALSE(stays(-1.0, 2.0 - turn));
  EXPECT_FALSE(stays(2.1, 0.0));
  EXPECT_FALSE(stays(0.0, turn));
}

/// A weight that hangs below the finger axis, and swings out of the grip where it is
/// turned to the side.
Scene hanging() {
  Scene scene = published_square(0);
  scene.object.p_OCom = Vec2(0.0, -0.04);
  scene.gripper.friction = {0.5, 0.5};
  return scene;
}

TEST(Transit, TurnsTheObjectOnlyAsTheGraspHoldsIt) {
  const Model model = prepare(hanging());
  const auto slack_at = [&](double angle) {
    return gravity_slack_by_pad_law(
        model, grasp_at(model, {}, rotated(-angle, model.scene.g_W)));
  };
  ASSERT_GT(slack_at(0.0), 0.0);
  ASSERT_LT(slack_at(0.5 * std::numbers::pi), 0.0);
  int held = 0, falls = 0;
  Random random(8);
  for (int i = 0; i < 80; ++i) {
    const double from = random.in(-3.0, 3.0), to = random.in(-3.0, 3.0);
    double least = 1.0;
    for (int k = 0; k <= 120; ++k) {
      least = std::min(least, slack_at(std::lerp(from, to, k / 120.0)));
    }
    const bool clear = transit_is_clear(model, {}, at(0.0, 0.0, from), at(0.1, 0.0, to));
    if (clear) {
      EXPECT_GT(least, 0.0) << from << ' ' << to;
    }
    if (least > 0.05) {
      EXPECT_TRUE(clear) << from << ' ' << to;
    }
    (clear ? held : falls) += 1;
  }
  EXPECT_GT(held, 5);
  EXPECT_GT(falls, 20);
}

TEST(Transit, FindsNoTurnThatTheGraspDoesNotHold) {
  const Model model = prepare(hanging());
  EXPECT_TRUE(find_transit(model, {}, at(0.0, 0.0, -0.1), at(0.1, 0.0, 0.1), 1));
  const HandPose below = at(0.0, 0.0, 0.0), above = at(0.1, 0.0, std::numbers::pi);
  EXPECT_FALSE(find_transit(model, {}, below, above, 1));
  EXPECT_TRUE(find_transit(model, {.grip_share = 100.0}, below, above, 1));
}

/// Nothing gets out of a block.
TEST(Transit, ArmsSayWhereNoWayIsFound) {
  Scene scene = published_tee(20);
  const Plan plan = plan_regrasp(prepare(scene));
  ASSERT_EQ(plan.placements, 2.0);
  EXPECT_TRUE(arm_motion(prepare(scene), plan).blocked_transits.empty());
  scene.obstacles.emplace();
  scene.obstacles->fixture.push_back(
      {.name = "block", .shape = BoxShape{{1.0, 1.0, 1.0}}});
  const ArmMotion motion = arm_motion(prepare(scene), plan);
  EXPECT_EQ(motion.blocked_transits, std::vector<int>{1});
}

/// Plans among walls and posts: their arms hit nothing on the way, straight transits of
/// some would.
TEST(Transit, ArmsKeepClearOfThePosts) {
  if (!collisions_are_built() || !frame_is_built()) {
    GTEST_SKIP() << "built without FCL or OMPL";
  }
  int transits = 0, straight = 0;
  for (int i = 0; i < 25; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const Model model = prepare(with_obstacles(published_tee(2 * i), 10, 7, index));
    const Plan plan = plan_regrasp(model);
    if (!plan.usable() || plan.pushes.size() < 2) continue;
    const ArmMotion motion = arm_motion(model, plan);
    EXPECT_TRUE(motion.blocked_transits.empty());
    const CollisionBodies bodies(model);
    const ArmSample* first = nullptr;
    for (const ArmSample& sample : motion.samples) {
      if (sample.phase != ArmPhase::kTransit) {
        first = nullptr;
        continue;
      }
      const Eigen::Matrix3d R = sample.X_WH.orientation.toRotationMatrix();
      const Vec3& p = sample.X_WH.position;
      const HandPose pose = {{p.x(), p.y(), std::atan2(R(1, 0), R(0, 0))}, p.z()};
      const PlanarPose& X_HO =
          plan.pushes[static_cast<std::size_t>(sample.push)].start.X_HO;
      EXPECT_GE(bodies.hand_distance(pose.X_WH, 1.0, pose.z),
                model.scene.obstacles->clearance - kClearanceTolerance);
      EXPECT_GT(bodies.object_distance(compose(pose.X_WH, X_HO), 1.0, pose.z), 0.0);
      transits += first == nullptr;
      first = &sample;
      straight += pose.z != 0.0;
    }
  }
  EXPECT_GT(transits, 5);
  EXPECT_GT(straight, 0);
}

}  // namespace
}  // namespace prehensile
