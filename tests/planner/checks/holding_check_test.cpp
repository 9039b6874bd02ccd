#include "planner/checks/holding_check.h"

#include <gtest/gtest.h>

#include "mechanics/certificate.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/plan_trial.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

/// Boxes so heavy that the fingers hardly hold them away from their middle.
Model heavy_box(std::uint64_t index) {
  const FixtureRange range{
      .strength = {1.3, 2.5}, .weightless = 0.0, .goals = GoalsFrom::kRandom};
  return prepare(random_fixture(range, 5, index)->scene);
}

Plan with_margin(const Model& model) {
  PlanOptions options;
  options.nominal_if_needed = false;
  options.budget = 300'000;
  return plan_regrasp(model, options);
}

/// By the points of the pads, in members of the box: the fingers hold the object where
/// one push ends and the next begins, in the attitude of both.
TEST(HoldingCheck, WayPointsAreHeldAllOverTheMargin) {
  int looked_at = 0;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const Model model = heavy_box(i);
    const Plan plan = with_margin(model);
    if (!plan.usable()) continue;
    for (std::size_t k = 0; k + 1 < plan.pushes.size(); ++k) {
      const PlanarPose& X_HO = plan.pushes[k].end.X_HO;
      for (std::uint64_t draw = 0; draw < 64; ++draw) {
        const BoxPoint at = corner(usual_box(), 977 * draw);
        for (const Push& push : {plan.pushes[k].push, plan.pushes[k + 1].push}) {
          const UncertainPush member = vary(model.scene, {X_HO}, push, usual_box(), at);
          const Model other = prepare(member.scene);
          const int contact = counterpart(model, contact_of(push), other);
          ASSERT_GE(contact, 0);
          const PlanarGrasp grasp =
              grasp_at(other, member.start.X_HO, other.contacts[contact].g_O);
          EXPECT_GT(gravity_slack(grasp), 0.0) << i << ' ' << k << ' ' << draw;
          ++looked_at;
        }
      }
    }
  }
  EXPECT_GT(looked_at, 1000);
}

/// A plan without a margin that claims one.
TEST(HoldingCheck, RefusesWayPointsThatAreNotHeld) {
  int refused = 0;
  int by_check = 0;
  for (std::uint64_t i = 0; i < 200 && refused < 16; ++i) {
    const Model model = heavy_box(i);
    PlanOptions options;
    options.margin = Margin::none();
    options.budget = 300'000;
    Plan plan = plan_regrasp(model, options);
    if (!plan.usable() || plan.pushes.size() < 2) continue;
    EXPECT_EQ(margin_holding_fault(model, plan), "") << i;
    plan.margin = usual_margin(model);
    const std::string fault = margin_holding_fault(model, plan);
    if (fault.empty()) continue;
    EXPECT_NE(fault.find("the fingers alone may not hold"), std::string::npos) << fault;
    ++refused;
    // More weight alone, which pushes may survive that the fingers do not.
    for (int k = 1; k <= 60; ++k) {
      plan.margin = Margin::none();
      plan.margin.force = 0.005 * k;
      if (margin_holding_fault(model, plan).empty()) continue;
      std::string why;
      EXPECT_FALSE(check_exactly(model, options.transition, plan, &why));
      by_check += why.find("the fingers alone may not hold") != std::string::npos;
    }
  }
  EXPECT_EQ(refused, 16);
  EXPECT_GT(by_check, 0);
}

/// Start and goal are given: a plan says where they may not be held, or beside the
/// object.
TEST(HoldingCheck, SaysWhatIsGivenAndMayBeLost) {
  Scene scene = published_tee(10);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  Plan plan = with_margin(model);
  ASSERT_TRUE(plan.usable());
  EXPECT_EQ(plan.message, "");

  Scene close = testing::walled_square();
  close.g_W.setZero();
  close.goal = testing::goal_at({0.01, 0.0499}, 0.1);
  plan = with_margin(prepare(close));
  if (plan.usable()) {
    EXPECT_NE(plan.message.find("may be beside the object"), std::string::npos);
  }
  Scene border = scene;
  border.gripper.pad = DiscPad{0.004};
  Plan claimed;
  claimed.start.X_HO = pose_from_finger(Vec2(0.0, 0.0), 0.0);
  claimed.margin = usual_margin(model);
  EXPECT_EQ(given_caveat(prepare(border), claimed), "");
}

/// Before the first push the hand holds with the force of that push, if it is greater.
TEST(HoldingCheck, TheStartIsHeldWithTheGripOfTheWay) {
  Scene scene = testing::walled_square();
  scene.start.X_HO = pose_from_finger({0.0, 0.0}, 0.0);
  scene.gripper.grip_range =
      Vec2(scene.gripper.grip_force, 20.0 * scene.gripper.grip_force);
  scene.g_W = {0.0, -9.81};
  const double friction = scene.gripper.friction[0] + scene.gripper.friction[1];
  scene.object.mass = 1.5 * friction * scene.gripper.grip_force / 9.81;
  const Model model = prepare(scene);
  const auto plan_with = [&](double share) {
    Plan plan;
    plan.start = scene.start;
    for (std::size_t k = 0; k < model.contacts.size(); ++k) {
      if (std::abs(model.contacts[k].grip_share - share) > 1e-9) continue;
      plan.pushes = {{.push = LinearPush{.contact = static_cast<int>(k)}}};
    }
    EXPECT_FALSE(plan.pushes.empty());
    return plan;
  };
  EXPECT_NE(start_holding_fault(model, plan_with(1.0)), "");
  EXPECT_EQ(start_holding_fault(model, plan_with(20.0)), "");
}

}  // namespace
}  // namespace prehensile
