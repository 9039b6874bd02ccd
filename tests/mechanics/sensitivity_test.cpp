#include "mechanics/sensitivity.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "problems/random_instants.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// Away from changes of mode the derivative is the limit of differences.
TEST(Sensitivity, IsTheLimitOfDifferences) {
  Random random(1);
  std::map<ContactMode, int> seen;
  for (int i = 0; i < 1500; ++i) {
    const RandomInstant instant =
        random_instant(11, i, {.points_per_pad = 8, .inertia = i % 3 == 0 ? 5.0 : 0.0});
    const PlanarInstant answer = solve_planar(instant.grasp, instant.drive);
    const DifferentiatedInstant differentiated(instant.grasp, instant.drive, answer);
    if (!differentiated.is_differentiable() || differentiated.mode_slack() < 2e-3) {
      continue;
    }
    PlanarVariation variation;
    const double F0 = instant.grasp.capacity();
    const double V0 = instant.drive.V_HP.head<2>().norm();
    for (int j = 0; j < instant.grasp.count; ++j) {
      variation.bound[j] = instant.grasp.bound[j] * random.in(-1.0, 1.0);
    }
    variation.w_g << 0.1 * F0 * random.direction(), 0.0;
    variation.mu = random.in(-1.0, 1.0);
    const Vec2 shift = 0.01 * random.in(-1.0, 1.0) * instant.drive.t_H();
    variation.p_HC = {shift, shift};
    variation.V_HP << 0.3 * V0 * random.direction(), 3.0 * V0 * random.in(-1.0, 1.0);

    const auto at = [&](double step) {
      PlanarGrasp grasp = instant.grasp;
      PlanarDrive drive = instant.drive;
      for (int j = 0; j < grasp.count; ++j) grasp.bound[j] += step * variation.bound[j];
      grasp.w_g += step * variation.w_g;
      drive.mu += step * variation.mu;
      for (int k = 0; k < drive.count; ++k) drive.p_HC[k] += step * variation.p_HC[k];
      drive.V_HP += step * variation.V_HP;
      return solve_planar(grasp, drive);
    };
    const PlanarSensitivity change = differentiated.along(variation);
    // The differences err by curvature where the step is large, by rounding where small.
    double twist_error = 1.0;
    double force_error = 1.0;
    for (const double step : {1e-5, 1e-6}) {
      const PlanarInstant above = at(step);
      const PlanarInstant below = at(-step);
      if (above.status != InstantStatus::kMoves || below.status != above.status) continue;
      const PlanarTwist V = (above.V_HO - below.V_HO) / (2.0 * step);
      const double size = change.V_HO.norm() + answer.V_HO.norm();
      twist_error = std::min(twist_error, (change.V_HO - V).norm() / size);
      const double force = (above.push_force - below.push_force) / (2.0 * step);
      force_error = std::min(
          force_error, std::abs(change.push_force - force) / (std::abs(force) + F0));
    }
    EXPECT_LT(twist_error, 1e-4) << i;
    EXPECT_LT(force_error, 1e-4) << i;
    ++seen[answer.pusher[0].mode];
  }
  EXPECT_GT(seen[ContactMode::kStick], 150);
  EXPECT_GT(seen[ContactMode::kSlipPlus], 20);
  EXPECT_GT(seen[ContactMode::kSlipMinus], 20);
}

Scene box_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.06, 0.03}};
  scene.object.mass = 0.3;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.5, 0.4};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "pin", .feature = PointFeature{}, .friction = 0.2}};
  return scene;
}

/// The parameters of a scene, each against a scene in which it is a little different.
TEST(Sensitivity, OfTheParametersOfAScene) {
  const double place = 0.012;
  const auto instant = [&](const Scene& scene, double at_place, double direction) {
    const Model model = prepare(scene);
    PlanarTwist V_HP;
    V_HP << 0.01 * rotated(direction, {1.0, 0.0}), 0.0;
    const PushContact& contact = model.contacts[0];
    return solve_planar(grasp_at(model, {}, contact.g_O),
                        drive_at(contact, at_place, {}, V_HP));
  };
  const Model model = prepare(box_scene());
  const PushContact& contact = model.contacts[0];
  const PlanarTwist V_HP(0.01, 0.0, 0.0);
  const PlanarGrasp grasp = grasp_at(model, {}, contact.g_O);
  const PlanarDrive drive = drive_at(contact, place, {}, V_HP);
  const PlanarInstant answer = solve_planar(grasp, drive);
  const DifferentiatedInstant differentiated(grasp, drive, answer);
  ASSERT_TRUE(differentiated.is_differentiable());
  ASSERT_GT(differentiated.mode_slack(), 1e-3);
  constexpr double kStep = 1e-6;
  for (int p = 0; p < static_cast<int>(InstantParameter::kCount); ++p) {
    const auto parameter = static_cast<InstantParameter>(p);
    const auto changed = [&](double step) {
      Scene scene = box_scene();
      if (parameter == InstantParameter::kFrictionJaw1) scene.gripper.friction[0] += step;
      if (parameter == InstantParameter::kFrictionJaw2) scene.gripper.friction[1] += step;
      if (parameter == InstantParameter::kGripForce) scene.gripper.grip_force += step;
      if (parameter == InstantParameter::kMass) scene.object.mass += step;
      if (parameter == InstantParameter::kPusherFriction) {
        scene.pushers[0].friction += step;
      }
      return instant(scene, place + (parameter == InstantParameter::kPlace ? step : 0.0),
                     parameter == InstantParameter::kDirection ? step : 0.0);
    };
    const PlanarInstant above = changed(kStep);
    const PlanarInstant below = changed(-kStep);
    const PlanarSensitivity change =
        differentiated.along(variation_of(model, contact, place, {}, V_HP, parameter));
    const double force = (above.push_force - below.push_force) / (2.0 * kStep);
    EXPECT_NEAR(change.push_force, force, 1e-4 * std::abs(force) + 1e-6)
        << name(parameter);
    for (int k = 0; k < 3; ++k) {
      const double V = (above.V_HO[k] - below.V_HO[k]) / (2.0 * kStep);
      EXPECT_NEAR(change.V_HO[k], V, 1e-4 * std::abs(V) + 1e-7) << name(parameter);
    }
  }
}

/// Straight slide of a line pusher: the force is 2 mu N to the last digit, so its
/// derivatives are known.
TEST(Sensitivity, StraightSlideHasItsClosedForm) {
  Scene scene = box_scene();
  scene.g_W.setZero();
  scene.pushers[0].feature = LineFeature{};
  const Model model = prepare(scene);
  const PushContact& contact = model.contacts[0];
  const PlanarTwist V_HP(0.01, 0.0, 0.0);
  const PlanarGrasp grasp = grasp_at(model, {}, contact.g_O);
  const PlanarDrive drive = drive_at(contact, 0.0, {}, V_HP);
  const PlanarInstant answer = solve_planar(grasp, drive);
  const DifferentiatedInstant differentiated(grasp, drive, answer);
  const auto force = [&](InstantParameter parameter) {
    return differentiated.along(variation_of(model, contact, 0.0, {}, V_HP, parameter))
        .push_force;
  };
  EXPECT_NEAR(force(InstantParameter::kFrictionJaw1), 20.0, 1e-9);
  EXPECT_NEAR(force(InstantParameter::kGripForce), 0.9, 1e-9);
  EXPECT_NEAR(force(InstantParameter::kPusherFriction), 0.0, 1e-9);
  EXPECT_NEAR(force(InstantParameter::kDirection), 0.0, 1e-9);
}

TEST(Sensitivity, IsUnsetWhereTheAnswerIsNotSmooth) {
  const Model model = prepare(box_scene());
  const PushContact& contact = model.contacts[0];
  const PlanarGrasp grasp = grasp_at(model, {}, contact.g_O);
  const PlanarDrive drive = drive_at(contact, 0.0, {}, PlanarTwist(0.0, 0.01, 0.0));
  const PlanarInstant holds = solve_planar(grasp, drive);
  ASSERT_NE(holds.status, InstantStatus::kMoves);
  const DifferentiatedInstant differentiated(grasp, drive, holds);
  EXPECT_FALSE(differentiated.is_differentiable());
  PlanarVariation variation;
  variation.bound.fill(0.0);
  EXPECT_FALSE(differentiated.along(variation).valid());
}

TEST(Sensitivity, UsesNoHeap) {
  const RandomInstant instant = random_instant(11, 3, {.points_per_pad = 16});
  const PlanarInstant answer = solve_planar(instant.grasp, instant.drive);
  PlanarVariation variation;
  variation.bound.fill(1.0);
  const testing::NoHeapScope scope;
  const DifferentiatedInstant differentiated(instant.grasp, instant.drive, answer);
  const PlanarSensitivity change = differentiated.along(variation);
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_TRUE(change.valid() || !differentiated.is_differentiable());
}

}  // namespace
}  // namespace prehensile
