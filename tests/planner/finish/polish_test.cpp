#include "planner/finish/polish.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "planner/checks/exact_check.h"
#include "planner/costs.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::plan_of_first_stages;

/// The closed form hides ways that the pads allow: the second polish goes on where the
/// first ends, ends where it does, and what it leaves sticks.
TEST(Polish, RealPadsKnowShorterWays) {
  const PlanOptions options;
  int asked = 0, shorter = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4)};
    const Model model = prepare(random_fixture(range, 7, i)->scene);
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = plan_of_first_stages(search, limits, work);
    if (plan.pushes.size() < 2) continue;
    ++asked;
    polish(search, limits, work, plan);
    account(model, plan);
    const double before = plan.cost;
    const FlatState end = flat_state(plan.pushes.back().end);
    polish_with_real_pads(search, limits, work, plan);
    account(model, plan);
    EXPECT_LE(plan.cost, before) << i;
    EXPECT_NEAR(flat_distance(model, flat_state(plan.pushes.back().end), end), 0.0, 1e-9);
    if (plan.cost > 0.98 * before) continue;
    ++shorter;
    for (const PlannedPush& planned : plan.pushes) {
      EXPECT_GE(push_slack(model, planned.start, planned.push, plan.margin),
                -kStickTolerance)
          << i;
    }
  }
  std::printf("%d of %d shorter by 2 %% and more\n", shorter, asked);
  EXPECT_GT(asked, 20);
  if (nlopt_is_built()) {
    EXPECT_GT(shorter, 2);
  } else {
    EXPECT_EQ(shorter, 0);
  }
}

/// The friction of soft points is that of the closed form.
TEST(Polish, OverSoftPointsTheClosedFormIsEnough) {
  const PlanOptions options;
  for (int i = 0; i < 10; ++i) {
    const Model model = prepare(with_soft_points(published_tee(i)));
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = plan_of_first_stages(search, limits, work);
    const std::int64_t before = work.done();
    polish_with_real_pads(search, limits, work, plan);
    EXPECT_EQ(work.done(), before);
  }
}

}  // namespace
}  // namespace prehensile
