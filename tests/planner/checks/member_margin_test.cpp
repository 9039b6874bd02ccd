#include "planner/checks/member_margin.h"

#include <gtest/gtest.h>

#include "planner/checks/plan_trial.h"
#include "planner/planner.h"
#include "problems/random_fixtures.h"
#include "problems/random_regrasps.h"

namespace prehensile {
namespace {

std::optional<Model> points_around_a_box(std::uint64_t index) {
  FixtureRange range;
  range.pushers = FixturePushers::kPoints;
  const auto problem = random_fixture(range, 1, index);
  return problem ? std::optional(prepare(problem->scene)) : std::nullopt;
}

/// Draws of the box other than the corners that the plan was tried at.
TEST(MemberMargin, PlansWithAMarginSurviveTheBox) {
  constexpr int kDraws = 60;
  int draws = 0;
  int stuck = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto model = points_around_a_box(i);
    if (!model) continue;
    PlanOptions options;
    options.nominal_if_needed = false;
    const Plan plan = plan_regrasp(*model, options);
    if (!plan.usable()) continue;
    for (int k = 0; k < kDraws; ++k) {
      const BoxPoint at = random_point(i, static_cast<std::uint64_t>(k));
      ++draws;
      stuck += try_plan(*model, plan, usual_box(), at).sticks ? 1 : 0;
    }
  }
  EXPECT_GE(draws, 20 * kDraws);
  EXPECT_GE(stuck, 0.995 * draws) << stuck << " of " << draws;
}

/// Plans that were made without a margin, and the usual one claimed for them.
TEST(MemberMargin, RefusesPlansThatDoNot) {
  int refused = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto model = points_around_a_box(i);
    if (!model) continue;
    PlanOptions options;
    options.margin = Margin::none();
    Plan plan = plan_regrasp(*model, options);
    if (!plan.usable()) continue;
    EXPECT_EQ(member_margin_fault(*model, plan, {}), "") << i;
    plan.margin = usual_margin(*model);
    const std::string fault = member_margin_fault(*model, plan, {});
    if (fault.empty()) continue;
    ++refused;
    EXPECT_NE(fault.find("within the margin"), std::string::npos) << fault;
  }
  EXPECT_GE(refused, 3);
}

/// Pads that the face clips by more where they are larger than planned for: of 30 the
/// plan of the search slips in one of a hundred draws, all others stick.
TEST(MemberMargin, PlansOverClippedPadsSurviveTheBox) {
  constexpr int kDraws = 200;
  int plans = 0;
  for (const std::uint64_t i : {27, 28, 29, 30, 31, 32}) {
    const Model model = prepare(random_regrasp(RegraspFamily::kBox, 21, i).scene);
    PlanOptions options;
    options.nominal_if_needed = false;
    const Plan plan = plan_regrasp(model, options);
    if (!plan.usable()) continue;
    ++plans;
    for (int k = 0; k < kDraws; ++k) {
      const BoxPoint at = corner(usual_box(), static_cast<std::uint64_t>(101 * k));
      const PlanTrial trial = try_plan(model, plan, usual_box(), at);
      EXPECT_TRUE(trial.sticks || trial.status == TransitionStatus::kFalls)
          << i << " " << k << " " << name(trial.status);
    }
  }
  EXPECT_GE(plans, 5);
}

}  // namespace
}  // namespace prehensile
