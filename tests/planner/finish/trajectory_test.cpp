#include "planner/finish/trajectory.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "planner/costs.h"
#include "planner/finish/polish.h"
#include "planner/finish/repair.h"
#include "planner/finish/stretch.h"
#include "planner/search/push_search.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "tests/planner/rejected_plan.h"

namespace prehensile {
namespace {

using testing::RejectedPlan;

class Trajectory : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!ipopt_is_built()) GTEST_SKIP() << "built without Ipopt";
  }
};

Scene wide_tee(int index) {
  return random_among_walls(false, RegraspRange::kWide, true, 1, index);
}

/// Ways of many pushes over a T, which drift by more than the search counts: most of them
/// with more way-points than sub-plex can move.
TEST_F(Trajectory, MakesPushesStickThatSlipWithinTheMargin) {
  int rejected = 0;
  int repaired = 0;
  int by_subplex = 0;
  for (const int index : {29, 91, 98, 109, 116, 119, 135, 295, 439, 451}) {
    RejectedPlan one(wide_tee(index));
    ASSERT_EQ(one.plan.status, PlanStatus::kReachedGoal) << index;
    if (one.passes(one.plan)) continue;
    ++rejected;
    const Limits limits(one.options, one.work);
    Plan other = one.plan;
    by_subplex += repair(one.search, limits, one.work, other) && one.passes(other);
    Plan mended = one.plan;
    if (!repair_as_trajectory(one.search, limits, one.work, mended)) continue;
    EXPECT_TRUE(one.passes(mended)) << index;
    testing::expect_same_way(mended, one.plan);
    ++repaired;
  }
  EXPECT_GE(rejected, 9);
  EXPECT_GE(repaired, rejected - 2);
  EXPECT_LT(by_subplex, repaired);
}

TEST_F(Trajectory, IsTheSameEveryTime) {
  RejectedPlan one(wide_tee(439));
  const Limits limits(one.options, one.work);
  Plan a = one.plan;
  Plan b = one.plan;
  ASSERT_TRUE(repair_as_trajectory(one.search, limits, one.work, a));
  ASSERT_TRUE(repair_as_trajectory(one.search, limits, one.work, b));
  for (std::size_t i = 0; i < a.pushes.size(); ++i) {
    EXPECT_EQ(a.pushes[i].end, b.pushes[i].end) << i;
  }
}

/// Plans that sub-plex cannot shorten any further: its angles are those of the closed
/// form, which takes pads that are clipped for whole ones, or drift for straight.
TEST_F(Trajectory, ShortensPlansThatStick) {
  FixtureRange slender;
  slender.pad = FixturePad::kRectangle;
  slender.goals = GoalsFrom::kRandom;
  int plans = 0;
  int shorter = 0;
  double most = 0.0;
  for (int i = 0; i < 24; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    RejectedPlan one(i % 2 == 0 ? wide_tee(i) : random_fixture(slender, 1, index)->scene);
    if (!one.plan.usable() || one.plan.pushes.size() < 2) continue;
    const Limits limits(one.options, one.work);
    polish_with_real_pads(one.search, limits, one.work, one.plan);
    if (!one.passes(one.plan)) continue;
    ++plans;
    account(one.model, one.plan);
    Plan other = one.plan;
    if (!shorten_as_trajectory(one.search, limits, one.work, other)) continue;
    ++shorter;
    EXPECT_TRUE(one.passes(other)) << i;
    testing::expect_same_way(other, one.plan);
    account(one.model, other);
    EXPECT_LT(other.cost, one.plan.cost) << i;
    most = std::max(most, one.plan.cost - other.cost);
  }
  EXPECT_GE(plans, 10);
  EXPECT_GE(shorter, 5);
  EXPECT_GT(most, 0.02);
  std::printf("%d of %d plans are shorter, by up to %.3f\n", shorter, plans, most);
}

TEST_F(Trajectory, DoesNotShortenPlansThatSlip) {
  RejectedPlan one(wide_tee(439));
  ASSERT_FALSE(one.passes(one.plan));
  const Limits limits(one.options, one.work);
  EXPECT_FALSE(shorten_as_trajectory(one.search, limits, one.work, one.plan));
}

TEST_F(Trajectory, LeavesPlansAloneThatStick) {
  testing::expect_sticking_plans_stay(&repair_as_trajectory, published_tee(20));
}

/// The angle is no unknown there.
TEST_F(Trajectory, LeavesPushesByPointsAlone) {
  const FixtureRange range{.object = FixtureObject::kBox,
                           .pushers = FixturePushers::kPoints,
                           .goals = GoalsFrom::kPushes};
  int plans = 0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    RejectedPlan one(random_fixture(range, 1, i)->scene);
    if (one.plan.pushes.size() < 2) continue;
    ++plans;
    const Limits limits(one.options, one.work);
    const std::int64_t before = one.work.done();
    EXPECT_FALSE(repair_as_trajectory(one.search, limits, one.work, one.plan)) << i;
    EXPECT_EQ(one.work.done(), before) << i;
  }
  EXPECT_GE(plans, 1);
}

TEST_F(Trajectory, EndsWithTheWork) {
  testing::expect_end_with_the_work(&repair_as_trajectory, wide_tee(439));
}

}  // namespace
}  // namespace prehensile
