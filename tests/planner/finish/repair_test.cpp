#include "planner/finish/repair.h"

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "planner/finish/stretch.h"
#include "planner/search/push_search.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"
#include "problems/published_regrasps.h"
#include "tests/planner/rejected_plan.h"

namespace prehensile {
namespace {

using testing::RejectedPlan;

/// Ways of many pushes over a T, which drift by more than the search counts.
TEST(Repair, MakesPushesStickThatSlipWithinTheMargin) {
  int repaired = 0;
  for (const int index : {91, 112, 113, 119}) {
    RejectedPlan one(random_among_walls(false, RegraspRange::kWide, true, 1, index));
    ASSERT_EQ(one.plan.status, PlanStatus::kReachedGoal) << index;
    ASSERT_FALSE(one.passes(one.plan)) << index;
    const Plan before = one.plan;
    const Limits limits(one.options, one.work);
    const bool found = repair(one.search, limits, one.work, one.plan);
    ASSERT_EQ(found, nlopt_is_built());
    if (!found) continue;
    EXPECT_TRUE(one.passes(one.plan)) << index;
    testing::expect_same_way(one.plan, before);
    ++repaired;
  }
  EXPECT_EQ(repaired, nlopt_is_built() ? 4 : 0);
}

/// A plan of two pushes with a way-point that the first cannot push to.
TEST(Repair, BringsAWayPointBack) {
  RejectedPlan one(published_tee(10));
  ASSERT_EQ(one.plan.pushes.size(), 2U);
  Stretch stretch;
  ASSERT_TRUE(read_stretch(one.search, one.plan.pushes, stretch));
  FlatState middle = flat_state(one.plan.pushes[0].end);
  middle.p_OF.y() -= 0.012;
  Plan moved = one.plan;
  moved.pushes.clear();
  append_move(one.search, {stretch.contacts[0], stretch.start, middle}, moved);
  append_move(one.search, {stretch.contacts[1], middle, stretch.end}, moved);
  ASSERT_FALSE(one.passes(moved));
  const Limits limits(one.options, one.work);
  ASSERT_EQ(repair(one.search, limits, one.work, moved), nlopt_is_built());
  EXPECT_EQ(one.passes(moved), nlopt_is_built());
}

TEST(Repair, LeavesPlansAloneThatStick) {
  testing::expect_sticking_plans_stay(&repair, published_tee(20));
}

TEST(Repair, EndsWithTheWork) {
  testing::expect_end_with_the_work(
      &repair, random_among_walls(false, RegraspRange::kWide, true, 1, 112));
}

}  // namespace
}  // namespace prehensile
