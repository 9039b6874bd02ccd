#include "planner/search/fallback.h"

#include <gtest/gtest.h>

#include "planner/catalogue.h"
#include "planner/chains/shorten.h"
#include "planner/checks/replay.h"
#include "planner/search/push_search.h"
#include "planner/steering/draft.h"
#include "tests/planner/executed_pushes.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

TEST(Fallback, IsInEveryBuild) {
  EXPECT_EQ(planner_fault(kFallbackPlanner, {}), "");
  EXPECT_FALSE(find_planner(kFallbackPlanner)->needs_ompl());
}

/// What it finds reaches the goal by pushes that stick, the same for the same seed.
TEST(Fallback, FindsShortWaysOnItsOwn) {
  testing::Directions directions;
  int solved = 0;
  for (int i = 0; i < 12; ++i) {
    const Model model = prepare(random_among_walls(false, RegraspRange::kWide, i % 2 == 0,
                                                   4, static_cast<std::uint64_t>(i)));
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves_of = [&](std::uint64_t seed) {
      Work work{.budget = 1'000'000};
      const PlanOptions options{.seed = seed};
      const auto moves =
          fall_back(search, model.scene.start, *model.scene.goal, options, 5000, work);
      EXPECT_EQ(work.budget, 1'000'000);
      EXPECT_LE(work.propagations, 5000);
      return moves;
    };
    const auto moves = moves_of(1);
    const auto again = moves_of(1);
    ASSERT_EQ(moves.has_value(), again.has_value());
    if (!moves) continue;
    ++solved;
    EXPECT_EQ(cost_of(search, *moves), cost_of(search, *again));
    Plan plan = blank_plan(search, model.scene.start, {});
    for (const Move& move : *moves) append_move(search, move, plan);
    testing::expect_executable(model, plan, directions);
  }
  EXPECT_GT(solved, 4);
}

/// A budget at which the exact stages are cut short before they find the plan.
TEST(Fallback, GoesOnWhereTheExactStagesAreCutShort) {
  int carried_on = 0;
  int without = 0;
  for (int i = 0; i < 60; ++i) {
    const Model model = prepare(random_among_walls(true, RegraspRange::kWide, true, 6,
                                                   static_cast<std::uint64_t>(i)));
    PlanOptions options{
        .settings = {{"fallback_share", 0.9}}, .budget = 3000, .margin = Margin::none()};
    const Plan plan = plan_regrasp(model, options);
    options.settings["fallback_share"] = 0.0;
    without += plan_regrasp(model, options).usable();
    if (!plan.usable()) continue;
    const bool by_fallback = plan.planner != "push";
    carried_on += by_fallback;
    if (!by_fallback) continue;
    EXPECT_EQ(plan.planner, std::string("push+") + kFallbackPlanner);
    EXPECT_TRUE(replay(model, plan).agrees);
    options.settings["fallback_share"] = 0.9;
    EXPECT_EQ(plan_regrasp(model, options).cost, plan.cost);
  }
  EXPECT_GT(carried_on, 0);
  std::printf("%d more than the %d without\n", carried_on, without);
}

TEST(Fallback, AShareOfZeroLeavesTheBudgetToTheExactStages) {
  Scene scene = testing::walled_square();
  scene.goal = testing::goal_at({0.03, 0.003}, 0.1);
  scene.pushers.resize(1);
  scene.g_W = Vec2::Zero();
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  for (const double share : {0.0, 0.5}) {
    PlanOptions options{.settings = {{"fallback_share", share}}, .budget = 20'000};
    Work work{.budget = options.budget};
    search_pushes(search, scene.start, *scene.goal, options, work);
    EXPECT_EQ(work.propagations > 0, share > 0.0);
    EXPECT_LE(work.propagations, static_cast<std::int64_t>(share * 20'000));
    EXPECT_EQ(work.budget, options.budget);
  }
}

}  // namespace
}  // namespace prehensile
