#include <cmath>

#include <gtest/gtest.h>

#include "planner/checks/replay.h"
#include "planner/proofs/refuse.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::Random;
using testing::walled_square;

/// Plans the scene and checks the refusal; the proof of another kind must not pass.
void expect_refusal(const Scene& scene, Proof::Kind kind) {
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  EXPECT_EQ(plan.status, PlanStatus::kInfeasible);
  EXPECT_EQ(plan.proof.kind, kind) << name(plan.proof.kind);
  std::string why;
  EXPECT_TRUE(verify(model, plan.proof, &why)) << why;
  EXPECT_FALSE(plan.message.empty());
  Model easier = prepare(walled_square());
  EXPECT_FALSE(verify(easier, plan.proof, &why));
  EXPECT_FALSE(why.empty());
}

TEST(Proofs, GoalOffTheObject) {
  Scene scene = walled_square();
  scene.goal = goal_at({0.06, 0.0}, 0.5);
  expect_refusal(scene, Proof::Kind::kGoalOffObject);
  scene.goal->theta.reset();
  scene.goal->x = 0.08;
  expect_refusal(scene, Proof::Kind::kGoalOffObject);
  scene.goal->y.reset();
  expect_refusal(scene, Proof::Kind::kGoalOffObject);
}

/// The pads touch a can along its middle line only: beside it they hold nothing, and a
/// goal that some pose of reaches the line is not refused.
TEST(Proofs, GoalBesideTheMiddleLineOfACan) {
  Random random(12);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene = random_regrasp(RegraspFamily::kCylinder, 4, i % 30).scene;
    const auto& can = std::get<CylinderShape>(scene.object.shape);
    const Vec2 p_OF = random.in_box(1.1 * can.radius, 0.4 * can.length);
    scene.goal = goal_at(can.axis == Axis::kY ? p_OF : perp(p_OF), random.in(-kPi, kPi));
    const Model model = prepare(scene);
    std::string why;
    const bool off = verify(model, Proof{.kind = Proof::Kind::kGoalOffObject}, &why);
    refused += off;
    for (int k = 0; k < 40; ++k) {
      const Goal& goal = *scene.goal;
      const PlanarPose X_HO{*goal.x + random.in(-0.7, 0.7) * goal.position_tolerance,
                            *goal.y + random.in(-0.7, 0.7) * goal.position_tolerance,
                            *goal.theta + random.in(-1.0, 1.0) * goal.angle_tolerance};
      EXPECT_FALSE(off && pads_on_object(model, X_HO)) << i;
    }
  }
  EXPECT_GT(refused, 60);
  EXPECT_LT(refused, 290);
}

TEST(Proofs, GoalAtTheBorderIsNotRefused) {
  Scene scene = walled_square();
  scene.goal = goal_at({-0.0505, 0.0}, 0.1);  // within the tolerance of a goal on it
  EXPECT_EQ(find_proof(prepare(scene)).kind, Proof::Kind::kNone);
}

TEST(Proofs, StartFalls) {
  Scene scene = walled_square();
  scene.gripper.grip_force = 2.0;
  scene.start.X_HO = pose_from_finger({0.045, 0.0}, 0.0);
  scene.goal = goal_at({0.0, 0.0}, 0.0);
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.proof.kind, Proof::Kind::kStartFalls);
  EXPECT_TRUE(verify(model, plan.proof));
  Proof tampered = plan.proof;
  tampered.twist = -tampered.twist;
  EXPECT_FALSE(verify(model, tampered));
  tampered.twist.setZero();
  EXPECT_FALSE(verify(model, tampered));
}

TEST(Proofs, WithoutGripOrFrictionTheStartFalls) {
  for (const bool grip : {true, false}) {
    Scene scene = walled_square();
    if (grip) {
      scene.gripper.friction = {0.0, 0.0};
    } else {
      scene.gripper.grip_force = 0.0;
    }
    scene.goal = goal_at({0.0, 0.0}, 0.0);
    expect_refusal(scene, Proof::Kind::kStartFalls);
  }
}

TEST(Proofs, GoalFalls) {
  Scene scene = walled_square();
  scene.gripper.grip_force = 8.0;
  scene.goal = goal_at({-0.045, 0.0}, 0.0);
  expect_refusal(scene, Proof::Kind::kGoalFalls);
}

/// An object that turns about a point takes gravity in other attitudes with it.
TEST(Proofs, NoGoalFallsAboutAPoint) {
  Scene scene = walled_square();
  scene.gripper.grip_force = 8.0;
  scene.goal = goal_at({-0.045, 0.0}, 0.0);
  const Proof of_lines = find_proof(prepare(scene));
  ASSERT_EQ(of_lines.kind, Proof::Kind::kGoalFalls);
  scene.pushers.front().feature = PointFeature{};
  std::string why;
  EXPECT_FALSE(verify(prepare(scene), of_lines, &why));
  EXPECT_NE(why.find("point"), std::string::npos);
}

/// The hand may hold the start with the force of the first push.
TEST(Proofs, StartFallsOnlyIfItDoesWithTheGreatestGrip) {
  Scene scene = walled_square();
  scene.gripper.grip_force = 2.0;
  scene.start.X_HO = pose_from_finger({0.045, 0.0}, 0.0);
  scene.goal = goal_at({0.0, 0.0}, 0.0);
  const Proof falls = find_proof(prepare(scene));
  ASSERT_EQ(falls.kind, Proof::Kind::kStartFalls);
  scene.gripper.grip_range = Vec2(2.0, 60.0);
  const Model model = prepare(scene);
  EXPECT_FALSE(verify(model, falls));
  const Plan plan = plan_regrasp(model);
  ASSERT_TRUE(plan.usable()) << plan.message;
  const Replay done = replay(model, plan);
  EXPECT_TRUE(done.agrees) << done.why;
  scene.gripper.grip_range = Vec2(2.0, 2.5);
  EXPECT_EQ(find_proof(prepare(scene)).kind, Proof::Kind::kStartFalls);
}

TEST(Proofs, NoPusher) {
  Scene scene = walled_square();
  scene.pushers.clear();
  expect_refusal(scene, Proof::Kind::kNoPusher);
}

Scene can_among_ends() {
  Scene scene;
  scene.object.shape = CylinderShape{.radius = 0.03, .length = 0.1, .axis = Axis::kX};
  scene.object.mass = 0.2;
  scene.gripper.pad = RectanglePad{{0.02, 0.02}};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {
      {.name = "left", .feature = LineFeature{}, .friction = 0.8},
      {.name = "right", .feature = LineFeature{}, .friction = 0.8, .normal_angle = kPi}};
  scene.goal = goal_at({0.01, 0.0}, 0.0);
  scene.goal->psi = 1.0;
  return scene;
}

TEST(Proofs, NoRoll) {
  Scene scene = can_among_ends();
  const Model model = prepare(scene);
  const Proof proof = find_proof(model);
  EXPECT_EQ(proof.kind, Proof::Kind::kNoRoll);
  scene.pushers.push_back({.name = "floor",
                           .feature = LineFeature{},
                           .friction = 0.8,
                           .normal_angle = 0.5 * kPi});
  std::string why;
  EXPECT_FALSE(verify(prepare(scene), proof, &why));
}

/// A bar that lies in the hand, with walls at its ends, and a goal on its next side.
TEST(Proofs, NoRollOfAPrism) {
  Scene scene = can_among_ends();
  scene.object.shape = PrismShape{
      {{-0.02, -0.02}, {0.02, -0.02}, {0.02, 0.02}, {-0.02, 0.02}}, 0.1, Axis::kX};
  scene.goal->psi = 0.5 * kPi;
  const Proof proof = find_proof(prepare(scene));
  EXPECT_EQ(proof.kind, Proof::Kind::kNoRoll);
  std::string why;
  EXPECT_TRUE(verify(prepare(scene), proof, &why)) << why;
  scene.pushers.push_back({.name = "floor",
                           .feature = LineFeature{},
                           .friction = 0.8,
                           .normal_angle = 0.5 * kPi});
  EXPECT_FALSE(verify(prepare(scene), proof, &why));
  scene.goal->psi = 0.0;
  scene.pushers.pop_back();
  EXPECT_FALSE(verify(prepare(scene), proof, &why));
}

TEST(Proofs, HalfSpace) {
  Scene scene = walled_square();
  scene.g_W.setZero();
  scene.pushers.resize(
      1);  // the wall pushes the object towards +x: the finger goes to -x
  scene.goal = goal_at({0.03, 0.0}, 0.1);
  expect_refusal(scene, Proof::Kind::kHalfSpace);
  const Model model = prepare(scene);
  Proof proof = find_proof(model);
  proof.direction = rotated(2.0, proof.direction);
  EXPECT_FALSE(verify(model, proof));
  proof.direction *= 3.0;
  EXPECT_FALSE(verify(model, proof));
}

/// Nothing that a sequence of sticking pushes reaches is refused.
TEST(Proofs, FeasibleProblemsHaveNone) {
  for (int i = 0; i < 60; ++i) {
    const RandomRegrasp regrasp = random_regrasp(static_cast<RegraspFamily>(i % 3), 7, i);
    const Model model = prepare(regrasp.scene);
    EXPECT_EQ(find_proof(model).kind, Proof::Kind::kNone) << i;
    Random random(i);
    for (const Vec2& direction : {random.direction(), random.direction()}) {
      Proof invented;
      invented.kind = Proof::Kind::kHalfSpace;
      invented.direction = direction;
      EXPECT_FALSE(verify(model, invented)) << i;
    }
  }
}

}  // namespace
}  // namespace prehensile
