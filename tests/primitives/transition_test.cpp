#include "primitives/transition.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/primitives/push_checks.h"

namespace prehensile {
namespace {

using testing::has_event;

constexpr double kGravity = 9.81;

/// A square of 100 mm pushed at its face -x: contact 0 by a wall, contact 1 by a point;
/// contact 2 is a floor at -y.
Scene square_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.overhang = Overhang::kIgnore;
  scene.pushers.resize(3);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[1] = {.name = "pin", .feature = PointFeature{}, .friction = 0.5};
  scene.pushers[2] = {.name = "floor", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[2].normal_angle = 0.5 * std::numbers::pi;
  return scene;
}

TEST(Transition, NamesAreTotal) {
  for (int i = 0; i <= static_cast<int>(TransitionStatus::kRefused); ++i) {
    EXPECT_NE(name(static_cast<TransitionStatus>(i)), "unknown");
  }
  for (int i = 0; i <= static_cast<int>(EventKind::kGuard); ++i) {
    EXPECT_NE(name(static_cast<EventKind>(i)), "unknown");
  }
}

TEST(Transition, RefusesWhatCannotBegin) {
  const Model model = prepare(square_scene());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const LinearPush good{0, 0.0, {1.0, 0.0}, 0.01, 0.0};
  ASSERT_TRUE(apply(model, {}, good).completed());
  const auto refused = [&](auto change) {
    LinearPush push = good;
    change(push);
    const Transition t = apply(model, {}, push);
    return t.status == TransitionStatus::kRefused && !t.reason.empty() && t.done == 0.0 &&
           t.end == Grasp() && t.instants == 0;
  };
  EXPECT_TRUE(refused([](LinearPush& p) { p.contact = 3; }));
  EXPECT_TRUE(refused([](LinearPush& p) { p.contact = -1; }));
  EXPECT_TRUE(refused([](LinearPush& p) { p.e = {1.0, 1.0}; }));
  EXPECT_TRUE(refused([](LinearPush& p) { p.travel = 0.0; }));
  EXPECT_TRUE(refused([](LinearPush& p) { p.travel = -0.01; }));
  EXPECT_TRUE(refused([&](LinearPush& p) { p.turn = nan; }));
  EXPECT_TRUE(refused([](LinearPush& p) { p.contact = 1, p.place = 0.06; }));
  EXPECT_EQ(apply(model, {{0.2, 0.0, 0.0}, 0.0}, good).status,
            TransitionStatus::kRefused);
  EXPECT_EQ(apply(model, {}, good, {.tolerance = 0.0}).status,
            TransitionStatus::kRefused);
  EXPECT_EQ(apply(model, {}, Slide{0, 0.0, {1.0, 0.0}, 0.01, 0.0}).status,
            TransitionStatus::kRefused);
}

// Paper Fig. 5: under gravity a line pusher slides the object straight, because its two
// ends share the load as needed; a point pusher does so only at one height.
TEST(Transition, LinePusherSlidesStraightWhereAPointPusherTurnsTheObject) {
  Scene scene = square_scene();
  scene.gripper.grip_force = 20.0;
  const Model model = prepare(scene);
  const Slide by_wall{0, 0.0, {1.0, 0.0}, 0.01, 1.0};
  const Transition straight = apply(model, {}, by_wall);
  ASSERT_TRUE(straight.completed()) << straight.reason;
  EXPECT_NEAR(straight.end.X_HO.x, 0.01, 1e-15);
  EXPECT_NEAR(straight.end.X_HO.y, 0.0, 1e-15);
  EXPECT_EQ(straight.end.X_HO.theta, 0.0);

  const Slide by_point{1, 0.0, {1.0, 0.0}, 0.01, 1.0};
  const Transition turned = apply(model, {}, by_point);
  ASSERT_TRUE(turned.completed()) << turned.reason;
  EXPECT_GT(std::abs(turned.end.X_HO.theta), 0.02);

  // Moments about the finger axis: 2 mu N z + m g x = 0 with the face at x = -50 mm.
  const double height = -0.5 * kGravity * 0.05 / (2.0 * 0.5 * 20.0);
  const Slide balanced{1, height, {1.0, 0.0}, 0.002, 1.0};
  const Transition almost_straight = apply(model, {}, balanced);
  ASSERT_TRUE(almost_straight.completed()) << almost_straight.reason;
  EXPECT_LT(std::abs(almost_straight.end.X_HO.theta), 1e-6);
}

// Paper Fig. 6, and the closed form of the straight slide: the pusher's force on the
// object is 2 mu N along the push less gravity, at every moment of the push.
TEST(Transition, SlideForceIsLinearInTheGripForce) {
  for (const double grip : {25.0, 50.0, 100.0}) {
    Scene scene = square_scene();
    scene.gripper.grip_force = grip;
    const Model model = prepare(scene);
    std::vector<Sample> trace;
    const Transition t =
        apply(model, {}, Slide{0, 0.0, {1.0, 0.0}, 0.02, 0.01}, {}, &trace);
    ASSERT_TRUE(t.completed()) << t.reason;
    ASSERT_GE(trace.size(), 20u);
    const double friction = 2.0 * 0.5 * grip;
    for (const Sample& sample : trace) {
      EXPECT_NEAR(sample.normal_force, friction, 1e-9 * friction);
      EXPECT_NEAR(sample.tangential_force, 0.5 * kGravity, 1e-9 * friction);
    }
    EXPECT_NEAR(t.max_push_force, std::hypot(friction, 0.5 * kGravity), 1e-9 * friction);
    EXPECT_NEAR(t.min_push_force, t.max_push_force, 1e-9 * friction);
  }
}

/// Friction of a uniform disc of radius 1 that turns about a point at rho <= 1 from its
/// centre: force and moment over (friction x load), in complete elliptic integrals.
double moment_over_force(double rho) {
  const double K = std::comp_ellint_1(rho);
  const double E = std::comp_ellint_2(rho);
  const double r2 = rho * rho;
  const double force = 4.0 / (3.0 * M_PI * rho) * ((1.0 + r2) * E - (1.0 - r2) * K);
  const double moment = 4.0 / (9.0 * M_PI) * ((4.0 - 2.0 * r2) * E - (1.0 - r2) * K);
  return moment / force;
}

double disc_force(double arm) {
  double low = 1e-9;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double rho = 0.5 * (low + high);
    (moment_over_force(rho) > arm ? low : high) = rho;
  }
  const double K = std::comp_ellint_1(low);
  const double E = std::comp_ellint_2(low);
  const double r2 = low * low;
  return 4.0 / (3.0 * M_PI * low) * ((1.0 + r2) * E - (1.0 - r2) * K);
}

// Paper Fig. 8: the force of a pivot falls with the distance of the pusher from the
// finger axis. A frictionless point pushes along the face's normal, so its arm is known
// all the way, and with it the exact force on a uniform disc.
TEST(Transition, PivotForceFallsWithTheLeverArm) {
  Scene scene;
  scene.object.shape = BoxShape{{0.2, 0.02, 0.02}};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{0.01};
  scene.gripper.friction = {0.4, 0.6};
  scene.gripper.grip_force = 30.0;
  scene.g_W.setZero();
  scene.overhang = Overhang::kIgnore;
  scene.pushers.resize(1);
  scene.pushers[0] = {.name = "pin", .feature = PointFeature{}, .friction = 0.0};
  scene.pushers[0].normal_angle = 0.5 * M_PI;
  const Model model = prepare(scene, {.points_per_pad = 64});
  double last_force = model.F;
  for (const double place : {-0.02, -0.03, -0.05, -0.08}) {
    // t of the face -y runs along -x, so these places lie at +x and lift the object
    // there.
    std::vector<Sample> trace;
    const Pivot pivot{0, place, 0.2, 0.02};
    const Transition t = apply(model, {}, pivot, {}, &trace);
    ASSERT_TRUE(t.completed()) << t.reason;
    const LinearPush path = as_linear(pivot);
    for (const Sample& sample : trace) {
      const PushContact& contact = model.contacts[0];
      const Vec2 p_P = contact.segment(place).a;
      const Vec2 p_HC = transform(pusher_pose(path, {}, sample.s), p_P);
      const Vec2 n_H = rotated(sample.grasp.X_HO.theta, contact.n);
      const double arm = cross(p_HC, n_H) / 0.01;
      EXPECT_NEAR(sample.push_force, model.F * disc_force(std::abs(arm)), 0.01 * model.F);
    }
    EXPECT_LT(trace.front().push_force, last_force);
    last_force = trace.front().push_force;
  }
}

// Slip on a vertical wall: the object moves straight, in a direction known in closed
// form.
TEST(Transition, SlipsDownAWallInTheKnownDirection) {
  Scene scene = square_scene();
  scene.object.mass = 1.5;
  scene.pushers[0].friction = 0.2;
  const Model model = prepare(scene);
  const double friction = 40.0;
  const double weight = 1.5 * kGravity;
  const double mu = 0.2;
  ASSERT_GT(weight, mu * friction);
  const double below =
      std::asin(weight / (friction * std::hypot(1.0, mu))) - std::atan(mu);
  const LinearPush push{0, 0.0, {1.0, 0.0}, 0.006, 0.0};
  const Transition t = apply(model, {}, push);
  ASSERT_TRUE(t.completed()) << t.reason;
  EXPECT_NEAR(t.end.X_HO.x, 0.006, 1e-12);
  EXPECT_NEAR(t.end.X_HO.y, -0.006 * std::tan(below), 1e-9);
  EXPECT_EQ(t.end.X_HO.theta, 0.0);
  EXPECT_NEAR(t.slipped, 0.006 * std::tan(below), 1e-9);
  EXPECT_NEAR(t.max_push_force, friction * std::cos(below) * std::hypot(1.0, mu), 1e-6);
}

// The pusher slips along the face until the face ends.
TEST(Transition, StopsWhereThePointRunsOffTheFace) {
  Scene scene = square_scene();
  scene.pushers[1].friction = 0.05;
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LinearPush push{1, 0.03, rotated(1.2, Vec2(1.0, 0.0)), 0.05, 0.0};
  const Transition t = apply(model, {}, push);
  EXPECT_EQ(t.status, TransitionStatus::kPusherLost) << t.reason;
  EXPECT_TRUE(has_event(t, EventKind::kPusherOffFace));
  EXPECT_LT(t.done, 1.0);
  // The pusher's point ends on the corner of the object.
  const Vec2 p_H = transform(pusher_pose(push, {}, t.done), {-0.05, 0.03});
  const Vec2 p_O = transform(inverse(t.end.X_HO), p_H);
  EXPECT_NEAR((p_O - Vec2(-0.05, 0.05)).norm(), 0.0, 1e-6);
}

TEST(Transition, StopsWhereThePadsLeaveTheFace) {
  Scene scene = square_scene();
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LinearPush push{0, 0.0, {1.0, 0.0}, 0.08, 0.0};
  const Transition t = apply(model, {}, push);
  EXPECT_EQ(t.status, TransitionStatus::kPadLost) << t.reason;
  EXPECT_TRUE(has_event(t, EventKind::kPadOffFace));
  EXPECT_NEAR(t.end.X_HO.x, 0.05, 1e-6);
  EXPECT_TRUE(pads_on_object(model, t.end.X_HO));
}

TEST(Transition, StopsWhereGravityIsNoLongerHeld) {
  Scene scene = square_scene();
  scene.gripper.grip_force = 10.0;
  const Model model = prepare(scene);
  // Ellipsoid: the lever of the weight may grow to about c sqrt(1 - (mg/F)^2) F / (mg).
  const Transition t = apply(model, {}, LinearPush{0, 0.0, {1.0, 0.0}, 0.03, 0.0});
  EXPECT_EQ(t.status, TransitionStatus::kFalls) << t.reason;
  EXPECT_TRUE(has_event(t, EventKind::kGravityLost));
  const double share = 0.5 * kGravity / model.F;
  const double lever = model.c * std::sqrt(1.0 - share * share) / share;
  EXPECT_NEAR(t.end.X_HO.x, lever, 0.1 * lever);
  // The last pose is held, one a little farther is not.
  const auto slack = [&](double x) {
    return gravity_slack(grasp_at(model, {x, 0.0, 0.0}, model.contacts[0].g_O));
  };
  EXPECT_GE(slack(t.end.X_HO.x), 0.0);
  EXPECT_LE(slack(t.end.X_HO.x + 2e-6), 0.0);

  scene.gripper.grip_force = 4.0;
  const Transition never =
      apply(prepare(scene), {}, LinearPush{0, 0.0, {1.0, 0.0}, 0.01});
  EXPECT_EQ(never.status, TransitionStatus::kFalls);
  EXPECT_EQ(never.done, 0.0);
}

TEST(Transition, GuardsStopAtTheirLimits) {
  const Model model = prepare(square_scene());
  const Transition slide = apply(model, {}, Slide{1, 0.02, {1.0, 0.0}, 0.03, 0.05});
  EXPECT_EQ(slide.status, TransitionStatus::kLeftGuard) << slide.reason;
  EXPECT_TRUE(has_event(slide, EventKind::kGuard));
  EXPECT_NEAR(std::abs(slide.end.X_HO.theta), 0.05, 1e-4);
  const Transition pivot = apply(model, {}, Pivot{1, 0.02, -0.8, 1e-3});
  EXPECT_EQ(pivot.status, TransitionStatus::kLeftGuard) << pivot.reason;
  EXPECT_NEAR(finger_in_object(pivot.end.X_HO).norm(), 1e-3, 1e-6);
  // The same pushes without a name have no guard.
  EXPECT_TRUE(apply(model, {}, LinearPush{1, 0.02, {1.0, 0.0}, 0.03, 0.0}).completed());
}

TEST(Transition, RecedingPusherLosesTheObjectWhichStays) {
  const Model model = prepare(square_scene());
  const Transition t = apply(model, {}, LinearPush{0, 0.0, {-1.0, 0.0}, 0.01, 0.0});
  EXPECT_EQ(t.status, TransitionStatus::kPusherLost) << t.reason;
  EXPECT_TRUE(has_event(t, EventKind::kContactLost));
  EXPECT_EQ(t.end, Grasp());
}

// A wall that turns faster than the face can follow lifts one end of it; the object then
// hangs on the other end.
TEST(Transition, WallTipsTheObjectAboutItsEdge) {
  Scene scene = square_scene();
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const LinearPush push{0, 0.0, {1.0, 0.0}, 0.0005, 1.0};
  std::vector<Sample> trace;
  const Transition t = apply(model, {}, push, {}, &trace);
  ASSERT_TRUE(t.completed()) << t.reason;
  EXPECT_TRUE(has_event(t, EventKind::kCorner));
  EXPECT_LT(t.end.X_HO.theta, 1.0);
  for (const Sample& sample : trace) {
    // No corner of the object enters the wall.
    const PlanarPose X_PO =
        compose(inverse(pusher_pose(push, {}, sample.s)), sample.grasp.X_HO);
    double least = 1.0;
    for (const Vec2& vertex : model.outline) {
      least = std::min(least, transform(X_PO, vertex).x() + 0.05);
    }
    EXPECT_NEAR(least, 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace prehensile
