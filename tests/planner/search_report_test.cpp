/// What a search tells while it runs and after it failed.
#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "planner/advice.h"
#include "planner/checks/replay.h"
#include "primitives/uncertainty.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// A way of many turns: a search of some hundred milliseconds at least, whose first plan
/// is not its best.
Scene long_search() {
  return random_among_walls(false, RegraspRange::kWide, true, 1, 233);
}

TEST(Progress, TellsMoreAndMoreAndChangesNothing) {
  const Model model = prepare(long_search());
  PlanOptions options;
  options.improve = true;
  options.budget = 2'000'000;
  const Plan quiet = plan_regrasp(model, options);
  ASSERT_TRUE(quiet.usable());
  int calls = 0;
  std::int64_t tests = 0;
  double seconds = 0.0;
  options.progress = [&](const SearchProgress& progress) {
    ++calls;
    EXPECT_FALSE(progress.stage.empty());
    EXPECT_GE(progress.tests, tests);
    EXPECT_GT(progress.seconds, seconds);
    tests = progress.tests;
    seconds = progress.seconds;
    if (!std::isnan(progress.best_cost)) {
      EXPECT_GE(progress.best_cost, quiet.cost - 0.5);  // polish comes after the search
      EXPECT_GE(progress.gap(), 0.0);
    }
  };
  const Plan told = plan_regrasp(model, options);
  EXPECT_GT(calls, 0);
  EXPECT_EQ(told.cost, quiet.cost);
  EXPECT_EQ(told.stick_tests, quiet.stick_tests);
}

TEST(Stop, KeepsTheBestPlanFound) {
  const Model model = prepare(long_search());
  std::atomic<bool> stop = false;
  PlanOptions options;
  options.improve = true;
  options.stop = &stop;
  double best = kNan;
  options.progress = [&](const SearchProgress& progress) {
    if (std::isnan(progress.best_cost)) return;
    best = progress.best_cost;
    stop = true;
  };
  const Plan plan = plan_regrasp(model, options);
  ASSERT_FALSE(std::isnan(best)) << "no report between the first plan and the end";
  ASSERT_TRUE(plan.usable()) << plan.message;
  EXPECT_TRUE(plan.stopped_early);
  EXPECT_NE(plan.message.find("stopped"), std::string::npos);
  EXPECT_LE(plan.cost, best + 1e-9);
  EXPECT_TRUE(replay(model, plan).agrees);
}

TEST(Stop, SaysSoWithoutAPlan) {
  std::atomic<bool> stop = true;
  PlanOptions options;
  options.stop = &stop;
  const Plan plan = plan_regrasp(prepare(long_search()), options);
  EXPECT_EQ(plan.status, PlanStatus::kStopped);
  EXPECT_FALSE(plan.stopped_early);
}

TEST(Improve, IsNeverWorse) {
  int better = 0;
  for (int i = 0; i < 20; ++i) {
    const Model model = prepare(random_regrasp(RegraspFamily::kTee, 31, i).scene);
    PlanOptions options;
    options.budget = 400'000;
    options.polish = false;
    const Plan first = plan_regrasp(model, options);
    options.improve = true;
    const Plan improved = plan_regrasp(model, options);
    ASSERT_TRUE(first.usable() && improved.usable()) << i;
    EXPECT_LE(improved.cost, first.cost + 1e-12) << i;
    EXPECT_TRUE(replay(model, improved).agrees) << i;
    better += improved.cost < first.cost - 1e-9;
  }
  EXPECT_GT(better, 0);
}

/// A search that goes on begins anew, and may end at plans that polish less well.
TEST(Improve, IsNeverWorseThanThePolishedPlan) {
  Scene scene =
      with_soft_points(random_among_walls(false, RegraspRange::kWide, false, 1, 22));
  scene.goal->position_tolerance = 1e-6;
  scene.goal->theta_is = ThetaMeaning::kNumber;
  const Model model = prepare(scene);
  PlanOptions options{.budget = 1'000'000, .margin = Margin::none()};
  const Plan first = plan_regrasp(model, options);
  options.improve = true;
  const Plan improved = plan_regrasp(model, options);
  ASSERT_TRUE(first.usable() && improved.usable());
  EXPECT_LE(improved.cost, first.cost + 1e-12);
}

/// One wall of friction 0.5 for a goal that also needs a push aside.
Scene one_wall() {
  Scene scene = published_tee(20);
  scene.pushers.resize(1);
  scene.pushers[0].friction = 0.5;
  return scene;
}

/// Where ours ends and leaves a gap, others carry on.
TEST(Improve, OthersCarryOn) {
  int cheaper = 0;
  for (const int i : {1, 6, 9, 12}) {
    const Model model =
        prepare(random_among_walls(false, RegraspRange::kWide, true, 1, i));
    PlanOptions options;
    const Plan first = plan_regrasp(model, options);
    options.improve = true;
    options.budget = 1'000'000;
    const Plan plan = plan_regrasp(model, options);
    ASSERT_TRUE(plan.usable() && replay(model, plan).agrees) << i;
    EXPECT_LE(plan.cost, first.cost) << i;
    cheaper += plan.planner != options.planner;
  }
  EXPECT_GE(cheaper, 1);
}

TEST(Advice, NamesOnlyChangesThatWork) {
  const Scene scene = one_wall();
  const Model model = prepare(scene);
  PlanOptions options;
  options.budget = 500'000;
  const Plan plan = plan_regrasp(model, options);
  ASSERT_FALSE(plan.usable());
  EXPECT_GT(plan.stopped_by.total(), 0);
  const Explanation explanation = explain(model, plan, options);
  ASSERT_FALSE(explanation.changes.empty());
  EXPECT_NE(explanation.text.find('%'), std::string::npos) << explanation.text;
  bool proposes_pusher = false;
  for (const ProposedChange& change : explanation.changes) {
    EXPECT_TRUE(std::isfinite(change.cost));
    EXPECT_NE(explanation.text.find(change.what), std::string::npos);
    proposes_pusher = proposes_pusher || !change.pusher.empty();
  }
  EXPECT_TRUE(proposes_pusher);
  // The pusher that it proposes, made by hand.
  Scene more = scene;
  Pusher floor = published_tee(20).pushers[1];
  floor.friction = 0.5;
  more.pushers.push_back(floor);
  EXPECT_TRUE(plan_regrasp(prepare(more)).usable());
}

TEST(Advice, IsTheSameEveryTime) {
  const Model model = prepare(one_wall());
  PlanOptions options;
  options.budget = 200'000;
  const Plan plan = plan_regrasp(model, options);
  EXPECT_EQ(explain(model, plan, options).text, explain(model, plan, options).text);
}

TEST(Advice, SaysWhatAPlanLacks) {
  const Model model = prepare(published_tee(0));
  for (const double tilt : {0.2, 2.0}) {
    PlanOptions options;
    options.budget = 200'000;
    options.margin = Margin{}.scaled(4.0);
    options.margin->tilt = tilt;
    options.margin->grasp = 0.01;
    const Plan plan = plan_regrasp(model, options);
    const bool is_nominal = plan.promise == Promise::kNominalOnly;
    ASSERT_TRUE(is_nominal || plan.promise == Promise::kPartOfMargin);
    EXPECT_EQ(is_nominal, tilt > 1.0);
    const Explanation explanation = explain(model, plan, options);
    EXPECT_NE(explanation.text.find(is_nominal ? "nominal" : "a part of the margin"),
              std::string::npos);
  }
}

TEST(Advice, AfterAProofToo) {
  Scene scene = published_tee(20);
  scene.gripper.grip_force = 3.0;
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kInfeasible);
  const Explanation explanation = explain(model, plan, {});
  ASSERT_EQ(explanation.changes.size(), 1u);  // no friction up to 2 would do
  EXPECT_NE(explanation.changes[0].option.find("gripper.grip_force"), std::string::npos);
}

/// However little of the object the fingers hold, what would hold it is named.
TEST(Advice, SaysWhatHoldsAnObjectThatFalls) {
  for (const double share : {0.02, 0.05, 0.1}) {
    Scene scene = published_tee(20);
    scene.gripper.grip_force *= share;
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_EQ(plan.status, PlanStatus::kInfeasible);
    EXPECT_FALSE(explain(model, plan, {}).changes.empty()) << share;
  }
}

TEST(Advice, EndsWithTheTime) {
  const Model model = prepare(one_wall());
  PlanOptions options;
  options.time_limit = 0.01;
  Plan plan = plan_regrasp(model, options);
  plan.seconds = 0.01;
  const Explanation explanation = explain(model, plan, options);
  EXPECT_TRUE(explanation.changes.empty());
  EXPECT_NE(explanation.text.find("time was over"), std::string::npos);
}

TEST(Advice, StopsWhenAsked) {
  const Model model = prepare(one_wall());
  PlanOptions options;
  options.budget = 200'000;
  const Plan plan = plan_regrasp(model, options);
  const std::atomic<bool> stop = true;
  options.stop = &stop;
  EXPECT_TRUE(explain(model, plan, options).changes.empty());
}

}  // namespace
}  // namespace prehensile
