#include "planner/steering/confines.h"

#include <gtest/gtest.h>

#include "planner/advice.h"
#include "planner/bounds/bounds.h"
#include "planner/catalogue.h"
#include "planner/checks/replay.h"
#include "planner/obstacles/collision_bodies.h"
#include "planner/obstacles/confines_check.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/obstacles/separation.h"
#include "problems/confined_regrasps.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr double kDegree = std::numbers::pi / 180.0;

PlanOptions nominal(std::int64_t budget = 1'000'000) {
  PlanOptions options;
  options.budget = budget;
  options.margin = Margin::none();
  return options;
}

/// Calls `look` with the pose of O in H at many points along every push.
template <class Look>
void along(const Plan& plan, const Look& look) {
  for (const PlannedPush& planned : plan.pushes) {
    const LinearPush push = as_linear(planned.push);
    for (int i = 0; i <= 200; ++i) {
      look(pusher_pose(push, planned.start.X_HO, i / 200.0), planned);
    }
  }
}

void expect_theta_within(const Plan& plan, const GraspLimits& limits) {
  along(plan, [&](const PlanarPose& X_HO, const PlannedPush&) {
    EXPECT_GE(X_HO.theta, limits.theta_low.value_or(-1e9) - 1e-8);
    EXPECT_LE(X_HO.theta, limits.theta_high.value_or(1e9) + 1e-8);
  });
}

/// The law of limits on theta: the plan keeps to them, the replay says so, and no bound
/// is above the cost.
void expect_confined(const Model& model, const Plan& plan) {
  expect_theta_within(plan, *model.scene.limits);
  const Replay again = replay(model, plan);
  EXPECT_TRUE(again.agrees) << again.why;
  EXPECT_LE(plan.lower_bound, plan.cost * (1.0 + 1e-9));
}

int solved_within_window(bool square, bool gravity, double window, int count) {
  int solved = 0;
  for (int i = 0; i < count; ++i) {
    const Scene scene = with_theta_window(
        random_among_walls(square, RegraspRange::kWide, gravity, 31, i), window);
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model, nominal());
    if (!plan.usable()) continue;
    ++solved;
    expect_confined(model, plan);
  }
  return solved;
}

TEST(Confines, NoPlanLeavesLimitsOnTheta) {
  EXPECT_EQ(solved_within_window(true, false, 20.0 * kDegree, 20), 20);
  EXPECT_GE(solved_within_window(false, false, 90.0 * kDegree, 5), 4);
}

TEST(Confines, FullNoPlanLeavesLimitsOnTheta) {
  EXPECT_GE(solved_within_window(false, false, 90.0 * kDegree, 40), 39);
  EXPECT_GE(solved_within_window(false, true, 90.0 * kDegree, 40), 35);
}

/// Without its limits the same scene turns farther, so that they do limit something.
TEST(Confines, LimitsChangePlans) {
  int changed = 0;
  for (int i = 0; i < 40; ++i) {
    Scene scene = with_theta_window(
        random_among_walls(true, RegraspRange::kWide, false, 32, i), 5.0 * kDegree);
    const GraspLimits limits = *scene.limits;
    scene.limits.reset();
    const Plan plan = plan_regrasp(prepare(scene), nominal());
    bool leaves = false;
    along(plan, [&](const PlanarPose& X_HO, const PlannedPush&) {
      leaves |= X_HO.theta < *limits.theta_low || X_HO.theta > *limits.theta_high;
    });
    changed += leaves;
  }
  EXPECT_GE(changed, 3);
}

TEST(Confines, ANumberCountsTurnsAnAngleDoesNot) {
  Scene scene = testing::walled_square();
  scene.goal = testing::goal_at({-0.02, 0.01}, scene.start.X_HO.theta + 0.1);
  *scene.goal->theta += 2.0 * std::numbers::pi;
  EXPECT_TRUE(reaches(*scene.goal, {pose_from_finger({-0.02, 0.01}, 0.2), 0.0}));
  const Plan angle = plan_regrasp(prepare(scene), nominal());
  scene.goal->theta_is = ThetaMeaning::kNumber;
  EXPECT_FALSE(reaches(*scene.goal, {pose_from_finger({-0.02, 0.01}, 0.2), 0.0}));
  const Model model = prepare(scene);
  const Plan number = plan_regrasp(model, nominal());
  ASSERT_TRUE(angle.usable());
  ASSERT_TRUE(number.usable()) << number.message;
  EXPECT_NEAR(number.goal.X_HO.theta, *scene.goal->theta, 0.02);
  EXPECT_LT(angle.goal.X_HO.theta, 1.0);
  EXPECT_GT(number.cost, angle.cost);
  EXPECT_GT(number.lower_bound, angle.lower_bound);
  EXPECT_TRUE(replay(model, number).agrees) << replay(model, number).why;
}

/// The bound of a number is never above a plan to it, and never below that of the angle.
TEST(Confines, BoundsOfNumbersHold) {
  for (int i = 0; i < 20; ++i) {
    Scene scene = random_among_walls(true, RegraspRange::kWide, i % 2 == 0, 33, i);
    const double as_angle = distance_to_goal(prepare(scene), scene.start, *scene.goal);
    scene.goal->theta_is = ThetaMeaning::kNumber;
    const Model model = prepare(scene);
    const double as_number = distance_to_goal(model, scene.start, *scene.goal);
    EXPECT_GE(as_number, as_angle - 1e-9);
    const Plan plan = plan_regrasp(model, nominal());
    ASSERT_TRUE(plan.usable()) << i << plan.message;
    EXPECT_LE(plan.lower_bound, plan.cost * (1.0 + 1e-9)) << i;
    EXPECT_FALSE(
        bound_holds(model, scene.start, *scene.goal, 1.03 * plan.cost, {.nodes = 800}));
  }
}

TEST(Confines, OneWindingIsLeftByNarrowLimits) {
  Scene scene = testing::walled_square();
  scene.goal = testing::goal_at({-0.02, 0.01}, 170.0 * kDegree);
  scene.limits = GraspLimits{.theta_low = -200.0 * kDegree, .theta_high = 20.0 * kDegree};
  const Goal goal = goal_within_limits(scene);
  EXPECT_EQ(goal.theta_is, ThetaMeaning::kNumber);
  EXPECT_NEAR(*goal.theta, -190.0 * kDegree, 1e-12);
  scene.limits->theta_high = 175.0 * kDegree;
  EXPECT_EQ(goal_within_limits(scene).theta_is, ThetaMeaning::kAngle);
}

TEST(Confines, GoalsBeyondLimitsAreRefusedWithAProof) {
  Scene scene = testing::walled_square();
  scene.goal = testing::goal_at({-0.02, 0.01}, 1.0);
  scene.limits = GraspLimits{.theta_low = -0.5, .theta_high = 0.5};
  const auto proof_of = [&] { return plan_regrasp(prepare(scene), nominal()).proof; };
  EXPECT_EQ(proof_of().kind, Proof::Kind::kGoalBeyondLimits);
  EXPECT_TRUE(verify(prepare(scene), proof_of()));
  scene.limits->theta_high = 0.99;  // within the tolerance of the goal
  EXPECT_NE(proof_of().kind, Proof::Kind::kGoalBeyondLimits);
  scene.limits = GraspLimits{.finger_low = Vec2(-0.01, -0.05)};
  EXPECT_EQ(proof_of().kind, Proof::Kind::kGoalBeyondLimits);
  scene.limits = GraspLimits{.finger_low = Vec2(-0.021, -0.05)};
  EXPECT_NE(proof_of().kind, Proof::Kind::kGoalBeyondLimits);
}

TEST(Confines, NoPlanLeavesTheBoxOfTheFinger) {
  int solved = 0;
  for (int i = 0; i < 40; ++i) {
    Scene scene = random_among_walls(true, RegraspRange::kWide, false, 34, i);
    const Vec2 from = finger_in_object(scene.start.X_HO);
    const Vec2 to =
        finger_in_object({*scene.goal->x, *scene.goal->y, *scene.goal->theta});
    const Vec2 room = Vec2::Constant(4e-3);
    scene.limits = GraspLimits{.finger_low = from.cwiseMin(to) - room,
                               .finger_high = from.cwiseMax(to) + room};
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model, nominal());
    if (!plan.usable()) continue;
    ++solved;
    along(plan, [&](const PlanarPose& X_HO, const PlannedPush&) {
      const Vec2 p = finger_in_object(X_HO);
      EXPECT_TRUE((p.array() >= scene.limits->finger_low->array() - 1e-8).all());
      EXPECT_TRUE((p.array() <= scene.limits->finger_high->array() + 1e-8).all());
    });
    EXPECT_TRUE(replay(model, plan).agrees) << replay(model, plan).why;
  }
  EXPECT_GE(solved, 25);
}

/// Walls that stand apart, so that a box of the hand in W forbids one of them.
TEST(Confines, TheHandStaysInItsBox) {
  Scene scene = with_obstacles(
      random_among_walls(true, RegraspRange::kPublished, false, 3, 0), 0, 1, 0);
  scene.obstacles.reset();
  const Plan before = plan_regrasp(prepare(scene), nominal());
  ASSERT_TRUE(before.usable());
  const auto uses = [&](const Model& model, const Plan& plan, const std::string& name) {
    return std::any_of(plan.pushes.begin(), plan.pushes.end(), [&](const PlannedPush& p) {
      const auto index = static_cast<std::size_t>(contact_of(p.push));
      return model.scene.pushers[static_cast<std::size_t>(model.contacts[index].pusher)]
                 .name == name;
    });
  };
  ASSERT_TRUE(uses(prepare(scene), before, "wall"));
  scene.limits = GraspLimits{.hand_low = Vec2(-0.15, -1.0)};  // the wall stands at -0.3
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model, nominal());
  EXPECT_FALSE(uses(model, plan, "wall"));
  EXPECT_GT(plan.stopped_by[PushConstraint::kReach], 0);
  if (plan.usable()) {
    EXPECT_TRUE(replay(model, plan).agrees) << replay(model, plan).why;
  }
}

TEST(Confines, TheAngleOfTheHandIsLimited) {
  int solved = 0;
  for (int i = 0; i < 10; ++i) {
    Scene scene = random_among_walls(true, RegraspRange::kWide, false, 35, i);
    const double start = scene.start.X_HO.theta;
    const double goal = start + wrapped(*scene.goal->theta - start);
    // H in W is at minus theta, for O is not turned at any of the walls.
    const double low = -std::max(start, goal) - 0.3 + 2.0 * std::numbers::pi;
    const double high = -std::min(start, goal) + 0.3 + 2.0 * std::numbers::pi;
    scene.limits = GraspLimits{.hand_angle_low = low, .hand_angle_high = high};
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model, nominal());
    if (!plan.usable()) continue;
    ++solved;
    along(plan, [&](const PlanarPose& X_HO, const PlannedPush&) {
      const double middle = 0.5 * (low + high);
      EXPECT_LE(std::abs(wrapped(-X_HO.theta - middle)), 0.5 * (high - low) + 1e-6);
    });
    EXPECT_TRUE(replay(model, plan).agrees) << replay(model, plan).why;
  }
  EXPECT_GE(solved, 7);
}

TEST(Confines, AllPlannersKeepToLimits) {
  for (const std::string planner : {"random-shooting", "motion-cone-tree", "two-trees",
                                    "RRTConnect", "control::RRT"}) {
    if (!planner_fault(planner, {}).empty()) continue;
    int solved = 0;
    for (int i = 0; i < 6; ++i) {
      const Scene scene = with_theta_window(
          random_among_walls(true, RegraspRange::kPublished, false, 36, i),
          3.0 * kDegree);
      const Model model = prepare(scene);
      PlanOptions options = nominal(30'000);
      options.planner = planner;
      options.polish = false;
      const Plan plan = plan_regrasp(model, options);
      if (!plan.usable()) continue;
      ++solved;
      expect_confined(model, plan);
    }
    EXPECT_GE(solved, 1) << planner;
  }
}

/// A plan that is edited to leave the limits fails.
TEST(Confines, ReplayRefusesAPlanBeyondLimits) {
  Scene scene = random_among_walls(true, RegraspRange::kWide, false, 37, 1);
  const Plan plan = plan_regrasp(prepare(scene), nominal());
  ASSERT_TRUE(plan.usable());
  const double start = scene.start.X_HO.theta;
  const double end = plan.goal.X_HO.theta;
  ASSERT_GT(std::abs(end - start), 0.1);
  scene.limits.emplace();
  (end > start ? scene.limits->theta_high : scene.limits->theta_low) =
      0.5 * (start + end);
  const Replay again = replay(prepare(scene), plan);
  EXPECT_FALSE(again.agrees);
  EXPECT_NE(again.why.find("angle of the object leaves its limits"), std::string::npos)
      << again.why;
}

/// Distance of the hand's only body from a square between the pads, the least at many
/// poses along a move.
double palm_distance_along(const Model& model, const Move& move) {
  const ConvexBody& palm = model.scene.obstacles->hand.front();
  const std::vector<ConvexBody> square = object_bodies(model);
  double least = 1.0;
  for (int i = 0; i <= 400; ++i) {
    const double s = i / 400.0;
    const Vec2 p_OF = move.from.p_OF + s * (move.to.p_OF - move.from.p_OF);
    const double theta = std::lerp(move.from.theta, move.to.theta, s);
    const PlanarPose X_HO = pose_from_finger(p_OF, theta);
    least = std::min(least, separation({&palm, pose_of(palm)},
                                       {&square.front(), in_space(X_HO, 0.0)}));
  }
  return least;
}

/// The law of a palm: a move that is free keeps its clearance, and one that is not comes
/// as near as that, but for a resolution.
TEST(Confines, NoMoveBringsTheObjectIntoThePalm) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  Random random(9);
  int free = 0;
  int hit = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene = testing::walled_square();
    const double away = random.in(0.04, 0.12);
    const ConvexBody palm{.name = "palm",
                          .shape = BoxShape{{0.02, random.log_in(0.001, 0.05), 0.07}},
                          .position = {away, 0.0, 0.0},
                          .turn = random.in(-1.0, 1.0)};
    scene.obstacles = Obstacles{.clearance = random.in(0.0, 0.004), .hand = {palm}};
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto state = [&] {
      return FlatState{random.in_box(0.03, 0.03), random.in(-1.5, 1.5)};
    };
    const Move move{0, state(), state()};
    Work work;
    const auto broken = search.confines->broken_by(search, move, work);
    const double room = palm_distance_along(model, move) - scene.obstacles->clearance;
    if (broken) {
      EXPECT_EQ(*broken, PushConstraint::kCollision);
      EXPECT_LT(room, 5e-4) << i;
      ++hit;
    } else {
      EXPECT_GT(room, 0.0) << i;
      ++free;
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(hit, 50);
}

TEST(Confines, AdviceNamesTheLimit) {
  Scene scene = testing::walled_square();
  scene.g_W = Vec2::Zero();
  scene.goal = testing::goal_at({-0.02, 0.01}, 0.3);
  scene.goal->theta_is = ThetaMeaning::kNumber;
  *scene.goal->theta += 2.0 * std::numbers::pi;
  scene.limits = GraspLimits{.theta_low = -0.5, .theta_high = 2.0};
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model, nominal());
  ASSERT_EQ(plan.status, PlanStatus::kInfeasible);
  const Explanation why = explain(model, plan, nominal());
  const auto is_named = [&](const std::string& option) {
    return std::any_of(why.changes.begin(), why.changes.end(),
                       [&](const ProposedChange& change) {
                         return change.option.find(option) != std::string::npos;
                       });
  };
  EXPECT_TRUE(is_named("--set goal.theta_is=angle")) << why.text;
}

}  // namespace
}  // namespace prehensile
