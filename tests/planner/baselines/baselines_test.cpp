#include "planner/baselines/baselines.h"

#include <atomic>

#include <gtest/gtest.h>

#include "planner/checks/replay.h"
#include "tests/planner/executed_pushes.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::kNoBudget;

const std::string kTree = "motion-cone-tree";
const std::string kShooting = "random-shooting";
const std::string kTwoTrees = "two-trees";

Plan searched(const Model& model, const PlanOptions& options,
              const Margin& margin = Margin::none(), Work* counted = nullptr) {
  const SearchModel search = prepare_search(model, margin);
  Work work{.budget = options.budget};
  const Plan plan =
      search_by_baseline(search, model.scene.start, *model.scene.goal, options, work);
  if (counted != nullptr) *counted = work;
  return plan;
}

/// Every third one a square; odd ones without gravity.
Scene wide(int i) {
  return random_among_walls(i % 3 == 0, RegraspRange::kWide, i % 2 == 0, 5,
                            static_cast<std::uint64_t>(i));
}

TEST(Baselines, EveryPushIsDoneInItsDirection) {
  testing::Directions directions;
  int solved = 0;
  for (const std::string& planner : {kTree, kShooting, kTwoTrees}) {
    for (int i = 0; i < 24; ++i) {
      const Model model = prepare(i < 12 ? wide(i) : published_tee(i));
      const Plan plan = searched(model, {.planner = planner, .budget = 5000});
      if (plan.status != PlanStatus::kReachedGoal) continue;
      ++solved;
      testing::expect_executable(model, plan, directions);
    }
  }
  EXPECT_GT(solved, 30);
  EXPECT_GT(directions.pushes, 40);
  EXPECT_LT(directions.reversible, directions.pushes / 4);
}

TEST(Baselines, PlansOfTheWholeProgramReplay) {
  for (const std::string& planner : {kTree, kShooting, kTwoTrees}) {
    for (int i = 0; i < 6; ++i) {
      const Model model = prepare(published_tee(i));
      const Plan plan = plan_regrasp(model, {.planner = planner, .budget = 200'000});
      ASSERT_TRUE(plan.usable()) << planner << " " << i << ": " << plan.message;
      EXPECT_EQ(plan.planner, planner);
      EXPECT_GT(plan.propagations, 0);
      EXPECT_TRUE(replay(model, plan).agrees);
      EXPECT_GE(plan.cost, plan.lower_bound - 1e-9);
    }
  }
}

bool same_pushes(const Plan& a, const Plan& b) {
  if (a.pushes.size() != b.pushes.size()) return false;
  for (std::size_t i = 0; i < a.pushes.size(); ++i) {
    if (!(a.pushes[i].end == b.pushes[i].end)) return false;
  }
  return a.status == b.status && a.propagations == b.propagations;
}

TEST(Baselines, TheSeedDecides) {
  const Model model = prepare(wide(1));
  for (const std::string& planner : {kTree, kShooting, kTwoTrees}) {
    int different = 0;
    const Plan first = searched(model, {.planner = planner, .seed = 1, .budget = 5000});
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const PlanOptions options{.planner = planner, .seed = seed, .budget = 5000};
      const Plan plan = searched(model, options);
      EXPECT_TRUE(same_pushes(plan, searched(model, options))) << planner;
      different += !same_pushes(plan, first);
    }
    EXPECT_GT(different, 2) << planner;
  }
}

/// Only one wall, which pushes the object the other way.
Scene hopeless() {
  Scene scene = testing::walled_square();
  scene.goal = testing::goal_at({0.03, 0.003}, 0.1);
  scene.pushers.resize(1);
  scene.g_W = Vec2::Zero();
  return scene;
}

TEST(Baselines, TheBudgetIsKeptToThePropagation) {
  const Model model = prepare(hopeless());
  for (const std::string& planner : {kTree, kShooting, kTwoTrees}) {
    for (const std::int64_t budget : {0, 1, 10, 137, 2000}) {
      Work work;
      const Plan plan =
          searched(model, {.planner = planner, .budget = budget}, Margin::none(), &work);
      EXPECT_EQ(work.propagations + work.other, budget) << planner;
      if (planner == kShooting) {
        EXPECT_EQ(work.other, 0);
      }
      EXPECT_EQ(plan.status, PlanStatus::kBudgetSpent);
      EXPECT_TRUE(plan.pushes.empty());
    }
  }
}

TEST(Baselines, TheStopFlagEndsThem) {
  const Model model = prepare(hopeless());
  const std::atomic<bool> stop = true;
  for (const std::string& planner : {kTree, kShooting, kTwoTrees}) {
    const Plan plan =
        searched(model, {.planner = planner, .budget = kNoBudget, .stop = &stop});
    EXPECT_EQ(plan.status, PlanStatus::kStopped) << planner;
  }
}

TEST(Baselines, RollsAreAdded) {
  for (const std::string& planner : {kTree, kShooting, kTwoTrees}) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      const RandomRegrasp regrasp = random_regrasp(RegraspFamily::kCylinder, 1, i);
      if (!regrasp.scene.goal->psi) continue;
      const Model model = prepare(regrasp.scene);
      const Plan plan = plan_regrasp(model, {.planner = planner, .budget = 5000});
      if (!plan.usable()) continue;
      EXPECT_TRUE(replay(model, plan).agrees);
      return;
    }
    ADD_FAILURE() << planner << " solved no can";
  }
}

TEST(Baselines, OptionsMatter) {
  const Model model = prepare(published_tee(21));
  const Plan small = searched(
      model, {.planner = kTree, .settings = {{"step", 0.01}}, .budget = 100'000});
  const Plan large =
      searched(model, {.planner = kTree, .settings = {{"step", 1.0}}, .budget = 100'000});
  ASSERT_EQ(small.status, PlanStatus::kReachedGoal);
  ASSERT_EQ(large.status, PlanStatus::kReachedGoal);
  EXPECT_GT(small.propagations, large.propagations);
}

}  // namespace
}  // namespace prehensile
