/// From a box of parameters to the margin of the stick tests: what the margin accepts,
/// every scene in the box does.
#include <cstdio>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "primitives/uncertainty.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

Scene random_scene(Random& random) {
  Scene scene;
  scene.object.shape = BoxShape{{random.in(0.06, 0.15), random.in(0.06, 0.15), 0.03}};
  scene.object.mass = random.log_in(0.02, 0.6);
  scene.object.p_OCom = random.in_box(0.01, 0.01);
  scene.gripper.pad = DiscPad{random.in(0.004, 0.012)};
  scene.gripper.friction = {random.in(0.3, 1.0), random.in(0.3, 1.0)};
  scene.gripper.grip_force = random.log_in(10.0, 60.0);
  scene.overhang = Overhang::kIgnore;
  scene.g_W = 9.81 * random.direction();
  if (random.chance(0.3)) scene.g_Wz = random.in(-5.0, 5.0);
  Pusher pusher;
  pusher.name = "edge";
  pusher.feature = LineFeature{};
  pusher.friction = random.in(0.2, 1.0);
  pusher.faces = {"-x"};
  pusher.normal_angle = random.in(-3.0, 3.0);
  scene.pushers.push_back(pusher);
  return scene;
}

UncertaintyBox random_box(Random& random) {
  UncertaintyBox box;
  for (const Unknown unknown : {Unknown::kFriction, Unknown::kFingerFriction,
                                Unknown::kGripForce, Unknown::kMass}) {
    box[unknown] = random.in(0.0, 0.2);
  }
  box[Unknown::kCentreOfMassX] = random.in(0.0, 2e-3);
  box[Unknown::kCentreOfMassY] = random.in(0.0, 2e-3);
  box[Unknown::kPlace] = random.in(0.0, 2e-3);
  box[Unknown::kGraspX] = random.in(0.0, 2e-3);
  box[Unknown::kGraspY] = random.in(0.0, 2e-3);
  box[Unknown::kGraspAngle] = random.in(0.0, 0.05);
  box[Unknown::kTilt] = random.in(0.0, 0.03);
  if (random.chance(0.3)) box[Unknown::kDirection] = random.in(0.0, 0.03);
  return box;
}

/// Over the ellipsoid for every scene; over the points that stand for a disc up to what
/// they differ from it where its centre of rotation passes between them.
TEST(MarginOfBox, EverySceneOfTheBoxSticksWhereTheMarginSaysSo) {
  constexpr double kQuadrature = 0.05;
  Random random(1);
  int accepted = 0, slips = 0, pad_slips = 0;
  double worst = 1.0;
  for (int i = 0; i < 6000; ++i) {
    const Scene scene = random_scene(random);
    const Model model = prepare(scene);
    if (model.F == 0.0) continue;
    const UncertaintyBox box = random_box(random);
    const Margin margin = margin_of(model, box);
    const PushContact& contact = model.contacts[0];
    const Vec2 p_OF = random.in_box(0.02, 0.02);
    const Grasp start{pose_from_finger(p_OF, random.in(-3.0, 3.0)), 0.0};
    LinearPush push;
    push.e = rotated(random.in(-0.7, 0.7), contact.n);
    push.travel = 0.02;
    push.turn = random.chance(0.3) ? 0.0 : random.in(-2.0, 2.0);
    const double robust = robust_slack(stick_contact(model, contact, push.place), p_OF,
                                       push.travel * push.e, push.turn, margin);
    const StickTest pads = exact_stick_test(model, contact, push.place, start.X_HO,
                                            push.e, push.travel, push.turn, margin);
    if (!(std::min(robust, pads.slack) >= 0.0)) continue;
    ++accepted;
    for (int m = 0; m < 20; ++m) {
      const auto index =
          20 * static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(m);
      const BoxPoint at =
          m % 2 ? random_point(7, index) : corner(box, index * 2654435761U % 4096U);
      const UncertainPush member = vary(scene, start, push, box, at);
      const Model other = prepare(member.scene);
      const LinearPush& varied = std::get<LinearPush>(member.push);
      const StickTest closed = stick_test(
          stick_contact(other, other.contacts[0], varied.place), other.F,
          finger_in_object(member.start.X_HO), varied.e, varied.travel, varied.turn);
      slips += !(closed.slack >= -1e-9);
      const double slack =
          exact_stick_test(other, other.contacts[0], varied.place, member.start.X_HO,
                           varied.e, varied.travel, varied.turn, Margin::none())
              .slack;
      pad_slips += !(slack >= -1e-9);
      worst = std::min(worst, slack);
    }
  }
  std::printf(
      "%d pushes accepted, 20 scenes each: %d slip over the ellipsoid, %d over "
      "16 points, least slack %.1e\n",
      accepted, slips, pad_slips, worst);
  EXPECT_GT(accepted, 500);
  EXPECT_EQ(slips, 0);
  EXPECT_LT(pad_slips, accepted / 100);
  EXPECT_GT(worst, -kQuadrature);
}

TEST(MarginOfBox, UsualBoxIsSmall) {
  Random random(2);
  Scene scene = random_scene(random);
  scene.g_Wz = 0.0;
  const Margin margin = margin_of(prepare(scene), usual_box());
  EXPECT_NEAR(margin.friction, 0.10, 1e-12);
  EXPECT_NEAR(margin.force, 1.01 / (0.95 * 0.97) - 1.0, 1e-12);
  EXPECT_NEAR(margin.torque_radius, 0.10, 1e-12);
  EXPECT_NEAR(margin.grasp, 0.5e-3 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(margin.centre_of_mass, 0.7e-3 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(margin.place, 1e-3, 1e-12);
}

TEST(MarginOfBox, UsualMarginCoversDiscsOverSoftPoints) {
  Random random(2);
  Scene scene = random_scene(random);
  scene.g_Wz = 0.0;
  scene.gripper.pad = DiscPad{0.01};
  const Model discs = prepare(scene);
  EXPECT_NEAR(usual_margin(discs).torque_radius, 0.10, 1e-12);
  scene.gripper.pad = PointPad{.spin_radius = discs.c};
  const Margin margin = usual_margin(prepare(scene));
  EXPECT_NEAR(margin.torque_radius, 0.20, 1e-12);
  EXPECT_NEAR(margin.friction, 0.10, 1e-12);
}

TEST(MarginOfBox, NothingUncertainIsNoMargin) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Model model = prepare(random_scene(random));
    if (model.F == 0.0) continue;
    EXPECT_TRUE(margin_of(model, UncertaintyBox{}).is_none());
  }
}

TEST(MarginOfBox, NoGripLeftIsAnInfiniteMargin) {
  Random random(4);
  Scene scene = random_scene(random);
  scene.g_Wz = 0.0;
  UncertaintyBox box;
  box[Unknown::kGripForce] = 2.0 * scene.gripper.grip_force;
  box.is_absolute[static_cast<std::size_t>(Unknown::kGripForce)] = true;
  EXPECT_TRUE(std::isinf(margin_of(prepare(scene), box).force));
}

TEST(MarginOfBox, TheSceneStatesABoxOrADistribution) {
  Random random(5);
  Scene scene = random_scene(random);
  EXPECT_TRUE(box_of(scene).active().empty());
  scene.uncertainty = Uncertainty{.friction = 0.1, .start_position = 1e-3};
  EXPECT_EQ(box_of(scene)[Unknown::kFriction], 0.1);
  EXPECT_EQ(box_of(scene)[Unknown::kGraspY], 1e-3);
  scene.uncertainty->spread = Spread::kNormal;
  scene.uncertainty->sigmas = 2.5;
  EXPECT_EQ(box_of(scene)[Unknown::kFriction], 0.25);
  EXPECT_EQ(stated_box(scene)[Unknown::kFriction], 0.1);
}

}  // namespace
}  // namespace prehensile
