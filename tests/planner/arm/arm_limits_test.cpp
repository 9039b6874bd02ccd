/// Speeds and accelerations of arm motions, by the numbers that are written.
#include <cmath>

#include <gtest/gtest.h>

#include "planner/arm/arm_motion.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// Pushes that need not stick: what they ask of the arm.
Plan any_pushes(const Model& model, Random& random) {
  Plan plan{.start = model.scene.start};
  Grasp grasp = plan.start;
  for (int i = 0; i < 3; ++i) {
    const LinearPush push{
        .contact = random.below(static_cast<int>(model.contacts.size())),
        .place = random.in(-0.01, 0.01),
        .e = rotated(random.in(-3.0, 3.0), {1.0, 0.0}),
        .travel = random.in(0.0, 0.05),
        .turn = random.in(-8.0, 8.0)};
    const Grasp end{pusher_pose(push, grasp.X_HO, 1.0), 0.0};
    plan.pushes.push_back({.push = push, .start = grasp, .end = end});
    grasp = end;
  }
  return plan;
}

ArmLimits any_limits(Random& random) {
  ArmLimits limits;
  limits.push_speed = random.log_in(0.01, 2.0);
  limits.transit_speed = random.log_in(0.05, 2.0);
  limits.acceleration = random.log_in(0.03, 3.0);
  limits.turn_speed = random.log_in(0.2, 10.0);
  limits.turn_acceleration = random.log_in(0.5, 100.0);
  return limits;
}

/// Greatest rates of hand and tool by differences of their poses, which are means of the
/// rates over a step or two, in units of the limits.
Vec2 greatest_rates(const std::vector<ArmSample>& s, const ArmLimits& limits) {
  Vec2 most = Vec2::Zero();
  const double dt = 1.0 / limits.rate;
  for (std::size_t k = 2; k < s.size(); ++k) {
    const bool is_one = s[k].phase == s[k - 2].phase && s[k].push == s[k - 2].push &&
                        s[k - 1].t > s[k - 2].t && s[k].t > s[k - 1].t;
    if (!is_one) continue;
    const double speed = s[k].phase == ArmPhase::kPush      ? limits.push_speed
                         : s[k].phase == ArmPhase::kTransit ? limits.transit_speed
                                                            : limits.approach_speed;
    for (ArmPose ArmSample::*whose : {&ArmSample::X_WH, &ArmSample::X_WT}) {
      const auto at = [&](std::size_t j) { return (s[j].*whose).position; };
      const Vec3 second = at(k) - 2.0 * at(k - 1) + at(k - 2);
      const Vec2 rates((at(k) - at(k - 1)).norm() / dt / speed,
                       second.norm() / (dt * dt) / limits.acceleration);
      most = most.cwiseMax(rates);
    }
  }
  return most;
}

TEST(ArmLimits, NeitherHandNorToolExceedsTheLimits) {
  Random random(17);
  Vec2 most = Vec2::Zero();
  for (int i = 0; i < 80; ++i) {
    Scene scene = published_tee(i % 50);
    scene.gripper.tool.p_HT = {random.in(-0.4, 0.4), random.in(-0.4, 0.4), 0.1};
    const Model model = prepare(scene);
    const Plan plan = any_pushes(model, random);
    const ArmLimits limits = any_limits(random);
    const Vec2 rates = greatest_rates(arm_motion(model, plan, limits).samples, limits);
    EXPECT_LE(rates.maxCoeff(), 1.0 + 1e-6) << i << ": " << rates.transpose();
    most = most.cwiseMax(rates);
  }
  EXPECT_GT(most.minCoeff(), 0.99);
}

}  // namespace
}  // namespace prehensile
