#include "planner/finish/ease.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/plan_trial.h"
#include "planner/costs.h"
#include "problems/published_regrasps.h"
#include "tests/planner/rejected_plan.h"

namespace prehensile {
namespace {

constexpr double kShare = 0.01;

Plan planned(const Model& model, double share, const Margin& margin) {
  PlanOptions options;
  options.ease = share;
  options.margin = margin;
  options.nominal_if_needed = false;
  return plan_regrasp(model, options);
}

Plan planned(const Model& model, double share) {
  return planned(model, share, usual_margin(model));
}

double least_slack(const Plan& plan) {
  return std::ranges::min(plan.pushes, {}, &PlannedPush::slack).slack;
}

/// Share of draws from twice the usual box in which the plan sticks.
double share_that_sticks(const Model& model, const Plan& plan) {
  constexpr int kDraws = 60;
  UncertaintyBox box = usual_box();
  for (double& width : box.half_width) width *= 2.0;
  int sticks = 0;
  for (int i = 0; i < kDraws; ++i) {
    sticks += try_plan(model, plan, box, random_point(3, i)).sticks;
  }
  return static_cast<double>(sticks) / kDraws;
}

/// Twice the box fails far fewer plans, which cost no more than they may, go the same way
/// with no less slack, and are checked as any other.
void survive_more_than_their_margin(int problems) {
  int plans = 0, eased = 0;
  double slips = 0.0, slips_before = 0.0;
  for (const bool square : {true, false}) {
    for (const bool gravity : {false, true}) {
      for (int i = 0; i < problems; ++i) {
        const Model model =
            prepare(random_among_walls(square, RegraspRange::kWide, gravity, 1, i));
        const Plan cheapest = planned(model, 0.0);
        if (!cheapest.usable() || cheapest.pushes.size() < 2) continue;
        const Plan plan = planned(model, kShare);
        ASSERT_TRUE(plan.usable()) << i;
        EXPECT_LE(plan.cost, (1.0 + kShare) * cheapest.cost * (1.0 + 1e-9)) << i;
        EXPECT_GE(least_slack(plan), least_slack(cheapest) - 1e-9) << i;
        EXPECT_GE(plan.cost, plan.lower_bound) << i;
        testing::expect_same_way(plan, cheapest);
        ++plans;
        eased += least_slack(plan) > least_slack(cheapest) + 1e-3;
        slips += 1.0 - share_that_sticks(model, plan);
        slips_before += 1.0 - share_that_sticks(model, cheapest);
      }
    }
  }
  std::printf("%d of %d plans eased; %.1f %% of draws slip, %.1f %% of the cheapest\n",
              eased, plans, 100.0 * slips / plans, 100.0 * slips_before / plans);
  EXPECT_GT(plans, problems);
  EXPECT_GT(eased, plans / 2);
  EXPECT_LT(slips, 0.8 * slips_before);
}

TEST(Ease, PlansSurviveMoreThanTheirMargin) {
  if (!nlopt_is_built()) GTEST_SKIP() << "built without NLopt";
  survive_more_than_their_margin(12);
}

TEST(Ease, FullPlansSurviveMoreThanTheirMargin) { survive_more_than_their_margin(200); }

TEST(Ease, PlansWithoutAMarginStay) {
  for (int i = 0; i < 20; ++i) {
    const Model model =
        prepare(random_among_walls(true, RegraspRange::kWide, true, 1, i));
    const Plan cheapest = planned(model, 0.0, Margin::none());
    const Plan plan = planned(model, kShare, Margin::none());
    EXPECT_EQ(plan.cost, cheapest.cost) << i;
    EXPECT_EQ(plan.stick_tests, cheapest.stick_tests) << i;
  }
}

/// Of one that needs none, one that may not cost more, and one whose work is spent.
TEST(Ease, LeavesPlansAlone) {
  testing::RejectedPlan one(published_tee(20));
  ASSERT_EQ(one.plan.pushes.size(), 2U);
  ASSERT_TRUE(one.passes(one.plan));
  const Limits limits(one.options, one.work);
  Plan plan = one.plan;
  EXPECT_FALSE(ease(one.search, 0.0, limits, one.work, plan));
  EXPECT_EQ(ease(one.search, 1.0, limits, one.work, plan), nlopt_is_built());
  EXPECT_TRUE(one.passes(plan));
  testing::expect_same_way(plan, one.plan);
  EXPECT_FALSE(ease(one.search, 1.0, limits, one.work, plan)) << "eased twice";
  plan = one.plan;
  one.work.budget = one.work.done();
  EXPECT_FALSE(ease(one.search, 1.0, limits, one.work, plan));
}

}  // namespace
}  // namespace prehensile
