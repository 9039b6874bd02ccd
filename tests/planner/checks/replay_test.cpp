#include "planner/checks/replay.h"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "planner/costs.h"
#include "planner/planner.h"
#include "primitives/uncertainty.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// A regrasp that needs two pushers.
class ReplayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    plan_ = plan_regrasp(model_);
    ASSERT_EQ(plan_.status, PlanStatus::kReachedGoal);
    ASSERT_GE(plan_.pushes.size(), 2U);
    ASSERT_TRUE(replay(model_, plan_).agrees) << replay(model_, plan_).why;
  }

  void expect_rejected(const std::string& what,
                       const std::function<void(Plan&)>& tamper) {
    Plan tampered = plan_;
    tamper(tampered);
    const Replay result = replay(model_, tampered);
    EXPECT_FALSE(result.agrees) << what;
    EXPECT_FALSE(result.why.empty()) << what;
  }

  LinearPush& push(Plan& plan, std::size_t i) {
    return std::get<LinearPush>(plan.pushes[i].push);
  }

  Model model_ = prepare(published_tee(10));
  Plan plan_;
};

TEST_F(ReplayTest, RejectsTamperedPlans) {
  expect_rejected("longer", [&](Plan& plan) { push(plan, 0).travel += 1e-3; });
  expect_rejected("turned", [&](Plan& plan) { push(plan, 0).turn += 0.05; });
  expect_rejected("other way", [&](Plan& plan) { push(plan, 1).e *= -1.0; });
  expect_rejected("not of unit length", [&](Plan& plan) { push(plan, 1).e *= 1.1; });
  expect_rejected("other contact", [&](Plan& plan) {
    push(plan, 0).contact = (push(plan, 0).contact + 1) % 3;
  });
  expect_rejected("no such contact", [&](Plan& plan) { push(plan, 0).contact = 17; });
  expect_rejected("not a number", [&](Plan& plan) { push(plan, 0).travel = kNan; });
  expect_rejected("moved start", [](Plan& plan) { plan.start.X_HO.x += 1e-3; });
  expect_rejected("moved pose", [](Plan& plan) { plan.pushes[0].end.X_HO.y += 1e-3; });
  expect_rejected("one push less", [](Plan& plan) { plan.pushes.pop_back(); });
  expect_rejected("swapped",
                  [](Plan& plan) { std::swap(plan.pushes[0], plan.pushes[1]); });
  expect_rejected("force", [](Plan& plan) { plan.pushes[0].push_force *= 1.2; });
  expect_rejected("cheaper", [](Plan& plan) { plan.cost -= 0.1; });
  expect_rejected("less travel", [](Plan& plan) { plan.travel *= 0.9; });
  expect_rejected("higher bound", [](Plan& plan) { plan.lower_bound = plan.cost; });
  expect_rejected("wider margin",
                  [](Plan& plan) { plan.margin = plan.margin.scaled(9.0); });
  expect_rejected("promise of a scene that states nothing",
                  [](Plan& plan) { plan.promise = Promise::kScene; });
  expect_rejected("margin without end", [](Plan& plan) {
    plan.margin.force = std::numeric_limits<double>::infinity();
  });
  expect_rejected("negative margin", [](Plan& plan) { plan.margin.place = -1.0; });
  expect_rejected("more slack", [](Plan& plan) { plan.pushes[0].slack += 0.01; });
  expect_rejected("no slack", [](Plan& plan) { plan.pushes[1].slack = kNan; });
  expect_rejected("bad certificate",
                  [](Plan& plan) { plan.pushes[0].certificate = 1e12; });
  expect_rejected("no certificate",
                  [](Plan& plan) { plan.pushes[0].certificate = kNan; });
  expect_rejected("no error", [](Plan& plan) { plan.pushes[0].error_estimate = kNan; });
  expect_rejected("other end", [](Plan& plan) { plan.goal.X_HO.x += 1e-3; });
  expect_rejected("no margin", [](Plan& plan) { plan.margin = Margin::none(); });
  expect_rejected("no promise", [](Plan& plan) { plan.promise = Promise::kNominal; });
  expect_rejected("no claim", [](Plan& plan) { plan.status = PlanStatus::kBudgetSpent; });
}

TEST(Replay, HoldsAPlanToTheUncertaintyOfItsScene) {
  Scene scene = published_tee(10);
  scene.uncertainty = Uncertainty{};
  scene.uncertainty->friction = 0.1;
  const Model model = prepare(scene);
  Plan plan = plan_regrasp(
      model, {.margin = margin_of(model, box_of(scene)), .promise = Promise::kScene});
  ASSERT_TRUE(plan.usable());
  EXPECT_TRUE(replay(model, plan).agrees);
  plan.margin.friction = 0.05;
  EXPECT_FALSE(replay(model, plan).agrees);
}

TEST_F(ReplayTest, RejectsThePlanOfAnotherScene) {
  EXPECT_FALSE(replay(prepare(published_tee(11)), plan_).agrees);
  Scene slippery = model_.scene;
  for (Pusher& pusher : slippery.pushers) pusher.friction = 0.1;
  EXPECT_FALSE(replay(prepare(slippery), plan_).agrees);
}

TEST_F(ReplayTest, SplitPushesReplayToTheSameEnd) {
  Plan split = plan_;
  const PlannedPush whole = split.pushes[0];
  PlannedPush half = whole;
  LinearPush& first = std::get<LinearPush>(half.push);
  first.travel *= 0.5;
  first.turn *= 0.5;
  const Vec2 p_OF = finger_in_object(whole.start.X_HO) - first.travel * first.e;
  half.end.X_HO = pose_from_finger(p_OF, whole.start.X_HO.theta + first.turn);
  PlannedPush rest = half;
  rest.start = half.end;
  rest.end = whole.end;
  split.pushes[0] = half;
  split.pushes.insert(split.pushes.begin() + 1, rest);
  account(model_, split);
  const Replay result = replay(model_, split);
  EXPECT_TRUE(result.agrees) << result.why;
  EXPECT_DOUBLE_EQ(split.placements, plan_.placements);
  EXPECT_NEAR(split.cost, plan_.cost, 1e-12);
}

}  // namespace
}  // namespace prehensile
