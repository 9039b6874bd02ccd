#include "planner/finish/loosen_grip.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/checks/exact_check.h"
#include "planner/checks/replay.h"
#include "planner/costs.h"
#include "planner/planner.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_law_scene;

Scene gripped_with(Scene scene, double force) {
  scene.gripper.grip_force = force;
  scene.gripper.grip_range.reset();
  return scene;
}

/// A square that a weak grip holds, and from which it cannot be pushed to its goal.
Scene weakly_held() { return gripped_with(published_square(0), 10.0); }

/// The same push, instant by instant, in the scene that is gripped with its force.
void expect_same_push(const Model& model, const Model& gripped, int contact,
                      const LinearPush& push, const Grasp& start) {
  LinearPush plain = push;
  plain.contact = contact % static_cast<int>(gripped.contacts.size());
  const Transition a = apply(model, start, push);
  const Transition b = apply(gripped, start, plain);
  ASSERT_EQ(a.status, b.status);
  EXPECT_NEAR(a.end.X_HO.x, b.end.X_HO.x, 1e-9);
  EXPECT_NEAR(a.end.X_HO.y, b.end.X_HO.y, 1e-9);
  EXPECT_NEAR(a.end.X_HO.theta, b.end.X_HO.theta, 1e-7);
  if (std::isnan(b.max_push_force)) return;
  EXPECT_NEAR(a.max_push_force, b.max_push_force, 1e-4 * b.max_push_force + 1e-9);
}

/// Grip forces are contacts of one model: each has to behave like the scene that is
/// gripped with its force, in slack, motion and force.
TEST(OtherGrips, AreTheSceneGrippedSo) {
  Random random(7);
  int pushes = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = random_law_scene(random);
    if (scene.g_W.isZero()) continue;
    const double own = scene.gripper.grip_force;
    scene.gripper.grip_range = Vec2(random.in(0.3, 0.9) * own, random.in(1.1, 4.0) * own);
    const Model model = prepare(scene);
    const std::size_t plain = scene.pushers.size();
    ASSERT_EQ(model.contacts.size(), 4 * plain);
    for (int k = 0; k < static_cast<int>(model.contacts.size()); ++k) {
      const LinearPush push{k, 0.0, model.contacts[k].n, random.in(1e-3, 8e-3),
                            random.in(-0.2, 0.2)};
      const Model gripped = prepare(gripped_with(scene, grip_force_of(model, push)));
      const PushContact& same = gripped.contacts[k % plain];
      const double slack = push_slack(model, scene.start, push, Margin{});
      LinearPush in_gripped = push;
      in_gripped.contact = k % static_cast<int>(plain);
      EXPECT_NEAR(slack, push_slack(gripped, scene.start, in_gripped, Margin{}), 1e-9);
      EXPECT_NEAR(holding_slack(model, {0.0, 0.01}, model.contacts[k].g_O, Margin{}),
                  holding_slack(gripped, {0.0, 0.01}, same.g_O, Margin{}), 1e-9);
      expect_same_push(model, gripped, k, push, scene.start);
      ++pushes;
    }
  }
  EXPECT_GT(pushes, 300);
}

TEST(OtherGrips, ReachGoalsThatOneGripDoesNot) {
  Scene scene = weakly_held();
  const Plan stuck = plan_regrasp(prepare(scene));
  EXPECT_FALSE(stuck.usable());
  scene.gripper.grip_range = Vec2(10.0, 60.0);
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_TRUE(plan.usable()) << plan.message;
  EXPECT_TRUE(replay(model, plan).agrees);
  double tightest = 0.0;
  for (const PlannedPush& planned : plan.pushes) {
    const double force = grip_force_of(model, planned.push);
    tightest = std::max(tightest, force);
    const Model gripped = prepare(gripped_with(scene, force));
    LinearPush push = as_linear(planned.push);
    push.contact %= static_cast<int>(gripped.contacts.size());
    const Transition done = apply(gripped, planned.start, push);
    EXPECT_TRUE(done.completed());
    EXPECT_NEAR(done.max_push_force, planned.push_force, 1e-6 * planned.push_force);
    EXPECT_GE(push_slack(gripped, planned.start, push, plan.margin), -1e-9);
  }
  EXPECT_GT(tightest, 10.0);
}

TEST(LoosenGrip, KeepsTheMotionAndLowersTheForces) {
  Scene scene = published_tee(20);
  const PlanOptions options{.ease = 0.0};  // which finds other way-points then
  const Plan before = plan_regrasp(prepare(scene), options);
  scene.gripper.grip_range = Vec2(5.0, scene.gripper.grip_force);
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model, options);
  ASSERT_TRUE(plan.usable());
  ASSERT_EQ(plan.pushes.size(), before.pushes.size());
  EXPECT_NEAR(plan.cost, before.cost, 1e-9);
  double lowered = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    EXPECT_GE(plan.pushes[i].slack, 0.0);
    EXPECT_EQ(as_linear(plan.pushes[i].push).e, as_linear(before.pushes[i].push).e);
    lowered += before.pushes[i].push_force - plan.pushes[i].push_force;
  }
  EXPECT_GT(lowered, 1.0);
}

TEST(LoosenGrip, LeavesScenesWithoutARangeAlone) {
  const Model model = prepare(published_tee(20));
  const SearchModel search = prepare_search(model, Margin{});
  Plan plan = plan_regrasp(model);
  Work work{.budget = testing::kNoBudget};
  EXPECT_FALSE(loosen_grip(search, work, plan));
}

TEST(OtherGrips, TheHandHoldsTightestOnItsWay) {
  Scene scene = weakly_held();
  scene.gripper.grip_range = Vec2(5.0, 60.0);
  const Model model = prepare(scene);
  const auto push_with = [&](double force) {
    const int contact = find_contact(model, scene.pushers[0].name, "", force / 10.0);
    EXPECT_GE(contact, 0);
    return PlannedPush{.push = LinearPush{.contact = contact}};
  };
  const std::vector<PlannedPush> pushes = {push_with(5.0), push_with(60.0)};
  EXPECT_NEAR(grip_force_of(model, pushes[0].push), 5.0, 1e-12);
  EXPECT_NEAR(grip_force_on_way(model, pushes, 0), 10.0, 1e-12);
  EXPECT_NEAR(grip_force_on_way(model, pushes, 1), 60.0, 1e-12);
  EXPECT_NEAR(grip_force_on_way(model, pushes, 2), 60.0, 1e-12);
  EXPECT_EQ(grip_force_on_way(model, {}, 0), 10.0);
}

}  // namespace
}  // namespace prehensile
