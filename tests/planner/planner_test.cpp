#include "planner/planner.h"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "planner/bounds/bounds.h"
#include "planner/chains/direct_push.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/replay.h"
#include "planner/finish/polish.h"
#include "planner/search/push_search.h"
#include "planner/steering/goal.h"
#include "planner/steering/limits.h"
#include "primitives/uncertainty.h"
#include "problems/random_fixtures.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::kNoBudget;
using testing::NoHeapScope;
using testing::Random;
using testing::walled_square;

double seconds_of_search(const Model& model) {
  const PlanOptions options;
  const auto begin = std::chrono::steady_clock::now();
  const SearchModel search = prepare_search(model, usual_margin(model));
  Work work{.budget = options.budget};
  search_pushes(search, model.scene.start, *model.scene.goal, options, work);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  return spent.count();
}

/// Plans, checks and replays; the cost never beats its bound.
::testing::AssertionResult solves(const Model& model, const PlanOptions& options = {}) {
  const Plan plan = plan_regrasp(model, options);
  if (plan.status != PlanStatus::kReachedGoal) {
    return ::testing::AssertionFailure() << name(plan.status) << ": " << plan.message;
  }
  const Replay result = replay(model, plan);
  if (!result.agrees) return ::testing::AssertionFailure() << result.why;
  if (plan.cost < plan.lower_bound - 1e-12) {
    return ::testing::AssertionFailure() << plan.cost << " beats " << plan.lower_bound;
  }
  return ::testing::AssertionSuccess();
}

TEST(Planner, SolvesThePublishedRegrasps) {
  std::vector<double> seconds;
  for (int i = 0; i < kPublishedRegrasps; ++i) {
    for (const Scene& scene : {published_square(i), published_tee(i)}) {
      const Model model = prepare(scene);
      EXPECT_TRUE(solves(model)) << scene.name;
      seconds.push_back(seconds_of_search(model));
    }
  }
  testing::print_times("search, published regrasps", seconds);
}

void solve_constructed(RegraspFamily family, const std::string& what, int first,
                       int count) {
  std::vector<double> seconds;
  int several_pushers = 0;
  for (int i = first; i < first + count; ++i) {
    const RandomRegrasp regrasp = random_regrasp(family, 1, i);
    several_pushers += regrasp.pushers >= 2;
    const Model model = prepare(regrasp.scene);
    EXPECT_TRUE(solves(model)) << what << " " << i;
    seconds.push_back(seconds_of_search(model));
  }
  EXPECT_GE(2 * several_pushers, count);
  testing::print_times("search, constructed regrasps, " + what, seconds);
}

/// Soft points are checked by their own law, the ellipsoid, and know no edge of the face.
TEST(Planner, SolvesThePublishedRegraspsWithSoftPoints) {
  for (int i = 0; i < kPublishedRegrasps; ++i) {
    for (Scene scene : {published_square(i), published_tee(i)}) {
      scene = with_soft_points(scene);
      const Model model = prepare(scene);
      EXPECT_TRUE(solves(model)) << scene.name;
      const PlanOptions nominal{.margin = Margin::none()};
      EXPECT_TRUE(solves(model, nominal)) << scene.name;
      const Plan plan = plan_regrasp(model, nominal);
      scene.overhang = Overhang::kClip;
      const Plan clipped = plan_regrasp(prepare(scene), nominal);
      EXPECT_EQ(clipped.cost, plan.cost) << scene.name;
    }
  }
}

TEST(Planner, SolvesConstructedBoxes) {
  solve_constructed(RegraspFamily::kBox, "boxes", 0, 100);
}
TEST(Planner, SolvesConstructedTees) {
  solve_constructed(RegraspFamily::kTee, "Ts", 0, 100);
}
TEST(Planner, SolvesConstructedCans) {
  solve_constructed(RegraspFamily::kCylinder, "cans", 0, 40);
}

TEST(Planner, FullSolvesMoreConstructedRegrasps) {
  solve_constructed(RegraspFamily::kBox, "boxes", 100, 400);
  solve_constructed(RegraspFamily::kTee, "Ts", 100, 400);
  solve_constructed(RegraspFamily::kCylinder, "cans", 40, 460);
}

TEST(Planner, ConstructionsReplay) {
  for (int i = 0; i < 30; ++i) {
    const RandomRegrasp regrasp = random_regrasp(static_cast<RegraspFamily>(i % 3), 3, i);
    const Model model = prepare(regrasp.scene);
    Grasp grasp = regrasp.scene.start;
    for (const Push& push : regrasp.pushes) {
      const Transition done = apply(model, grasp, push);
      ASSERT_TRUE(done.completed()) << i << ": " << done.reason;
      grasp = done.end;
    }
    EXPECT_TRUE(reaches(*regrasp.scene.goal, grasp)) << i;
    EXPECT_EQ(random_regrasp(static_cast<RegraspFamily>(i % 3), 3, i).scene.start,
              regrasp.scene.start);
  }
}

TEST(Planner, DirectPushUsesNoHeap) {
  int direct = 0;
  for (int i = 0; i < kPublishedRegrasps; ++i) {
    const Model model = prepare(published_square(i));
    const SearchModel search = prepare_search(model, Margin{});
    const FlatState start = flat_state(model.scene.start);
    Work work{.budget = kNoBudget};
    const NoHeapScope scope;
    const GoalPlaces places = goal_places(model, *model.scene.goal, start);
    direct += direct_push(search, start, places, work).has_value();
    EXPECT_EQ(scope.allocations(), testing::heap_is_counted() ? 0 : -1);
  }
  EXPECT_GT(direct, 40);
}

TEST(Planner, SameSeedAndBudgetSamePlan) {
  for (const RegraspFamily family : {RegraspFamily::kTee, RegraspFamily::kCylinder}) {
    const Model model = prepare(random_regrasp(family, 1, 4).scene);
    const Plan first = plan_regrasp(model);
    const Plan second = plan_regrasp(model);
    ASSERT_EQ(first.pushes.size(), second.pushes.size());
    for (std::size_t i = 0; i < first.pushes.size(); ++i) {
      EXPECT_EQ(first.pushes[i].end, second.pushes[i].end);
    }
    EXPECT_EQ(first.stick_tests, second.stick_tests);
    EXPECT_EQ(first.cost, second.cost);
  }
}

TEST(Planner, SmallBudgetIsUndecidedAndSaysSo) {
  Scene scene = walled_square();
  scene.goal = goal_at({0.03, 0.002}, 0.1);  // against the only wall in x: two pushers
  const Model model = prepare(scene);
  EXPECT_TRUE(solves(model));
  PlanOptions options;
  options.budget = 5;
  const Plan plan = plan_regrasp(model, options);
  EXPECT_EQ(plan.status, PlanStatus::kBudgetSpent);
  EXPECT_FALSE(plan.usable());
  EXPECT_TRUE(plan.pushes.empty());
  EXPECT_NE(plan.message.find("budget"), std::string::npos) << plan.message;
}

TEST(Planner, StopFlagStops) {
  Scene scene = walled_square();
  scene.goal = goal_at({0.03, 0.002}, 0.1);
  const std::atomic<bool> stop{true};
  PlanOptions options;
  options.stop = &stop;
  EXPECT_EQ(plan_regrasp(prepare(scene), options).status, PlanStatus::kStopped);
}

TEST(Planner, StartAtTheGoalIsNothingToDo) {
  Scene scene = walled_square();
  scene.goal = goal_at(finger_in_object(scene.start.X_HO), 0.1);
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  EXPECT_EQ(plan.status, PlanStatus::kNothingToDo);
  EXPECT_EQ(plan.cost, 0.0);
  EXPECT_EQ(plan.lower_bound, 0.0);
  EXPECT_TRUE(replay(model, plan).agrees);
}

TEST(Planner, UnknownPlannerAndMissingGoalAreSaid) {
  Scene scene = walled_square();
  PlanOptions options;
  options.planner = "oracle";
  EXPECT_EQ(plan_regrasp(prepare(scene), options).status, PlanStatus::kUnsupported);
  scene.goal.reset();
  EXPECT_EQ(plan_regrasp(prepare(scene)).status, PlanStatus::kUnsupported);
}

TEST(Planner, FreeCoordinatesAreFilled) {
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    Scene scene = i % 2 == 0 ? published_square(i) : published_tee(i);
    scene.goal->test = GoalTest::kPerCoordinate;
    if (i % 3 != 0) scene.goal->theta.reset();
    if (i % 3 != 1) (random.chance(0.5) ? scene.goal->x : scene.goal->y).reset();
    EXPECT_TRUE(solves(prepare(scene))) << i;
  }
}

TEST(Planner, FreeGoalsCostNoMoreThanFixedOnes) {
  for (int i = 0; i < 20; ++i) {
    Scene scene = published_square(i);
    const Plan fixed = plan_regrasp(prepare(scene));
    scene.goal->theta.reset();
    const Plan free = plan_regrasp(prepare(scene));
    ASSERT_TRUE(fixed.usable() && free.usable());
    EXPECT_LE(free.lower_bound, fixed.lower_bound + 1e-6);
    EXPECT_LE(free.placements, fixed.placements);
  }
}

TEST(Planner, WholeTurnsOfTheStartDoNotMatter) {
  for (const int turns : {-2, -1, 1, 3}) {
    Scene scene = published_tee(10);
    const Plan plan = plan_regrasp(prepare(scene));
    scene.start.X_HO = pose_from_finger(finger_in_object(scene.start.X_HO),
                                        scene.start.X_HO.theta + 2.0 * kPi * turns);
    const Model model = prepare(scene);
    const Plan turned = plan_regrasp(model);
    ASSERT_TRUE(turned.usable());
    EXPECT_TRUE(replay(model, turned).agrees);
    EXPECT_NEAR(turned.cost, plan.cost, 1e-6);
  }
}

TEST(Planner, PolishNeverLengthens) {
  for (int i = 0; i < 40; ++i) {
    const Model model = prepare(random_regrasp(RegraspFamily::kTee, 9, i).scene);
    const Plan eased = plan_regrasp(model);
    const Plan polished = plan_regrasp(model, {.ease = 0.0});
    const Plan rough = plan_regrasp(model, {.polish = false});
    ASSERT_TRUE(eased.usable() && polished.usable() && rough.usable()) << i;
    EXPECT_LE(polished.cost, rough.cost + 1e-12) << i;
    EXPECT_LE(eased.cost, (1.0 + PlanOptions().ease) * polished.cost + 1e-12) << i;
  }
}

/// Shortest runs bend: two placements, and more than two pushes.
TEST(Planner, PolishBendsPushes) {
  int bent = 0;
  for (const std::uint64_t i : {12, 39}) {
    Scene scene =
        with_soft_points(random_among_walls(false, RegraspRange::kWide, false, 1, i));
    scene.goal->position_tolerance = 1e-6;
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model, {.margin = Margin::none()});
    const Plan rough = plan_regrasp(model, {.margin = Margin::none(), .polish = false});
    ASSERT_TRUE(plan.usable() && rough.usable());
    EXPECT_TRUE(replay(model, plan).agrees);
    EXPECT_LE(plan.cost, rough.cost);
    bent += static_cast<int>(plan.pushes.size()) > plan.placements;
  }
  EXPECT_GT(bent, 0);
}

/// Every push of such a plan sticks in the same scene without gravity, too.
TEST(Planner, WithoutTheHelpOfGravityPushesStickWithoutGravity) {
  int pushes = 0, helped = 0;
  for (int i = 0; i < 40; ++i) {
    Scene scene = random_among_walls(i % 2 == 0, RegraspRange::kWide, true, 2, i);
    if (i % 4 < 2) scene = with_soft_points(scene);
    const Model model = prepare(scene);
    PlanOptions options{.margin = Margin::none(), .nominal_if_needed = false};
    const Plan nominal = plan_regrasp(model, options);
    options.margin->weightless = true;
    const Plan plan = plan_regrasp(model, options);
    if (!plan.usable()) continue;
    EXPECT_TRUE(replay(model, plan).agrees) << i;
    scene.g_W.setZero();
    const Model floating = prepare(scene);
    const auto sticks = [&](const PlannedPush& push) {
      return push_slack(floating, push.start, push.push, Margin::none()) >= -1e-9;
    };
    for (const PlannedPush& push : plan.pushes) EXPECT_TRUE(sticks(push)) << i;
    pushes += static_cast<int>(plan.pushes.size());
    helped += !std::all_of(nominal.pushes.begin(), nominal.pushes.end(), sticks);
  }
  EXPECT_GT(pushes, 40);
  EXPECT_GT(helped, 0);
}

TEST(Planner, PlansSurviveTheirMarginBox) {
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    const Model model = prepare(random_regrasp(RegraspFamily::kBox, 11, i).scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable());
    for (int k = 0; k < 20; ++k) {
      Scene other = model.scene;
      other.object.mass *= random.in(0.91, 1.09);
      for (Pusher& pusher : other.pushers) pusher.friction *= random.in(0.91, 1.0);
      other.object.p_OCom = model.p_OCom + random.in_disc(0.9e-3);
      const Model changed = prepare(other);
      for (const PlannedPush& push : plan.pushes) {
        const Transition done = apply(changed, push.start, push.push);
        const bool held = done.status != TransitionStatus::kFalls;
        if (!held) continue;  // the grasp itself, not the push, is at its limit there
        EXPECT_TRUE(done.completed()) << i << ": " << done.reason;
        EXPECT_EQ(done.slipped, 0.0) << i;
      }
    }
  }
}

/// One or two walls: some plans turn many times, and what is returned holds with half the
/// step, too.
TEST(Planner, PlansOfManyTurnsReplay) {
  FixtureRange range;
  range.count = {1.0, 2.0};
  range.goals = GoalsFrom::kRandom;
  int many = 0;
  for (const int index : {0, 11, 17, 143, 194}) {
    const auto problem = random_fixture(range, 1, index);
    ASSERT_TRUE(problem) << index;
    const Model model = prepare(problem->scene);
    const Plan plan = plan_regrasp(model);
    many += plan.usable() ? 0 : 1;
    if (!plan.usable()) {
      EXPECT_EQ(plan.status, PlanStatus::kBudgetSpent);
      EXPECT_GT(plan.lower_bound, 1.0);
      continue;
    }
    for (const PlannedPush& push : plan.pushes) {
      const double turn = std::abs(push.end.X_HO.theta - push.start.X_HO.theta);
      many += turn > 30.0 ? 1 : 0;
      EXPECT_LE(turn, 200.0) << index;  // of two legs in a line, at most
    }
    EXPECT_TRUE(replay(model, plan).agrees) << index;
  }
  EXPECT_GE(many, 3);
}

/// One wall, and goals of which it reaches the tolerances only: over whole discs and
/// where the face clips them.
TEST(Planner, EndsBesideGoalsThatNoWayLeadsTo) {
  FixtureRange range;
  range.object = FixtureObject::kConvex;
  range.count = {1.0, 1.0};
  range.goals = GoalsFrom::kRandom;
  FixtureRange concave = range;
  concave.object = FixtureObject::kConcave;
  concave.count = FixtureRange{}.count;
  for (const auto& [of, index] :
       {std::pair{range, 15}, {range, 63}, {range, 79}, {concave, 295}}) {
    const auto problem = random_fixture(of, 1, static_cast<std::uint64_t>(index));
    ASSERT_TRUE(problem) << index;
    const Model model = prepare(problem->scene);
    PlanOptions options;
    options.margin = Margin::none();
    const Plan plan = plan_regrasp(model, options);
    ASSERT_TRUE(plan.usable()) << index << ": " << plan.message;
    EXPECT_TRUE(replay(model, plan).agrees) << index;
    const Goal& goal = *model.scene.goal;
    EXPECT_TRUE(reaches(goal, plan.goal)) << index;
    const GoalError error = goal_error(goal, plan.goal);
    EXPECT_GT(std::max(std::max(error.x, error.y) / goal.position_tolerance,
                       error.theta / goal.angle_tolerance),
              0.5)
        << index;
  }
}

TEST(Planner, RollsACanWhereTheGoalAsksForIt) {
  int rolled = 0;
  for (int i = 0; i < 12; ++i) {
    const RandomRegrasp regrasp = random_regrasp(RegraspFamily::kCylinder, 13, i);
    const Model model = prepare(regrasp.scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable()) << i << plan.message;
    int rolls = 0;
    for (const PlannedPush& push : plan.pushes) {
      rolls += std::holds_alternative<Roll>(push.push);
    }
    EXPECT_EQ(rolls, regrasp.scene.goal->psi ? 1 : 0);
    rolled += rolls;
  }
  EXPECT_GT(rolled, 4);
}

}  // namespace
}  // namespace prehensile
