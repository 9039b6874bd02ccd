#include "planner/finish/three_pushes.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "planner/bounds/bounds.h"
#include "planner/chains/chain_search.h"
#include "planner/costs.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::plan_of_first_stages;

/// One contact does in three directions what cost more, and each push sticks. Returns how
/// many plans are cheaper by a tenth and more.
int cheaper_by_three_pushes(bool over_soft_points) {
  const PlanOptions options;
  int asked = 0, cheaper = 0;
  for (std::uint64_t i = 0; i < 80; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4)};
    const Scene scene = random_fixture(range, 5, i)->scene;
    const Model model = prepare(over_soft_points ? with_soft_points(scene) : scene);
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = plan_of_first_stages(search, limits, work);
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
  return cheaper;
}

TEST(ThreePushes, OfOneContactCostLess) { EXPECT_GT(cheaper_by_three_pushes(false), 3); }

TEST(ThreePushes, OfOneContactCostLessOverSoftPoints) {
  EXPECT_GT(cheaper_by_three_pushes(true), 0);
}

/// Of what cannot be much cheaper nothing is asked.
TEST(ThreePushes, AreNotLookedForInVain) {
  const PlanOptions options;
  int good = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4)};
    const Model model = prepare(random_fixture(range, 5, i)->scene);
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = plan_of_first_stages(search, limits, work);
    if (plan.pushes.empty()) continue;
    const double bound = guide_bound(model, model.scene.start, *model.scene.goal);
    if (plan.cost > kGoodEnough * bound) continue;
    ++good;
    const std::int64_t before = work.done();
    EXPECT_FALSE(improve_by_three_pushes(search, limits, work, plan)) << i;
    EXPECT_EQ(work.done(), before) << i;
    EXPECT_FALSE(plan.pushes.empty()) << i;
  }
  EXPECT_GT(good, 10);
}

}  // namespace
}  // namespace prehensile
