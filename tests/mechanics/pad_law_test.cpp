#include "mechanics/pad_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/certificate.h"
#include "mechanics/sticking.h"
#include "problems/published_regrasps.h"
#include "scene/constants.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

Scene random_scene(Random& random) {
  Scene scene = random.chance(0.5) ? published_square(random.below(50))
                                   : published_tee(random.below(50));
  scene.gripper.grip_force = random.log_in(3.0, 100.0);
  scene.g_W = rotated(random.in(-kPi, kPi), {random.in(0.0, 12.0), 0.0});
  for (auto& pusher : scene.pushers) {
    pusher.friction = random.in(0.0, 1.2);
    if (random.chance(0.3)) pusher.feature = PointFeature{};
  }
  return scene;
}

PlanarPose random_pose(const Model& model, Random& random) {
  for (;;) {
    const PlanarPose X_HO =
        pose_from_finger(random.in_box(0.05, 0.05), random.in(-kPi, kPi));
    if (pads_on_object(model, X_HO)) return X_HO;
  }
}

PlanarTwist random_twist(Random& random) {
  const Vec2 v = random.in_disc(1.0);
  return {v.x(), v.y(), random.in(-300.0, 300.0)};
}

TEST(PadLaw, IsTheEllipsoidOfSoftPointsOnly) {
  Scene scene = published_square(0);
  EXPECT_FALSE(prepare(scene).has_soft_points());
  EXPECT_TRUE(prepare(with_soft_points(scene)).has_soft_points());
  EXPECT_NEAR(prepare(with_soft_points(scene)).c, prepare(scene).c, 1e-12);
  scene.gripper.pad = PointPad{};
  EXPECT_FALSE(prepare(scene).has_soft_points());
}

/// A soft point has no rim that could leave the face, and no profile of its pressure.
TEST(PadLaw, OfASoftPointIsTheSameWhereverItStands) {
  Scene scene = with_soft_points(published_square(0));
  scene.overhang = Overhang::kClip;
  scene.gripper.pressure.edge_load = 1.0;
  const Model model = prepare(scene);
  EXPECT_TRUE(model.region.is_fixed_in_hand());
  EXPECT_NEAR(model.c, 0.006, 1e-15);
  const PushContact& contact = model.contacts[0];
  const double slack =
      exact_stick_test(model, contact, 0.0, pose_from_finger({0.049, 0.049}, 0.3),
                       contact.n, 1.0, 0.0, Margin::none())
          .slack;
  Scene ignored = scene;
  ignored.overhang = Overhang::kIgnore;
  EXPECT_EQ(slack, exact_stick_test(prepare(ignored), contact, 0.0,
                                    pose_from_finger({0.049, 0.049}, 0.3), contact.n, 1.0,
                                    0.0, Margin::none())
                       .slack);
}

TEST(PadLaw, AnswersAreThoseOfTheLawAndCertified) {
  Random random(1);
  int soft = 0, moves = 0;
  for (int i = 0; i < 3000; ++i) {
    Scene scene = random_scene(random);
    if (random.chance(0.5)) scene = with_soft_points(scene);
    const Model model = prepare(scene);
    const PushContact& contact =
        model.contacts[random.below(static_cast<int>(model.contacts.size()))];
    const PlanarPose X_HO = random_pose(model, random);
    const PlanarGrasp grasp = grasp_at(model, X_HO, contact.g_O);
    const PlanarDrive drive = drive_at(contact, 0.0, X_HO, random_twist(random));
    const PlanarInstant answer = solve_by_pad_law(model, grasp, drive);
    const bool is_soft = model.has_soft_points();
    soft += is_soft;
    const PlanarInstant own = is_soft
                                  ? solve_limit_surface(model.surface(), grasp.w_g, drive)
                                  : solve_planar(grasp, drive);
    ASSERT_EQ(answer.status, own.status);
    if (!has_motion(answer.status)) continue;
    ++moves;
    EXPECT_LE((answer.V_HO - own.V_HO).norm(), 1e-9 * own.V_HO.norm());
    EXPECT_LE(certify_by_pad_law(model, grasp, drive, answer), 1e-6) << i;
  }
  EXPECT_GT(soft, 1000);
  EXPECT_GT(moves, 1000);
}

/// What needs the least friction to be overcome is a wrench that gravity gives or not.
TEST(PadLaw, GravityIsHeldWhereNoTwistGainsPower) {
  Random random(2);
  int held = 0, falls = 0;
  for (int i = 0; i < 2000; ++i) {
    const Model model = prepare(with_soft_points(random_scene(random)));
    const PlanarPose X_HO = random_pose(model, random);
    const PlanarGrasp grasp = grasp_at(model, X_HO, model.contacts[0].g_O);
    PlanarTwist worst;
    const double slack = gravity_slack_by_pad_law(model, grasp, &worst);
    const auto gain = [&](const PlanarTwist& V) {
      return grasp.w_g.dot(V) - friction_power(model, grasp, V);
    };
    const double size = model.F * std::hypot(worst[0], worst[1], model.c * worst[2]);
    EXPECT_NEAR(gain(worst), -slack * size, 1e-9 * size);
    slack > 0.0 ? ++held : ++falls;
    if (slack < 0.0) continue;
    for (int k = 0; k < 20; ++k) EXPECT_LE(gain(random_twist(random)), 0.0);
  }
  EXPECT_GT(held, 100);
  EXPECT_GT(falls, 100);
}

TEST(PadLaw, FrictionTakesThePowerOfItsWrench) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Model discs = prepare(random_scene(random));
    const Model soft = prepare(with_soft_points(discs.scene));
    const PlanarTwist V = random_twist(random);
    const PlanarPose X_HO = random_pose(soft, random);
    const double power = friction_power(soft, grasp_at(soft, X_HO, {0.0, 0.0}), V);
    EXPECT_NEAR(power, -soft.surface().friction(V).dot(V), 1e-12 * power);
    // The ellipsoid is the stronger by up to 7 per cent.
    const double of_discs = friction_power(discs, grasp_at(discs, X_HO, {0.0, 0.0}), V);
    EXPECT_LE(of_discs, 1.03 * power);
    EXPECT_GE(of_discs, 0.90 * power);
  }
}

/// The test of the real pads is the closed form, over the margin as well.
TEST(PadLaw, StickTestsAreTheClosedForm) {
  Random random(4);
  int sticks = 0;
  for (int i = 0; i < 5000; ++i) {
    Scene scene = with_soft_points(random_scene(random));
    for (auto& pusher : scene.pushers) pusher.feature = LineFeature{};
    const Model model = prepare(scene);
    const PushContact& contact =
        model.contacts[random.below(static_cast<int>(model.contacts.size()))];
    const PlanarPose X_HO = random_pose(model, random);
    const Vec2 e = rotated(random.in(-1.2, 1.2), contact.n);
    const double omega = random.in(-3.0, 3.0) / model.c;
    const Margin margin = random.chance(0.5) ? Margin::none() : Margin{};
    const StickTest test =
        exact_stick_test(model, contact, 0.0, X_HO, e, 1.0, omega, margin);
    const double slack = robust_slack(stick_contact(model, contact, 0.0),
                                      finger_in_object(X_HO), e, omega, margin);
    if (margin.is_none()) {
      EXPECT_NEAR(test.slack, slack, 1e-9 * (1.0 + std::abs(slack))) << i;
    } else {
      // The closed form also looks at torque radii between the ends of the box.
      EXPECT_GE(test.slack, slack - 1e-9 * (1.0 + std::abs(slack))) << i;
    }
    sticks += test.slack >= 0.0;
  }
  EXPECT_GT(sticks, 500);
}

}  // namespace
}  // namespace prehensile
