#include "planner/three_pushes.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "planner/chain.h"
#include "planner/chain_search.h"
#include "planner/costs.h"
#include "planner/push_search.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// The plan that the first stages find, without a look for anything cheaper.
Plan first_plan(const SearchModel& search, const Limits& limits, Work& work) {
  const Scene& scene = search.model->scene;
  Plan plan = blank_plan(search, scene.start, {});
  const FlatState start = flat_state(scene.start);
  const GoalPlaces goals = goal_places(*search.model, *scene.goal, start);
  const auto found = search_chains(search, start, goals, 0.0, limits, work);
  if (found) append_chain(search, start, found->chain, plan);
  account(*search.model, plan);
  return plan;
}

/// One contact does in three directions what cost more, and each push sticks.
TEST(ThreePushes, OfOneContactCostLess) {
  const PlanOptions options;
  int asked = 0, cheaper = 0;
  for (std::uint64_t i = 0; i < 80; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4)};
    const Model model = prepare(random_fixture(range, 5, i)->scene);
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = first_plan(search, limits, work);
    if (plan.pushes.empty()) continue;
    ++asked;
    const double before = plan.cost;
    if (!improve_by_three_pushes(search, limits, work, plan)) continue;
    account(model, plan);
    EXPECT_LT(plan.cost, before) << i;
    EXPECT_EQ(plan.placements, 1.0) << i;
    EXPECT_LE(plan.pushes.size(), 3U) << i;
    EXPECT_TRUE(reaches(*model.scene.goal, plan.goal)) << i;
    for (const PlannedPush& planned : plan.pushes) {
      EXPECT_FALSE(model.contacts[contact_of(planned.push)].is_point) << i;
    }
    cheaper += plan.cost < 0.9 * before;
  }
  std::printf("%d of %d cheaper by a tenth and more\n", cheaper, asked);
  EXPECT_GT(asked, 40);
  EXPECT_GT(cheaper, 3);
}

/// Of what cannot be much cheaper nothing is asked, nor over soft points.
TEST(ThreePushes, AreNotLookedForInVain) {
  const PlanOptions options;
  for (int i = 0; i < 20; ++i) {
    const bool soft = i % 2 == 0;
    const Scene scene = published_square(i);
    const Model model = prepare(soft ? with_soft_points(scene) : scene);
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = first_plan(search, limits, work);
    if (plan.pushes.size() != 1 && !soft) continue;
    const std::int64_t before = work.done();
    const std::size_t pushes = plan.pushes.size();
    EXPECT_FALSE(improve_by_three_pushes(search, limits, work, plan)) << i;
    EXPECT_EQ(work.done(), before) << i;
    EXPECT_EQ(plan.pushes.size(), pushes) << i;
  }
}

}  // namespace
}  // namespace prehensile
