#include "mechanics/solvers.h"

#include <gtest/gtest.h>

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

InstantQuestion random_question(const Model& model, Random& random,
                                const SpatialQuestionOptions& options = {}) {
  const PushContact& contact = model.contacts[random.below(2)];
  const PlanarPose X_HO =
      pose_from_finger(random.in_box(0.035, 0.018), random.in(-3.0, 3.0));
  const Vec2 v = 0.01 * rotated(X_HO.theta + random.in(-0.8, 0.8), contact.n);
  const double place = contact.is_point ? random.in(-0.02, 0.02) : 0.0;
  return question_at(model, contact, place, X_HO, in_space({v.x(), v.y(), 0.0}), options);
}

TEST(Solvers, EveryOneIsCalledByItsName) {
  std::vector<std::string_view> names;
  for (const Solver solver : built_solvers()) {
    EXPECT_NE(solver, Solver::kChoose);
    EXPECT_FALSE(name(solver).empty());
    for (const std::string_view other : names) EXPECT_NE(other, name(solver));
    names.push_back(name(solver));
  }
  EXPECT_GE(names.size(), 4u);
}

/// In the mid-plane the exact solvers agree, and the choice is the planar one.
TEST(Solvers, ExactOnesAgreeInThePadPlane) {
  const Model model = prepare(box_scene());
  Random random(4);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const InstantQuestion question = random_question(model, random);
    EXPECT_EQ(chosen_solver(question).solver, Solver::kPlanar);
    const InstantAnswer planar = solve(question);
    const InstantAnswer spatial = solve(question, {.solver = Solver::kSpatial});
    if (planar.status != InstantStatus::kMoves) continue;
    ASSERT_TRUE(usable(spatial.status)) << i << ' ' << name(spatial.status);
    EXPECT_TRUE(planar.certified());
    EXPECT_TRUE(spatial.certified());
    EXPECT_NEAR(planar.push_force, spatial.push_force, 1e-4 * planar.push_force) << i;
    EXPECT_LT((in_pad_plane(planar.V_HO) - in_pad_plane(spatial.V_HO)).norm(), 1e-3) << i;
    ++compared;
  }
  EXPECT_GT(compared, 40);
}

/// With inertia too: rates are accelerations from rest.
TEST(Solvers, ExactOnesAgreeFromRest) {
  const Model model = prepare(box_scene());
  Random random(5);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    InstantQuestion question = random_question(model, random, {.from_rest = true});
    const InstantAnswer planar = solve(question, {.solver = Solver::kPlanar});
    const InstantAnswer spatial = solve(question, {.solver = Solver::kSpatial});
    if (planar.status != InstantStatus::kMoves) continue;
    ASSERT_TRUE(usable(spatial.status)) << i << ' ' << name(spatial.status);
    EXPECT_TRUE(spatial.certified());
    EXPECT_NEAR(planar.push_force, spatial.push_force, 1e-4 * planar.push_force) << i;
    ++compared;
  }
  EXPECT_GT(compared, 40);
}

/// Soft points: the ellipsoid in closed form and the spatial solver, point by point, are
/// two ways to the same answer.
TEST(Solvers, SoftPointsAreAnEllipsoid) {
  Scene scene = box_scene();
  scene.gripper.pad = PointPad{.spin_radius = 0.006};
  const Model model = prepare(scene);
  EXPECT_NEAR(model.c, 0.006, 1e-4);
  Random random(6);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    InstantQuestion question = random_question(model, random);
    question.surface.c = 0.006;
    EXPECT_EQ(chosen_solver(question).solver, Solver::kClosedForm);
    EXPECT_NE(refusal(Solver::kPlanar, question), nullptr);
    const InstantAnswer closed = solve(question);
    const InstantAnswer spatial = solve(question, {.solver = Solver::kSpatial});
    if (closed.status != InstantStatus::kMoves) continue;
    ASSERT_TRUE(usable(spatial.status)) << i << ' ' << name(spatial.status);
    EXPECT_TRUE(closed.certified());
    EXPECT_TRUE(spatial.certified());
    EXPECT_NEAR(closed.push_force, spatial.push_force, 1e-4 * closed.push_force) << i;
    EXPECT_LT((in_pad_plane(closed.V_HO) - in_pad_plane(spatial.V_HO)).norm(), 1e-3) << i;
    ++compared;
  }
  EXPECT_GT(compared, 40);
}

/// Pressure that is given, or free, in a symmetric push: the given split is what the
/// foundation holds as well; the free one has it among its answers.
TEST(Solvers, PressureLawsAgreeWhereNothingShifts) {
  Scene scene = box_scene();
  const Model foundation = prepare(scene);
  scene.gripper.pressure.law = PressureLaw::kGiven;
  const Model given = prepare(scene);
  scene.gripper.pressure.law = PressureLaw::kFree;
  const Model free = prepare(scene);
  EXPECT_FALSE(given.needs_space(given.contacts[0]));
  EXPECT_TRUE(free.needs_space(free.contacts[0]));
  const SpatialTwist V_HP = in_space({0.01, 0.0, 0.0});
  const auto force = [&](const Model& model) {
    const InstantAnswer now = solve(question_at(model, model.contacts[0], 0.0, {}, V_HP),
                                    {.solver = Solver::kSpatial});
    EXPECT_TRUE(has_motion(now.status)) << name(now.status);
    EXPECT_TRUE(now.certified());
    return now.push_force;
  };
  EXPECT_NEAR(force(given), force(foundation), 1e-5 * force(foundation));
  EXPECT_NEAR(force(free), force(foundation), 1e-5 * force(foundation));
}

/// Pads loaded more in the middle turn more easily; the torque radius of Hertz pressure
/// over a disc is 3 pi / 16 of its radius, of uniform pressure 2 / 3.
TEST(Solvers, ProfilesChangeTheTorqueRadius) {
  Scene scene = box_scene();
  const double r = 0.009;
  EXPECT_NEAR(prepare(scene).c, 2.0 / 3.0 * r, 1e-9);
  scene.gripper.pressure.profile = PressureProfile::kHertz;
  EXPECT_NEAR(prepare(scene, {.points_per_pad = 64}).c, 3.0 * 3.14159265 / 16.0 * r,
              0.01 * r);
  scene.gripper.pressure = {.edge_load = 1.0};
  EXPECT_NEAR(prepare(scene, {.points_per_pad = 64}).c, 4.0 / 5.0 * r, 1e-3 * r);
  scene.gripper.pressure = {.edge_load = -0.5};
  EXPECT_LT(prepare(scene).c, 2.0 / 3.0 * r);
}

/// A weight along the closing direction that the jaws cannot carry is a result.
TEST(Solvers, WhatFallsThroughTheJawsIsDynamic) {
  Scene scene = box_scene();
  scene.g_W = Vec2::Zero();
  scene.g_Wz = -9.81;
  scene.object.mass = 10.0;
  const auto status = [&scene] {
    const Model model = prepare(scene);
    return solve(
               question_at(model, model.contacts[0], 0.0, {}, in_space({0.01, 0.0, 0.0})))
        .status;
  };
  EXPECT_EQ(status(), InstantStatus::kDynamic);
  scene.gripper.grip_force = 60.0;
  EXPECT_NE(status(), InstantStatus::kDynamic);
  scene.gripper.jaw_mode = JawMode::kIndependent;
  EXPECT_EQ(status(), InstantStatus::kDynamic);
}

TEST(Solvers, RefusalsSayWhy) {
  const Model model = prepare(box_scene());
  SpatialTwist V_HP = in_space({0.01, 0.0, 0.0});
  V_HP[2] = 0.001;
  const InstantQuestion rising = question_at(model, model.contacts[0], 0.0, {}, V_HP);
  EXPECT_EQ(chosen_solver(rising).solver, Solver::kSpatial);
  EXPECT_NE(refusal(Solver::kPlanar, rising), nullptr);
  EXPECT_EQ(solve(rising, {.solver = Solver::kPlanar}).status, InstantStatus::kBadInput);
  EXPECT_EQ(refusal(Solver::kSpatial, rising), nullptr);
}

}  // namespace
}  // namespace prehensile
