#include "mechanics/spatial_model.h"

#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "mechanics/spatial_certificate.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

Scene box_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.06, 0.03}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "wall", .feature = LineFeature{}, .friction = 0.4},
                   {.name = "pin", .feature = PointFeature{}, .friction = 0.3}};
  return scene;
}

/// In the mid-plane both solvers answer the same question.
TEST(SpatialModel, AgreesWithThePlanarQuestionInTheMidPlane) {
  const Model model = prepare(box_scene());
  Random random(1);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const PushContact& contact = model.contacts[random.below(2)];
    const PlanarPose X_HO =
        pose_from_finger(random.in_box(0.035, 0.018), random.in(-3.0, 3.0));
    const Vec2 v = 0.01 * rotated(X_HO.theta + random.in(-0.8, 0.8), contact.n);
    const PlanarTwist V_HP(v.x(), v.y(), 0.0);
    const double place = contact.is_point ? random.in(-0.02, 0.02) : 0.0;
    const PlanarInstant planar = solve_planar(grasp_at(model, X_HO, contact.g_O),
                                              drive_at(contact, place, X_HO, V_HP));
    if (planar.status != InstantStatus::kMoves) continue;
    const SpatialProblem problem = spatial_problem_at(model, contact, place, X_HO, V_HP);
    const SpatialInstant spatial = solve_spatial(problem);
    ASSERT_TRUE(usable(spatial.status)) << i << " " << name(spatial.status);
    EXPECT_TRUE(certify(problem, spatial).holds()) << i;
    EXPECT_NEAR(spatial.push_force, planar.push_force, 1e-4 * planar.push_force) << i;
    EXPECT_NEAR(spatial.V_HO[0], planar.V_HO[0], 1e-5) << i;
    EXPECT_NEAR(spatial.V_HO[1], planar.V_HO[1], 1e-5) << i;
    EXPECT_NEAR(spatial.V_HO[5], planar.V_HO[2], 1e-3) << i;
    ++compared;
  }
  EXPECT_GT(compared, 80);
}

/// Heights above and below the mid-plane are mirror images; a pusher that is off it
/// loads the pads unevenly and tilts the object against their foundations.
TEST(SpatialModel, HeightTiltsTheObjectAgainstThePads) {
  const Model model = prepare(box_scene());
  const PlanarTwist V_HP(0.01, 0.0, 0.0);
  const auto solve = [&](double height) {
    const SpatialProblem problem =
        spatial_problem_at(model, model.contacts[0], 0.0, {}, V_HP, {.height = height});
    const SpatialInstant answer = solve_spatial(problem);
    EXPECT_TRUE(usable(answer.status)) << name(answer.status);
    EXPECT_TRUE(certify(problem, answer).holds());
    return answer;
  };
  const SpatialInstant middle = solve(0.0);
  const SpatialInstant above = solve(0.006);
  const SpatialInstant below = solve(-0.006);
  EXPECT_NEAR(middle.V_HO[4], 0.0, 1e-9);
  EXPECT_GT(std::abs(above.V_HO[4]), 1e-7);
  EXPECT_NEAR(above.V_HO[4], -below.V_HO[4], 1e-6 * std::abs(above.V_HO[4]));
  EXPECT_NEAR(above.push_force, below.push_force, 1e-6 * above.push_force);
}

TEST(SpatialModel, LostPadsAndTooManyPointsGiveNoQuestion) {
  const Model model = prepare(box_scene());
  const PlanarPose off = pose_from_finger({0.2, 0.0}, 0.0);
  EXPECT_EQ(
      spatial_problem_at(model, model.contacts[0], 0.0, off, {0.01, 0.0, 0.0}).count, 0);
}

}  // namespace
}  // namespace prehensile
