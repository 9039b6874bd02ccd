#include "planner/finish/run_search.h"

#include <gtest/gtest.h>

#include "planner/checks/exact_check.h"
#include "planner/checks/meet_end.h"
#include "planner/costs.h"
#include "planner/pads/spread_pads.h"
#include "planner/planner.h"
#include "planner/steering/goal.h"
#include "planner/steering/limits.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// A T whose stem is so narrow that no single run reaches the goal itself, but one
/// reaches a place within its tolerances.
TEST(RunSearch, UsesTolerancesWhereTheySaveAPlacement) {
  int saved = 0;
  for (int i = 0; i < 80; ++i) {
    const Scene scene = random_among_walls(false, RegraspRange::kPublished, true, 61, i);
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const FlatState start = flat_state(scene.start);
    Work work{.budget = 1'000'000};
    const PlanOptions options;
    const Limits limits(options, work);
    Goal exact = *scene.goal;
    exact.position_tolerance = 1e-9;
    const auto to_goal = search_runs(search, start, exact, 3.0, limits, work);
    const auto within = search_runs(search, start, *scene.goal, 3.0, limits, work);
    EXPECT_LE(to_goal.has_value(), within.has_value()) << i;
    if (!within) continue;
    EXPECT_EQ(placements(search, *within), 1);
    FlatState end = start;
    for (int k = 0; k < within->count; ++k) {
      end = move_of(search, *within, k, end.theta).to;
    }
    EXPECT_TRUE(reaches(*scene.goal, grasp_of(end, 0.0))) << i;
    if (to_goal) {
      EXPECT_LE(within->cost, to_goal->cost + 1e-9) << i;
    } else {
      ++saved;
    }
  }
  EXPECT_GE(saved, 1);
}

/// Round pads would turn along these ways as the closed form of their rings says; the
/// points that stand for them pull aside, and only what they themselves allow is
/// followed.
TEST(RunSearch, FollowsWherePointsPullAside) {
  Scene scene = random_among_walls(true, RegraspRange::kWide, false, 1, 3);
  Goal& goal = *scene.goal;
  goal.theta = scene.start.X_HO.theta + wrapped(*goal.theta - scene.start.X_HO.theta);
  goal.theta_is = ThetaMeaning::kNumber;
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = 1'000'000};
  const PlanOptions options;
  const auto found = search_runs(search, flat_state(scene.start), goal, 2.5,
                                 Limits(options, work), work);
  ASSERT_TRUE(found);
  EXPECT_EQ(placements(search, *found), 1);
  EXPECT_LT(found->cost, 1.9);
  const double theta = scene.start.X_HO.theta;
  EXPECT_TRUE(chain_passes(search, *found, theta, work));
}

/// The program knows whole discs only; the pushes that follow its way-points stick with
/// what the face leaves of them.
TEST(RunSearch, FollowsOverClippedDiscs) {
  const PlanOptions options;
  int cheaper = 0;
  for (std::uint64_t i = 0; i < 120; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4)};
    const Model model = prepare(random_fixture(range, 5, i)->scene);
    if (!has_clipped_discs(model)) continue;
    const SearchModel search = prepare_search(model, Margin::none());
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    Plan plan = testing::plan_of_first_stages(search, limits, work);
    if (plan.pushes.empty()) continue;
    const double before = plan.cost;
    if (!improve_by_run(search, limits, work, plan)) continue;
    if (is_by_point(model, plan.pushes.front().push)) continue;  // needs more places
    account(model, plan);
    EXPECT_LT(plan.cost, before) << i;
    EXPECT_EQ(plan.placements, 1.0) << i;
    for (const PlannedPush& planned : plan.pushes) {
      EXPECT_GE(push_slack(model, planned.start, planned.push, plan.margin),
                -kStickTolerance)
          << i;
    }
    cheaper += plan.cost < 0.95 * before;
  }
  EXPECT_GT(cheaper, 0);
}

}  // namespace
}  // namespace prehensile
