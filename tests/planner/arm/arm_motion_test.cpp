/// The motion of the arm reproduces the plan: seen from the pusher, the hand does what
/// the mechanics of each push assumes.
#include "planner/arm/arm_motion.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

std::vector<Scene> scenes() {
  std::vector<Scene> scenes;
  for (int i = 0; i < 10; ++i) {
    scenes.push_back(published_square(i));
    scenes.push_back(published_tee(i));
    scenes.push_back(random_regrasp(RegraspFamily::kTee, 4, i).scene);
    scenes.push_back(random_regrasp(RegraspFamily::kCylinder, 4, i).scene);
  }
  for (Scene& scene : scenes) {  // a tool as on a Franka hand
    scene.gripper.tool.p_HT = {0.0, 0.1034, 0.01};
    scene.gripper.tool.q_HT = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
  }
  return scenes;
}

/// Also some whose grip force differs from push to push.
std::vector<Scene> scenes_with_grips() {
  std::vector<Scene> all = scenes();
  for (int i = 0; i < 10; ++i) {
    for (Scene scene :
         {published_tee(i), random_regrasp(RegraspFamily::kTee, 4, i).scene}) {
      const double own = scene.gripper.grip_force;
      scene.gripper.grip_range = Vec2(0.2 * own, 2.0 * own);
      all.push_back(scene);
    }
  }
  return all;
}

/// The last sample of a push before this one.
const ArmSample& push_before(const std::vector<ArmSample>& samples, std::size_t i) {
  while (i > 0 && samples[i].phase != ArmPhase::kPush) --i;
  return samples[i];
}

std::vector<ArmPose> poses_of(const ArmMotion& motion, int push, ArmPhase phase) {
  std::vector<ArmPose> poses;
  for (const ArmSample& sample : motion.samples) {
    if (sample.push == push && sample.phase == phase) poses.push_back(sample.X_WH);
  }
  return poses;
}

TEST(ArmMotion, ReplaysEveryPushThroughTheTransition) {
  int pushes = 0;
  int rolls = 0;
  double worst_stray = 0.0;
  for (const Scene& scene : scenes()) {
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable()) << scene.name;
    const ArmMotion motion = arm_motion(model, plan);
    Grasp grasp = model.scene.start;
    for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
      const std::vector<ArmPose> poses =
          poses_of(motion, static_cast<int>(i), ArmPhase::kPush);
      ASSERT_GE(poses.size(), 2u);
      Push push = plan.pushes[i].push;
      if (auto* roll = std::get_if<Roll>(&push)) {
        roll->travel = poses.front().position.z() - poses.back().position.z();
        ++rolls;
      } else {
        const PushFromPoses found = push_from_poses(poses, grasp.X_HO, as_linear(push));
        worst_stray = std::max({worst_stray, found.stray, model.c * found.stray_angle});
        push = found.push;
        ++pushes;
      }
      const Transition done = apply(model, grasp, push);
      ASSERT_TRUE(done.completed()) << scene.name << ": " << done.reason;
      grasp = done.end;
      EXPECT_NEAR(grasp.X_HO.x, plan.pushes[i].end.X_HO.x, 1e-6);
      EXPECT_NEAR(grasp.X_HO.y, plan.pushes[i].end.X_HO.y, 1e-6);
      EXPECT_NEAR(grasp.X_HO.theta, plan.pushes[i].end.X_HO.theta, 1e-6);
      EXPECT_NEAR(grasp.psi, plan.pushes[i].end.psi, 1e-6);
    }
    EXPECT_TRUE(reaches(*scene.goal, grasp)) << scene.name;
  }
  std::printf("%d pushes and %d rolls, at most %.1e m off a straight line\n", pushes,
              rolls, worst_stray);
  EXPECT_GT(pushes, 40);
  EXPECT_GT(rolls, 0);
  EXPECT_LT(worst_stray, 1e-12);
}

/// While it pushes, the face stays on the pusher: W, P and O by the frames of the scene.
TEST(ArmMotion, ThePusherStandsStillInTheWorld) {
  for (const Scene& scene : scenes()) {
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    const ArmMotion motion = arm_motion(model, plan);
    for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
      if (std::holds_alternative<Roll>(plan.pushes[i].push)) continue;
      const LinearPush push = as_linear(plan.pushes[i].push);
      const PushContact& contact = model.contacts[push.contact];
      const Pusher& pusher = scene.pushers[contact.pusher];
      const std::vector<ArmPose> poses =
          poses_of(motion, static_cast<int>(i), ArmPhase::kPush);
      const auto place_of_face = [&](const ArmPose& hand, const PlanarPose& X_HO) {
        const double theta = 2.0 * std::atan2(hand.orientation.z(), hand.orientation.w());
        const PlanarPose X_WH{hand.position.x(), hand.position.y(), theta};
        const PlanarPose X_WO = compose(X_WH, X_HO);
        const Vec2 normal = rotated(X_WO.theta, contact.n);
        EXPECT_NEAR(wrapped(std::atan2(normal.y(), normal.x()) - pusher.normal_angle),
                    0.0, 1e-9);
        return transform(X_WO,
                         Vec2(0.5 * (contact.a + contact.b) + push.place * contact.t));
      };
      EXPECT_LT(
          (place_of_face(poses.front(), plan.pushes[i].start.X_HO) - pusher.p_WP).norm(),
          1e-9);
      EXPECT_LT(
          (place_of_face(poses.back(), plan.pushes[i].end.X_HO) - pusher.p_WP).norm(),
          1e-6);
    }
  }
}

TEST(ArmMotion, KeepsItsLimitsAndStartsAndEndsAtRest) {
  const ArmLimits limits;
  double fastest = 0.0, hardest = 0.0;
  for (const Scene& scene : scenes()) {
    const Model model = prepare(scene);
    const ArmMotion motion = arm_motion(model, plan_regrasp(model), limits);
    const std::vector<ArmSample>& s = motion.samples;
    ASSERT_FALSE(s.empty());
    const double dt = 1.0 / limits.rate;
    for (std::size_t i = 1; i < s.size(); ++i) {
      const double step = s[i].t - s[i - 1].t;
      const double moved = (s[i].X_WH.position - s[i - 1].X_WH.position).norm();
      const double turned =
          s[i].X_WH.orientation.angularDistance(s[i - 1].X_WH.orientation);
      if (step < 1e-9) {  // two phases meet: one pose, at rest
        EXPECT_LT(moved, 1e-6);
        EXPECT_LT(turned, 1e-6);
        continue;
      }
      EXPECT_NEAR(step, dt, 1e-9);
      const double speed = s[i].phase == ArmPhase::kPush      ? limits.push_speed
                           : s[i].phase == ArmPhase::kTransit ? limits.transit_speed
                                                              : limits.approach_speed;
      EXPECT_LE(moved / step, speed * (1.0 + 1e-6));
      EXPECT_LE(turned / step, limits.turn_speed * (1.0 + 1e-6));
      fastest = std::max(fastest, moved / step);
      if (i + 1 < s.size() && s[i + 1].phase == s[i].phase && s[i + 1].t > s[i].t &&
          s[i - 1].phase == s[i].phase) {
        const Vec3 second =
            s[i + 1].X_WH.position - 2.0 * s[i].X_WH.position + s[i - 1].X_WH.position;
        // The turn of the hand adds its own to the path of the finger axis in W.
        const double turning = speed * limits.turn_speed;
        EXPECT_LE(second.norm() / (dt * dt), limits.acceleration + turning + 1e-6);
        hardest = std::max(hardest, second.norm() / (dt * dt));
      }
    }
  }
  std::printf("fastest %.3f m/s, hardest %.3f m/s^2\n", fastest, hardest);
}

TEST(ArmMotion, ToolHangsOnTheHand) {
  const Scene scene = scenes()[1];
  const Model model = prepare(scene);
  const ArmMotion motion = arm_motion(model, plan_regrasp(model));
  for (const ArmSample& sample : motion.samples) {
    const Vec3 p_HT = sample.X_WH.orientation.conjugate() *
                      (sample.X_WT.position - sample.X_WH.position);
    EXPECT_LT((p_HT - scene.gripper.tool.p_HT).norm(), 1e-12);
    const Eigen::Quaterniond q_HT =
        sample.X_WH.orientation.conjugate() * sample.X_WT.orientation;
    EXPECT_NEAR(std::abs(q_HT.x()), std::sqrt(0.5), 1e-12);
  }
}

/// In the air the tool carries the weight, during a push the predicted force as well.
TEST(ArmMotion, LoadsAreWeightAndPush) {
  for (const Scene& scene : scenes()) {
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    const double weight =
        model.mass * std::hypot(scene.g_W.x(), scene.g_W.y(), scene.g_Wz);
    for (const ArmSample& sample : arm_motion(model, plan).samples) {
      const double force = sample.force.norm();
      EXPECT_TRUE(sample.moment.allFinite());
      EXPECT_GT(sample.guard_force, force);
      EXPECT_GT(sample.grip_force, 0.0);
      if (sample.phase != ArmPhase::kPush) {
        EXPECT_NEAR(force, weight, 1e-9);
        continue;
      }
      const double push = plan.pushes[static_cast<std::size_t>(sample.push)].push_force;
      EXPECT_LE(force, weight + 1.01 * push + 1e-9);
    }
  }
}

/// Where phases meet, hand and object stand still under the loads of both: what a push
/// has built up is still there when the next phase begins, and may be early. Neither
/// phase may take that for a fault.
TEST(ArmMotion, GuardsCoverBothSidesOfEveryChangeOfPhase) {
  int changes = 0;
  int from_push = 0;
  for (const Scene& scene : scenes_with_grips()) {
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable()) << scene.name;
    const std::vector<ArmSample> samples = arm_motion(model, plan).samples;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const ArmSample& before = samples[i - 1];
      const ArmSample& after = samples[i];
      if (after.t > before.t) continue;
      ++changes;
      from_push += before.phase == ArmPhase::kPush;
      const double force = std::max(before.force.norm(), after.force.norm());
      EXPECT_GT(before.guard_force, force) << scene.name << " at " << after.t << " s";
      EXPECT_GT(after.guard_force, force) << scene.name << " at " << after.t << " s";
      // A grip phase between push and retreat does not hide what the push built up.
      if (after.phase != ArmPhase::kRetreat) continue;
      EXPECT_GE(after.guard_force, 1.5 * push_before(samples, i).force.norm());
    }
  }
  EXPECT_GT(changes, 200);
  EXPECT_GT(from_push, 50);
}

/// The object lies in the hand as the push before has left it.
TEST(ArmMotion, WeightHangsWhereTheObjectIs) {
  int grips = 0;
  for (const Scene& scene : scenes_with_grips()) {
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    const Vec3 weight(model.mass * scene.g_W.x(), model.mass * scene.g_W.y(),
                      model.mass * scene.g_Wz);
    const std::vector<ArmSample> samples = arm_motion(model, plan).samples;
    bool is_pushed = false;  // by the push that the sample names
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const ArmSample& sample = samples[i];
      if (i == 0 || samples[i - 1].push != sample.push) is_pushed = false;
      is_pushed |= sample.phase == ArmPhase::kPush;
      if (sample.phase == ArmPhase::kPush) continue;
      grips += is_pushed && sample.phase == ArmPhase::kGrip;
      const PlannedPush& planned = plan.pushes[static_cast<std::size_t>(sample.push)];
      const Grasp& grasp = is_pushed ? planned.end : planned.start;
      const Vec2 p_HCom = transform(grasp.X_HO, model.p_OCom);
      const Vec3 lever =
          sample.X_WH.position +
          sample.X_WH.orientation * Vec3(p_HCom.x(), p_HCom.y(), model.z_OCom) -
          sample.X_WT.position;
      const Vec3 moment = sample.X_WT.orientation * sample.moment;
      EXPECT_LT((moment - lever.cross(weight)).norm(), 1e-9) << scene.name;
    }
  }
  EXPECT_GT(grips, 100);
}

/// Relax, push, tighten: the grip changes while the hand stands still at a pusher, and
/// never is less than the scene's or a push's beside it while the hand carries the
/// object.
TEST(ArmMotion, ChangesTheGripAtThePusher) {
  int changes = 0;
  for (int i = 0; i < 10; ++i) {
    Scene scene = published_tee(i);
    const double own = scene.gripper.grip_force;
    scene.gripper.grip_range = Vec2(0.2 * own, 2.0 * own);
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable()) << scene.name;
    const std::vector<ArmSample> samples = arm_motion(model, plan).samples;
    EXPECT_GE(samples.front().grip_force, own);
    EXPECT_GE(samples.back().grip_force, own);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const ArmSample& sample = samples[k];
      const Push& push = plan.pushes[static_cast<std::size_t>(sample.push)].push;
      const double of_push = grip_force_of(model, push);
      if (sample.phase == ArmPhase::kPush) {
        EXPECT_EQ(sample.grip_force, of_push);
      } else if (sample.phase != ArmPhase::kGrip) {
        EXPECT_GE(sample.grip_force, std::max(own, of_push));
      }
      if (k == 0 || sample.phase != ArmPhase::kGrip) continue;
      changes += sample.grip_force != samples[k - 1].grip_force;
      if (samples[k - 1].phase != ArmPhase::kGrip) continue;
      EXPECT_EQ(sample.X_WH.position, samples[k - 1].X_WH.position);
    }
  }
  EXPECT_GT(changes, 0);
}

/// What is refused for its length is counted as it would be sampled.
TEST(ArmMotion, CountsWhatIsTooLong) {
  for (const Scene& scene : scenes_with_grips()) {
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model);
    ArmLimits limits;
    const ArmMotion whole = arm_motion(model, plan, limits);
    const auto samples = static_cast<std::int64_t>(whole.samples.size());
    EXPECT_EQ(whole.seconds, whole.samples.back().t);
    limits.most_samples = samples;
    EXPECT_EQ(arm_motion(model, plan, limits).samples.size(), whole.samples.size());
    limits.most_samples = samples - 1;
    const ArmMotion counted = arm_motion(model, plan, limits);
    EXPECT_TRUE(counted.is_too_long);
    EXPECT_TRUE(counted.samples.empty());
    EXPECT_EQ(counted.seconds, whole.seconds) << scene.name;
  }
}

TEST(ArmMotion, NothingToDoIsNoMotion) {
  Scene scene = published_square(0);
  scene.goal =
      testing::goal_at(finger_in_object(scene.start.X_HO), scene.start.X_HO.theta);
  const Model model = prepare(scene);
  EXPECT_TRUE(arm_motion(model, plan_regrasp(model)).samples.empty());
}

TEST(ArmMotion, PushFromPosesNoticesASplineInTheHandFrame) {
  const Scene scene = published_tee(0);
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  const LinearPush push = as_linear(plan.pushes[0].push);
  std::vector<ArmPose> poses = poses_of(arm_motion(model, plan), 0, ArmPhase::kPush);
  poses[poses.size() / 2].position.x() += 1e-4;
  const PushFromPoses found = push_from_poses(poses, plan.pushes[0].start.X_HO, push);
  EXPECT_GT(found.stray + model.c * found.stray_angle, 1e-5);
}

TEST(ArmMotion, TimeLawIsSmooth) {
  EXPECT_EQ(rest_to_rest(0.0), 0.0);
  EXPECT_EQ(rest_to_rest(1.0), 1.0);
  double rate = 0.0, second = 0.0;
  const double h = 1e-4;
  for (double u = h; u < 1.0; u += h) {
    rate = std::max(rate, (rest_to_rest(u + h) - rest_to_rest(u - h)) / (2.0 * h));
    second = std::max(second, std::abs(rest_to_rest(u + h) - 2.0 * rest_to_rest(u) +
                                       rest_to_rest(u - h)) /
                                  (h * h));
  }
  EXPECT_NEAR(rate, 1.875, 1e-3);
  EXPECT_NEAR(second, 10.0 / std::sqrt(3.0), 1e-2);
}

}  // namespace
}  // namespace prehensile
