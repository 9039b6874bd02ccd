#include "planner/steering/roll_step.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "planner/checks/plan_trial.h"
#include "planner/checks/replay.h"
#include "planner/obstacles/confines_check.h"
#include "planner/planner.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"
#include "tests/support/sections.h"

namespace prehensile {
namespace {

using testing::bar_on_sheet;
using testing::Random;

Scene can_on_floor() {
  Scene scene;
  scene.object.shape = CylinderShape{.radius = 0.03, .length = 0.1, .axis = Axis::kX};
  scene.object.mass = 0.3;
  scene.gripper.pad = RectanglePad{{0.02, 0.02}};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "floor",
                    .feature = LineFeature{},
                    .friction = 0.8,
                    .normal_angle = 0.5 * std::numbers::pi}};
  return scene;
}

Scene can_to_roll() {
  Scene scene = can_on_floor();
  scene.goal.emplace();
  scene.goal->psi = 1.5;
  return scene;
}

TEST(RollStep, SlackTellsWhichRollsComplete) {
  Random random(1);
  int rolls = 0;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    Scene scene = can_on_floor();
    scene.object.mass = random.log_in(0.05, 1.0);
    scene.pushers[0].friction = random.in(0.05, 1.0);
    const double friction = random.in(0.1, 0.95);
    scene.gripper.friction = {friction, friction};
    const Model model = prepare(scene);
    const Roll roll{.contact = 0,
                    .travel = random.chance(0.5) ? 0.01 : -0.01,
                    .grip_force = random.log_in(0.01, 20.0)};
    const double slack = roll_slack(model, scene.start, roll, Margin::none());
    if (std::abs(slack) < 1e-6) continue;
    EXPECT_EQ(apply(model, scene.start, roll).completed(), slack > 0.0) << i;
    (slack > 0.0 ? rolls : refused) += 1;
    EXPECT_LE(roll_slack(model, scene.start, roll, Margin{}), slack);
  }
  EXPECT_GT(rolls, 200);
  EXPECT_GT(refused, 200);
}

/// Held near its end a can would tilt instead of rolling: it is carried to where it
/// rolls.
TEST(RollStep, GoesWhereTheObjectRolls) {
  Scene scene = can_on_floor();
  scene.object.mass = 0.1;
  for (const double angle : {0.0, std::numbers::pi}) {
    scene.pushers.push_back({.name = "wall" + std::to_string(scene.pushers.size()),
                             .feature = LineFeature{},
                             .friction = 0.8,
                             .normal_angle = angle});
  }
  scene.start.X_HO = pose_from_finger({0.038, 0.0}, 0.0);
  scene.goal = testing::goal_at({0.037, 0.003}, 0.1);
  scene.goal->psi = 1.5;
  const Model model = prepare(scene);
  Plan there;
  there.start = scene.start;
  ASSERT_FALSE(insert_roll(model, 1.5, Margin{}, {}, there));
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << plan.message;
  EXPECT_GE(plan.pushes.size(), 3u);
  EXPECT_TRUE(replay(model, plan).agrees);
}

/// A plan that the roll is missing from is none, and has no pushes.
TEST(RollStep, WhatCannotRollHasNoPushes) {
  Scene scene = can_on_floor();
  scene.object.p_OCom = {0.0, 0.001};  // off the axis
  scene.goal = testing::goal_at({0.0, -0.004}, 0.0);
  scene.goal->psi = 1.5;
  const Plan plan = plan_regrasp(prepare(scene));
  EXPECT_EQ(plan.status, PlanStatus::kBudgetSpent);
  EXPECT_NE(plan.message.find("no contact rolls"), std::string::npos) << plan.message;
  EXPECT_TRUE(plan.pushes.empty());
}

TEST(RollStep, LoosensTheGripToRoll) {
  const Scene scene = can_to_roll();
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << plan.message;
  ASSERT_EQ(plan.pushes.size(), 1U);
  const Roll& roll = std::get<Roll>(plan.pushes[0].push);
  const double weight = 9.81 * scene.object.mass;
  EXPECT_GT(roll.grip_force, 0.0);
  EXPECT_LT(2.0 * 0.5 * roll.grip_force, weight);
  EXPECT_GE(plan.pushes[0].slack, 0.0);
  EXPECT_NEAR(plan.goal.psi, 1.5, 1e-9);
  EXPECT_NEAR(plan.cost, 1.0 + 0.03 * 1.5 / model.L, 1e-9);
  EXPECT_LE(plan.lower_bound, plan.cost);
}

TEST(RollStep, NoRollWithoutASupport) {
  Scene scene = can_on_floor();
  scene.pushers[0].friction = 0.0;
  Plan plan;
  plan.start = scene.start;
  EXPECT_FALSE(insert_roll(prepare(scene), 1.0, Margin{}, {}, plan));
  EXPECT_TRUE(plan.pushes.empty());
}

Plan plan_at(const Scene& scene) {
  Plan plan;
  plan.start = scene.start;
  return plan;
}

/// Only over whole sides: it stands elsewhere in the hand in between. The support goes as
/// far as the sides are long, which the bound counts on.
TEST(RollStep, PrismsRollFromSideToSide) {
  const Scene scene = bar_on_sheet();
  const Model model = prepare(scene);
  for (const int sides : {-2, -1, 1, 2}) {
    Plan plan = plan_at(scene);
    ASSERT_TRUE(insert_roll(model, 0.5 * kPi * sides, Margin{}, {}, plan)) << sides;
    const Grasp& end = plan.pushes[0].end;
    EXPECT_NEAR(end.psi, 0.5 * kPi * sides, 1e-9);
    EXPECT_NEAR(end.X_HO.x, scene.start.X_HO.x, 1e-12);
    EXPECT_NEAR(end.X_HO.y, scene.start.X_HO.y, 1e-12);
    EXPECT_EQ(end.X_HO.theta, scene.start.X_HO.theta);
    const Roll& roll = std::get<Roll>(plan.pushes[0].push);
    EXPECT_NEAR(std::abs(roll.travel), 0.03 * std::abs(sides), 1e-12);
    EXPECT_NEAR(std::abs(roll.travel), model.roll_radius * std::abs(end.psi), 1e-12);
    EXPECT_GT(roll.grip_force, 0.0);
    EXPECT_LT(roll.grip_force, 60.0);
  }
  for (const double dpsi : {0.3, 0.25 * kPi, 0.6 * kPi}) {
    Plan plan = plan_at(scene);
    EXPECT_FALSE(insert_roll(model, dpsi, Margin{}, {}, plan)) << dpsi;
    EXPECT_TRUE(plan.pushes.empty());
  }
}

TEST(RollStep, EachWidthOfTheMarginCanStopAPrism) {
  const Scene scene = bar_on_sheet();
  const Model model = prepare(scene);
  const Roll roll{.contact = 0, .travel = 0.03, .grip_force = 1.2};
  const double slack = roll_slack(model, scene.start, roll, Margin::none());
  EXPECT_GT(slack, 0.0);
  Margin narrow = Margin::none();
  narrow.friction = narrow.force = 0.01;
  narrow.grasp = 1e-4;
  const double less = roll_slack(model, scene.start, roll, narrow);
  EXPECT_GT(less, 0.0);
  EXPECT_LT(less, slack);
  for (double Margin::*width : {&Margin::friction, &Margin::force, &Margin::grasp}) {
    Margin wide = Margin::none();
    wide.*width = width == &Margin::grasp ? 0.003 : 0.7;
    EXPECT_LT(roll_slack(model, scene.start, roll, wide), 0.0);
  }
}

/// Whose centre of mass lies beside its middle looks different on another side.
TEST(RollStep, ALopsidedPrismRollsNotAtAll) {
  Scene scene = bar_on_sheet();
  scene.object.p_OCom = {0.0, 0.001};
  Plan plan = plan_at(scene);
  EXPECT_FALSE(insert_roll(prepare(scene), 0.5 * kPi, Margin::none(), {}, plan));
}

/// Whatever the margin is, all its corners were followed: so are members of the usual
/// box.
TEST(RollStep, RolledPrismsRollInTheUsualBox) {
  const Scene scene = testing::bar_among_walls();
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << plan.message;
  ASSERT_FALSE(plan.margin.is_none());
  EXPECT_TRUE(plan.rolls());
  EXPECT_TRUE(reaches(*scene.goal, plan.goal));
  EXPECT_LE(plan.lower_bound, plan.cost);
  EXPECT_GE(plan.lower_bound, 2.0 + 0.03 / model.L - 1e-9);
  EXPECT_TRUE(replay(model, plan).agrees);
  const UncertaintyBox box = usual_box();
  for (std::uint64_t i = 0; i < 100; ++i) {
    const PlanTrial trial = try_plan(model, plan, box, random_point(1, i));
    EXPECT_TRUE(trial.sticks) << i << ": " << name(trial.status);
  }
}

/// A bar of 4, 6, 8 or 12 sides, one of them on the sheet.
Scene random_bar(Random& random) {
  constexpr std::array kSides = {4, 6, 8, 12};
  const double inner = random.in(0.008, 0.025);
  const auto section = testing::regular_section(kSides[random.below(4)], inner);
  Scene scene = bar_on_sheet();
  scene.object.shape = PrismShape{section, 0.1, Axis::kX};
  scene.object.mass = random.log_in(0.02, 1.0);
  const double friction = random.log_in(0.02, 0.5);
  scene.gripper.friction = {friction, friction};
  scene.gripper.pad = RectanglePad{{0.03, random.chance(0.5) ? 0.002 : 0.006}};
  scene.gripper.grip_force = 9.81 * scene.object.mass / friction;
  scene.pushers[0].friction = random.in(0.5, 2.0);
  scene.start.X_HO.y = random.in(-0.5, 0.1) * inner;
  return scene;
}

/// The corners that are followed stand for all that lies between them.
TEST(RollStep, RollsOfRandomBarsSurviveTheMargin) {
  Random random(11);
  int rolled = 0;
  int tried = 0;
  int failed = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = random_bar(random);
    if (!check(scene).empty()) continue;
    const Model model = prepare(scene);
    Plan plan = plan_at(scene);
    const double dpsi = model.prism->same_after * (random.chance(0.5) ? 1.0 : -1.0);
    if (!insert_roll(model, dpsi, usual_margin(model), {}, plan)) continue;
    ++rolled;
    EXPECT_NEAR(plan.goal.psi, dpsi, 1e-9);
    for (std::uint64_t k = 0; k < 20; ++k) {
      const PlanTrial trial = try_plan(model, plan, usual_box(), random_point(7, k));
      if (!trial.is_scene) continue;  // held so near the rim that the pads may miss it
      ++tried;
      failed += !trial.sticks;
    }
  }
  EXPECT_GT(rolled, 8);
  EXPECT_LE(failed, tried / 200) << "of " << tried;
  std::printf("%d bars roll, %d of %d draws fail\n", rolled, failed, tried);
}

/// What the proof that nothing rolls a prism counts on.
TEST(RollStep, ASupportThatCarriesNothingRollsNoBar) {
  Random random(12);
  int tried = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene = random_bar(random);
    const double friction = random.log_in(0.02, 2.0);
    scene.gripper.friction = {friction, friction};
    scene.g_W = {0.0, random.chance(0.5) ? 0.0 : random.in(0.0, 9.81)};
    if (!check(scene).empty()) continue;
    ++tried;
    const Model model = prepare(scene);
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const Roll roll{.contact = 0,
                    .travel = side * model.roll_radius * model.prism->same_after,
                    .grip_force = random.log_in(0.1, 100.0)};
    EXPECT_FALSE(apply(model, scene.start, roll).completed()) << i;
  }
  EXPECT_GT(tried, 100);
}

TEST(RollStep, BaselinesRollPrismsToo) {
  const Model model = prepare(testing::bar_among_walls());
  for (const char* planner : {"motion-cone-tree", "random-shooting", "two-trees"}) {
    const Plan plan = plan_regrasp(model, {.planner = planner, .budget = 100'000});
    ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << planner << ": " << plan.message;
    EXPECT_TRUE(plan.rolls()) << planner;
    EXPECT_TRUE(replay(model, plan).agrees) << planner;
  }
}

/// A can whose plan rolls it does so whatever is off by as much as usual.
TEST(RollStep, RolledCansRollInTheUsualBox) {
  const Scene scene = can_to_roll();
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << plan.message;
  UncertaintyBox box = usual_box();
  const Grasp end = try_plan(model, plan, box, BoxPoint{}).end;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const BoxPoint at = random_point(1, i);
    const PlanTrial trial = try_plan(model, plan, box, at);
    EXPECT_TRUE(trial.sticks) << i << ": " << name(trial.status);
    // The angle by which the can is off in the hand stays.
    const double off = at[static_cast<std::size_t>(Unknown::kGraspAngle)];
    EXPECT_NEAR(trial.end.X_HO.theta - end.X_HO.theta, off * box[Unknown::kGraspAngle],
                1e-9);
  }
}

/// A ball over the edge that the bar tips about, clear of it before and after: the bar is
/// 30 mm high, and 42 mm while it stands on its edge. The table that it lies on is no
/// obstacle, a wall that it would roll into is one.
TEST(RollStep, PrismsRollWhereTheirWayOverTheirEdgesIsClear) {
  Scene scene = bar_on_sheet();
  scene.goal = testing::goal_at({0.0, 0.008}, 0.0);
  scene.goal->psi = 0.5 * kPi;
  scene.obstacles = Obstacles{.approach = 0.002};
  const auto status_with = [&](const ConvexBody& body) {
    Scene other = scene;
    other.obstacles->fixture = {body};
    const Plan plan = plan_regrasp(prepare(other));
    if (!plan.usable()) {
      EXPECT_NE(plan.message.find("no contact rolls"), std::string::npos) << plan.message;
    }
    return plan.status;
  };
  const auto ball_above = [](double height) {
    ConvexBody ball{.name = "ball", .shape = SphereShape{0.005}};
    ball.position = {0.03, height + 0.005, 0.015};
    return ball;
  };
  const auto wall_at = [](double z) {
    ConvexBody wall{.name = "wall", .shape = BoxShape{{0.2, 0.2, 0.02}}};
    wall.position = {0.0, 0.0, z + 0.01};
    return wall;
  };
  ConvexBody table{.name = "table", .shape = BoxShape{{0.4, 0.02, 0.4}}};
  table.position = {0.0, -0.01, 0.0};
  EXPECT_EQ(status_with(table), PlanStatus::kReachedGoal);
  EXPECT_EQ(status_with(ball_above(0.0426)), PlanStatus::kReachedGoal);
  EXPECT_EQ(status_with(ball_above(0.0422)), PlanStatus::kBudgetSpent);
  EXPECT_EQ(status_with(wall_at(0.0453)), PlanStatus::kReachedGoal);
  EXPECT_EQ(status_with(wall_at(0.0448)), PlanStatus::kBudgetSpent);
}

/// A ball of the hand over the edge that the bar tips about half-way, where the hand has
/// moved along with it: from 26 mm above the sheet it sees an edge at 42.4 mm.
TEST(RollStep, PrismsRollClearOfThePalm) {
  Scene scene = bar_on_sheet();
  scene.goal = testing::goal_at({0.0, 0.008}, 0.0);
  scene.goal->psi = 0.5 * kPi;
  const auto model_with = [&](double height) {
    ConvexBody ball{.name = "ball", .shape = SphereShape{0.005}};
    ball.position = {0.03, height + 0.005 - 0.026, 0.0};
    scene.obstacles = Obstacles{.clearance = 0.001, .approach = 0.002, .hand = {ball}};
    return prepare(scene);
  };
  const Model model = model_with(0.0436);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << plan.message;
  EXPECT_TRUE(replay(model, plan).agrees) << replay(model, plan).why;
  const PlannedPush& first = plan.pushes.front();
  ASSERT_TRUE(std::holds_alternative<Roll>(first.push));
  EXPECT_EQ(confinement_fault(model, {first}), "");
  EXPECT_NE(confinement_fault(model_with(0.0432), {first}).find("a body of the hand"),
            std::string::npos);
}

}  // namespace
}  // namespace prehensile
