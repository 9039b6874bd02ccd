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
    const SpatialProblem problem =
        spatial_problem_at(model, contact, place, X_HO, in_space(V_HP));
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
    const SpatialProblem problem = spatial_problem_at(model, model.contacts[0], 0.0, {},
                                                      in_space(V_HP), {.height = height});
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
      spatial_problem_at(model, model.contacts[0], 0.0, off, in_space({0.01, 0.0, 0.0}))
          .count,
      0);
}

/// Gravity along the closing direction loads one jaw more than the other, by the weight;
/// a pusher without friction takes none of it.
TEST(SpatialModel, GravityAlongTheClosingDirectionShiftsLoadBetweenTheJaws) {
  Scene scene = box_scene();
  scene.pushers[0].friction = 0.0;
  scene.g_W = Vec2::Zero();
  scene.g_Wz = 9.81;
  const double weight = scene.object.mass * scene.g_Wz;
  const auto jaw_loads = [&](JawMode mode) {
    scene.gripper.jaw_mode = mode;
    const Model model = prepare(scene);
    const SpatialProblem problem =
        spatial_problem_at(model, model.contacts[0], 0.0, {}, in_space({0.01, 0.0, 0.0}));
    const SpatialInstant answer = solve_spatial(problem);
    EXPECT_TRUE(usable(answer.status)) << name(answer.status);
    EXPECT_TRUE(certify(problem, answer).holds());
    std::array<double, 2> load{0.0, 0.0};
    for (int p = 0; p < 2; ++p) {
      for (int i = 0; i < problem.patch[p].count; ++i) {
        load[p] += answer.point[problem.patch[p].first + i].normal_force;
      }
      EXPECT_NEAR(load[p], model.jaw_force[p], 1e-6);
    }
    EXPECT_NEAR(answer.push_force, model.F, 1e-5 * model.F);
    return load;
  };
  const double N = scene.gripper.grip_force;
  EXPECT_NEAR(jaw_loads(JawMode::kCoupled)[1], N + 0.5 * weight, 1e-6);
  EXPECT_NEAR(jaw_loads(JawMode::kFixedJaw1)[0], N - weight, 1e-6);
  EXPECT_NEAR(jaw_loads(JawMode::kFixedJaw2)[1], N + weight, 1e-6);
  scene.gripper.jaw_mode = JawMode::kIndependent;
  const Model falls = prepare(scene);
  EXPECT_EQ(falls.F, 0.0);
  EXPECT_EQ(
      spatial_problem_at(falls, falls.contacts[0], 0.0, {}, in_space({0.01, 0.0, 0.0}))
          .count,
      0);
}

/// What is symmetric about the mid-plane is as in the pad plane, whatever the width of
/// the feature: a plane is a line, an upright edge a point.
TEST(SpatialModel, FeaturesWithWidthAreTheirSectionsInThePadPlane) {
  Scene scene = box_scene();
  scene.pushers = {
      {.name = "line", .feature = LineFeature{0.03}, .friction = 0.4},
      {.name = "plane", .feature = PlaneFeature{0.03, 0.02}, .friction = 0.4},
      {.name = "point", .feature = PointFeature{}, .friction = 0.4},
      {.name = "upright", .feature = UprightFeature{0.02}, .friction = 0.4}};
  const Model model = prepare(scene);
  const PlanarTwist V_HP(0.01, 0.002, 0.1);
  const auto answer_of = [&](int contact) {
    EXPECT_FALSE(model.needs_space(model.contacts[contact]));
    const SpatialProblem problem =
        spatial_problem_at(model, model.contacts[contact], 0.004, {}, in_space(V_HP));
    const SpatialInstant answer = solve_spatial(problem);
    EXPECT_TRUE(usable(answer.status)) << name(answer.status);
    EXPECT_TRUE(certify(problem, answer).holds());
    return answer;
  };
  for (const int flat : {0, 2}) {
    const SpatialInstant one = answer_of(flat);
    const SpatialInstant other = answer_of(flat + 1);
    EXPECT_GT(other.count, one.count);
    EXPECT_NEAR(one.push_force, other.push_force, 1e-5 * one.push_force);
    EXPECT_LT((in_pad_plane(one.V_HO) - in_pad_plane(other.V_HO)).norm(), 1e-4);
  }
}

/// A centre of mass off the mid-plane tilts the object against the pads even where the
/// pusher does not.
TEST(SpatialModel, AHighCentreOfMassNeedsSpace) {
  Scene scene = box_scene();
  scene.object.p_OCom = Vec2::Zero();
  scene.object.z_OCom = 0.01;
  const Model model = prepare(scene);
  EXPECT_TRUE(model.needs_space(model.contacts[0]));
  const SpatialProblem problem =
      spatial_problem_at(model, model.contacts[0], 0.0, {}, in_space({0.01, 0.0, 0.0}));
  const double weight = scene.object.mass * scene.g_W.y();
  EXPECT_NEAR(problem.w_g[3], -0.01 * weight, 1e-15);
  const SpatialInstant answer = solve_spatial(problem);
  ASSERT_TRUE(usable(answer.status));
  EXPECT_TRUE(certify(problem, answer).holds());
  EXPECT_NE(answer.V_HO[3], 0.0);
}

}  // namespace
}  // namespace prehensile
