#include <algorithm>
#include <atomic>
#include <cstdio>

#include <gtest/gtest.h>
#include <ompl/util/Console.h>

#include "planner/catalogue.h"
#include "planner/checks/replay.h"
#include "planner/search/frame.h"
#include "tests/planner/ompl_regrasps.h"

namespace prehensile {
namespace {

using testing::kNoBudget;

std::vector<std::string> stock_planners() {
  std::vector<std::string> names = frame_planners();
  names.erase(names.begin());
  return names;
}

/// Our own and those of OMPL that steer.
std::vector<std::string> steering_planners() {
  std::vector<std::string> names = frame_planners();
  std::erase_if(names, [](const std::string& n) { return n.starts_with("blind::"); });
  return names;
}

struct Outcome {
  Model model;
  Plan plan;
  Work work;
};

Outcome solve(const Scene& scene, const std::string& planner,
              std::int64_t budget = 10'000, std::uint64_t seed = 1) {
  Outcome outcome{.model = prepare(scene), .work = {.budget = budget}};
  const SearchModel search = prepare_search(outcome.model, Margin{});
  outcome.plan =
      solve_in_frame(search, scene.start, *scene.goal,
                     {.planner = planner, .seed = seed, .budget = budget}, outcome.work);
  return outcome;
}

/// Equal up to the rounding of poses into places and back.
void expect_same(const Grasp& a, const Grasp& b) {
  EXPECT_NEAR(a.X_HO.x, b.X_HO.x, 1e-14);
  EXPECT_NEAR(a.X_HO.y, b.X_HO.y, 1e-14);
  EXPECT_NEAR(a.X_HO.theta, b.X_HO.theta, 1e-14);
  EXPECT_EQ(a.psi, b.psi);
}

void expect_chain_of_pushes(const Outcome& outcome) {
  const Plan& plan = outcome.plan;
  ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << plan.planner << " " << plan.message;
  ASSERT_FALSE(plan.pushes.empty());
  EXPECT_EQ(plan.start, outcome.model.scene.start);
  expect_same(plan.pushes.front().start, plan.start);
  for (std::size_t i = 1; i < plan.pushes.size(); ++i) {
    expect_same(plan.pushes[i].start, plan.pushes[i - 1].end);
  }
  EXPECT_EQ(plan.goal, plan.pushes.back().end);
  EXPECT_TRUE(reaches(*outcome.model.scene.goal, plan.goal));
}

TEST(OmplFrame, OwnPlannerIsTheFirstThenAllThatNeedOmpl) {
  EXPECT_TRUE(frame_is_built());
  std::vector<std::string> names = {"push"};
  for (const PlannerKind& kind : planner_catalogue()) {
    if (kind.needs_ompl()) names.push_back(kind.name);
  }
  EXPECT_EQ(frame_planners(), names);
  EXPECT_EQ(names.size(), 1U + 11U + 7U + 7U);
}

void expect_solved(const std::vector<std::string>& planners,
                   const std::vector<Scene>& scenes, std::int64_t budget) {
  for (const std::string& planner : planners) {
    for (const Scene& scene : scenes) {
      const Outcome outcome = solve(scene, planner, budget);
      expect_chain_of_pushes(outcome);
      EXPECT_EQ(outcome.plan.planner, planner);
      const bool own = planner == "push";
      EXPECT_EQ(outcome.work.propagations > 0, !own);
      EXPECT_EQ(outcome.work.stick_tests > 0, own);
      EXPECT_EQ(outcome.plan.propagations, outcome.work.propagations);
    }
  }
}

TEST(OmplFrame, OnePushIsFoundByAllThatSteer) {
  expect_solved(steering_planners(), {testing::regrasps()[0]}, 10'000);
}

TEST(OmplFrame, TwoPushesAreFound) {
  expect_solved({"push", "geometric::RRTConnect", "geometric::EST", "control::RRT",
                 "control::PDST", "control::SyclopRRT"},
                {testing::regrasps()[3]}, 10'000);
}

TEST(OmplFrame, FullPlannersThatSteerSolveEveryRegrasp) {
  expect_solved(steering_planners(), testing::regrasps(), 100'000);
}

void expect_replays(const std::vector<Scene>& scenes, std::int64_t budget) {
  for (const std::string& planner : steering_planners()) {
    for (const Scene& scene : scenes) {
      const Model model = prepare(scene);
      const Plan plan = plan_regrasp(model, {.planner = planner, .budget = budget});
      ASSERT_TRUE(plan.usable()) << planner << ": " << plan.message;
      const Replay replayed = replay(model, plan);
      EXPECT_TRUE(replayed.agrees) << planner << ": " << replayed.why;
      std::printf("%-26s S %2.0f  J %6.3f  bound %5.3f  propagations %ld\n",
                  planner.c_str(), plan.placements, plan.cost, plan.lower_bound,
                  static_cast<long>(plan.propagations));
    }
  }
}

TEST(OmplFrame, PlansPassTheReplayWithTheExactMechanics) {
  expect_replays({testing::regrasps()[0]}, 10'000);
}

TEST(OmplFrame, FullPlansPassTheReplayWithTheExactMechanics) {
  expect_replays(testing::regrasps(), 200'000);
}

TEST(OmplFrame, ApproximateSolutionsNeverCount) {
  for (const std::string& planner : stock_planners()) {
    const Outcome outcome = solve(testing::hopeless_regrasp(), planner, 1000);
    EXPECT_EQ(outcome.plan.status, PlanStatus::kBudgetSpent) << planner;
    EXPECT_TRUE(outcome.plan.pushes.empty()) << planner;
    EXPECT_FALSE(outcome.plan.message.empty());
  }
}

TEST(OmplFrame, BudgetIsKeptToThePropagation) {
  for (const std::string& planner : stock_planners()) {
    for (const std::int64_t budget : {0, 1, 10, 137, 2000}) {
      const Outcome outcome = solve(testing::hopeless_regrasp(), planner, budget);
      EXPECT_EQ(outcome.plan.status, PlanStatus::kBudgetSpent) << planner;
      if (planner.ends_with("ITstar")) {  // ask more than they push, see frame.cpp
        EXPECT_LE(outcome.work.propagations, budget);
        continue;
      }
      EXPECT_EQ(outcome.work.propagations, budget) << planner;
    }
  }
}

TEST(OmplFrame, StopFlagAndTimeLimitEndAnySearch) {
  const Scene scene = testing::hopeless_regrasp();
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  const std::atomic<bool> stop = true;
  for (const std::string& planner : frame_planners()) {
    Work work{.budget = kNoBudget};
    const Plan stopped = solve_in_frame(search, scene.start, *scene.goal,
                                        {.planner = planner, .stop = &stop}, work);
    EXPECT_EQ(stopped.status, PlanStatus::kStopped) << planner;
  }
  for (const std::string& planner : stock_planners()) {
    Work work{.budget = kNoBudget};
    const Plan late = solve_in_frame(search, scene.start, *scene.goal,
                                     {.planner = planner, .time_limit = 0.02}, work);
    EXPECT_EQ(late.status, PlanStatus::kBudgetSpent) << planner;
  }
}

TEST(OmplFrame, UnknownPlannerIsSaidToBeUnknown) {
  const Outcome outcome = solve(testing::regrasps()[0], "magic");
  EXPECT_EQ(outcome.plan.status, PlanStatus::kUnsupported);
}

TEST(OmplFrame, NothingToDoAtTheGoal) {
  for (const std::string& planner : stock_planners()) {
    Scene scene = testing::square_scene();
    scene.goal = Goal{.x = scene.start.X_HO.x};
    const Outcome outcome = solve(scene, planner);
    EXPECT_EQ(outcome.plan.status, PlanStatus::kNothingToDo) << planner;
    EXPECT_EQ(outcome.work.propagations, 0);
  }
}

TEST(OmplFrame, GoalsMayFixSomeCoordinatesOnly) {
  const Scene scene = testing::square_scene();
  const PlanarPose& start = scene.start.X_HO;
  const std::vector<Goal> goals = {
      {.theta = start.theta + 0.8},
      {.x = start.x + 0.02},
      {.y = start.y - 0.015, .theta = start.theta - 2.0 * std::numbers::pi + 0.3}};
  for (const std::string& planner : steering_planners()) {
    for (const Goal& goal : goals) {
      expect_chain_of_pushes(solve(testing::with_goal(scene, goal), planner));
    }
  }
}

/// Asking pads point by point whether they hold gravity counts as work.
constexpr std::int64_t kBudgetOfPads = 200'000;

TEST(OmplFrame, OtherPadsAndPushersAreServed) {
  Scene rectangle = testing::regrasps()[0];
  rectangle.gripper.pad = RectanglePad{{0.02, 0.014}};
  rectangle.overhang = Overhang::kClip;
  Scene points = testing::regrasps()[0];
  for (Pusher& pusher : points.pushers) pusher.feature = PointFeature{};
  Scene edges = testing::regrasps()[0];
  for (Pusher& pusher : edges.pushers) pusher.feature = LineFeature{.length = 0.03};
  for (const std::string& planner : steering_planners()) {
    for (const Scene& scene : {rectangle, points, edges}) {
      expect_chain_of_pushes(solve(scene, planner, kBudgetOfPads));
    }
  }
}

TEST(OmplFrame, RollsAreStepsOfTheirOwn) {
  Scene can = testing::can_scene();
  can.goal = Goal{.x = 0.01, .psi = 0.7};
  Scene bar = testing::bar_on_sheet();
  bar.goal = Goal{.y = -0.008, .psi = 0.5 * std::numbers::pi};
  for (const Scene& scene : {can, bar}) {
    for (const std::string& planner : steering_planners()) {
      const Outcome outcome = solve(scene, planner, kBudgetOfPads);
      expect_chain_of_pushes(outcome);
      int rolls = 0;
      for (const PlannedPush& planned : outcome.plan.pushes) {
        const bool rolls_here = std::holds_alternative<Roll>(planned.push);
        rolls += rolls_here;
        EXPECT_EQ(planned.start.psi != planned.end.psi, rolls_here) << planner;
        EXPECT_EQ(planned.start.X_HO == planned.end.X_HO, rolls_here) << planner;
      }
      EXPECT_GE(rolls, 1) << planner;
    }
  }
}

TEST(OmplFrame, GoalOffTheObjectIsNoGoal) {
  Scene scene = testing::square_scene();
  scene.goal = testing::goal_at({0.08, 0.0}, 0.0);
  for (const std::string& planner : stock_planners()) {
    const Outcome outcome = solve(scene, planner, 500);
    EXPECT_EQ(outcome.plan.status, PlanStatus::kBudgetSpent) << planner;
    EXPECT_LE(outcome.work.propagations, 500) << planner;
  }
}

TEST(OmplFrame, ToleranceDecidesWhatIsReached) {
  Goal goal = testing::goal_at({-0.03, -0.02}, -0.1);
  goal.test = GoalTest::kWeightedSum;
  for (const double tolerance : {1e-6, 1e-3, 1e-2}) {
    goal.position_tolerance = tolerance;
    for (const std::string& planner : steering_planners()) {
      expect_chain_of_pushes(
          solve(testing::with_goal(testing::square_scene(), goal), planner));
    }
  }
}

TEST(OmplFrame, ConsecutivePushesAreNotOneStraightPush) {
  for (const std::string& planner : steering_planners()) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Outcome outcome = solve(testing::regrasps()[2], planner, 10'000, seed);
      const auto& pushes = outcome.plan.pushes;
      for (std::size_t i = 1; i < pushes.size(); ++i) {
        const LinearPush a = as_linear(pushes[i - 1].push);
        const LinearPush b = as_linear(pushes[i].push);
        const bool same_line = a.contact == b.contact && (a.e - b.e).norm() < 1e-10 &&
                               std::abs(a.turn * b.travel - b.turn * a.travel) < 1e-12;
        EXPECT_FALSE(same_line) << planner << " seed " << seed;
      }
    }
  }
}

/// Collects what OMPL says.
class Listener : public ompl::msg::OutputHandler {
 public:
  void log(const std::string&, ompl::msg::LogLevel, const char*, int) override {
    ++lines;
  }
  int lines = 0;
};

TEST(OmplFrame, LogIsQuietAndGivenBack) {
  ompl::msg::OutputHandler* before = ompl::msg::getOutputHandler();
  Listener listener;
  ompl::msg::useOutputHandler(&listener);
  for (const std::string& planner : frame_planners()) {
    solve(testing::regrasps()[0], planner, 2000);
  }
  EXPECT_EQ(listener.lines, 0);
  EXPECT_EQ(ompl::msg::getOutputHandler(), &listener);
  ompl::msg::useOutputHandler(before);
}

}  // namespace
}  // namespace prehensile
