#include "primitives/transition.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/primitives/push_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::PushCase;
using testing::random_case;
using testing::square_scene;

constexpr double kGravity = 9.81;

bool has_event(const Transition& transition, EventKind kind) {
  for (int i = 0; i < transition.event_count; ++i) {
    if (transition.events[i].kind == kind) return true;
  }
  return false;
}

/// Distance of two poses [m]; angles weigh c.
double distance(const PlanarPose& one, const PlanarPose& other, double c) {
  return Vec3(one.x - other.x, one.y - other.y, c * (one.theta - other.theta)).norm();
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

TEST(Transition, StickingPushIsTheExactRigidMotion) {
  int sticking = 0;
  for (int seed = 0; seed < 400; ++seed) {
    const PushCase c = random_case(seed);
    const Model model = prepare(c.scene);
    const Transition t = apply(model, c.start, c.push);
    if (!t.completed() || model.contacts[0].is_point || t.event_count > 0 ||
        t.slipped > 0.0) {
      continue;
    }
    ++sticking;
    EXPECT_LT(distance(t.end.X_HO, pusher_pose(c.push, c.start.X_HO, 1.0), 0.1), 1e-12);
    EXPECT_EQ(t.error_estimate, 0.0);
  }
  EXPECT_GT(sticking, 40);
}

// A leap over a ride with a constant wrench must not hide what a traced push, which looks
// everywhere, would find.
TEST(Transition, TracedAndUntracedPushesAgree) {
  for (int seed = 0; seed < 400; ++seed) {
    const PushCase c = random_case(seed);
    const Model model = prepare(c.scene);
    std::vector<Sample> trace;
    const Transition traced = apply(model, c.start, c.push, {}, &trace);
    const Transition untraced = apply(model, c.start, c.push);
    EXPECT_EQ(traced.status, untraced.status) << seed;
    EXPECT_EQ(traced.event_count, untraced.event_count) << seed;
    EXPECT_LT(distance(traced.end.X_HO, untraced.end.X_HO, model.c), 2e-6) << seed;
    if (traced.status != TransitionStatus::kRefused && !trace.empty()) {
      EXPECT_EQ(trace.back().grasp, traced.end) << seed;
    }
  }
}

PushCase mirrored(PushCase c) {
  const auto flip = [](Vec2& v) { v.y() = -v.y(); };
  flip(c.scene.g_W);
  c.scene.pushers[0].normal_angle *= -1.0;
  c.push.place *= -1.0;
  flip(c.push.e);
  c.push.turn *= -1.0;
  c.start.X_HO.y *= -1.0;
  c.start.X_HO.theta *= -1.0;
  c.scene.start = c.start;
  return c;
}

TEST(Transition, MirrorImagesMoveAsMirrorImages) {
  for (int seed = 0; seed < 300; ++seed) {
    const PushCase c = random_case(seed);
    const PushCase m = mirrored(c);
    const TransitionOptions options{.tolerance = 1e-7};
    const Transition one = apply(prepare(c.scene), c.start, c.push, options);
    const Transition other = apply(prepare(m.scene), m.start, m.push, options);
    ASSERT_EQ(one.status, other.status) << seed;
    EXPECT_NEAR(one.end.X_HO.x, other.end.X_HO.x, 2e-7) << seed;
    EXPECT_NEAR(one.end.X_HO.y, -other.end.X_HO.y, 2e-7) << seed;
    EXPECT_NEAR(one.end.X_HO.theta, -other.end.X_HO.theta, 2e-5) << seed;
  }
}

// Quasi-static and rate-independent: only ratios of forces matter.
TEST(Transition, ForcesScaleWithGripAndGravity) {
  for (int seed = 0; seed < 200; ++seed) {
    const PushCase c = random_case(seed);
    PushCase scaled = c;
    scaled.scene.gripper.grip_force *= 50.0;
    scaled.scene.g_W *= 50.0;
    const TransitionOptions options{.tolerance = 1e-7};
    const Transition one = apply(prepare(c.scene), c.start, c.push, options);
    const Transition other = apply(prepare(scaled.scene), c.start, c.push, options);
    ASSERT_EQ(one.status, other.status) << seed;
    EXPECT_LT(distance(one.end.X_HO, other.end.X_HO, 0.01), 2e-7) << seed;
    if (one.completed()) {
      EXPECT_NEAR(other.max_push_force, 50.0 * one.max_push_force,
                  1e-3 * other.max_push_force)
          << seed;
    }
  }
}

TEST(Transition, PushInTwoPartsEndsWhereTheWholePushEnds) {
  int compared = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const PushCase c = random_case(seed);
    const Model model = prepare(c.scene);
    const TransitionOptions options{.tolerance = 1e-8};
    const Transition whole = apply(model, c.start, c.push, options);
    // Only a push that ends flush may be cut: the second part starts flush.
    if (!whole.completed() || has_event(whole, EventKind::kCorner) ||
        model.contacts[0].is_point || std::isfinite(model.contacts[0].half_length)) {
      continue;
    }
    LinearPush first = c.push;
    first.travel *= 0.4;
    first.turn *= 0.4;
    const Transition one = apply(model, c.start, first, options);
    LinearPush second = c.push;
    second.travel *= 0.6;
    second.turn *= 0.6;
    const Transition two = apply(model, one.end, second, options);
    ASSERT_TRUE(one.completed() && two.completed()) << seed;
    EXPECT_LT(distance(two.end.X_HO, whole.end.X_HO, model.c), 1e-7) << seed;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(Transition, TighterToleranceConverges) {
  double last = 1e-3;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    double worst = 0.0;
    for (int seed = 0; seed < 60; ++seed) {
      PushCase c = random_case(seed);
      c.scene.overhang = Overhang::kIgnore;
      const Model model = prepare(c.scene);
      const Transition reference =
          apply(model, c.start, c.push, {.tolerance = 1e-11, .max_steps = 20000});
      const Transition t = apply(model, c.start, c.push, {.tolerance = tolerance});
      if (!reference.completed()) continue;
      ASSERT_TRUE(t.completed()) << seed << " " << t.reason;
      worst = std::max(worst, distance(t.end.X_HO, reference.end.X_HO, model.c));
    }
    EXPECT_LT(worst, 2.0 * tolerance);
    EXPECT_LT(worst, 0.2 * last);
    last = worst;
  }
}

// The median, because an event where its margin only grazes zero moves more than the
// tolerance says.
TEST(Transition, EventLocationsConverge) {
  double last = 1e-2;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    std::vector<double> shifts;
    for (int seed = 0; seed < 120; ++seed) {
      PushCase c = random_case(seed);
      c.scene.overhang = Overhang::kIgnore;
      const Model model = prepare(c.scene);
      const Transition reference =
          apply(model, c.start, c.push, {.tolerance = 1e-11, .max_steps = 20000});
      const Transition t = apply(model, c.start, c.push, {.tolerance = tolerance});
      if (t.event_count != reference.event_count) continue;
      for (int i = 0; i < t.event_count; ++i) {
        EXPECT_EQ(t.events[i].kind, reference.events[i].kind) << seed;
        if (reference.events[i].s == 0.0) continue;
        shifts.push_back(std::abs(t.events[i].s - reference.events[i].s));
      }
    }
    ASSERT_GT(shifts.size(), 15u);
    std::sort(shifts.begin(), shifts.end());
    EXPECT_LT(shifts[shifts.size() / 2], 0.05 * last);
    last = shifts[shifts.size() / 2];
  }
}

// An estimate, not a bound: where the centre of rotation passes close to a pad point, or
// an event only grazes, it may be a few times too small.
TEST(Transition, ErrorEstimateCoversTheError) {
  int compared = 0;
  int above = 0;
  for (int seed = 1000; seed < 1400; ++seed) {
    const PushCase c = random_case(seed);
    const Model model = prepare(c.scene);
    const Transition reference =
        apply(model, c.start, c.push, {.tolerance = 1e-11, .max_steps = 20000});
    const Transition t = apply(model, c.start, c.push);
    ASSERT_EQ(t.status, reference.status) << seed;
    const double error = distance(t.end.X_HO, reference.end.X_HO, model.c);
    EXPECT_LT(error, 6.0 * t.error_estimate + 1e-11) << seed << " " << t.reason;
    EXPECT_LT(error, 2e-6) << seed;
    above += error > t.error_estimate + 1e-11 ? 1 : 0;
    ++compared;
  }
  EXPECT_LE(above, compared / 100);
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

// Point pushing is unstable when the pusher trails the centre of friction: no motion may
// be made up there, and forces stay within the friction cone.
TEST(Transition, SamplesObeyTheFrictionCone) {
  for (int seed = 0; seed < 200; ++seed) {
    const PushCase c = random_case(seed);
    const Model model = prepare(c.scene);
    std::vector<Sample> trace;
    const Transition t = apply(model, c.start, c.push, {}, &trace);
    const double mu = c.scene.pushers[0].friction;
    double last_s = -1.0;
    for (const Sample& sample : trace) {
      EXPECT_GE(sample.normal_force, -1e-7 * model.F);
      EXPECT_LE(std::abs(sample.tangential_force),
                mu * sample.normal_force + 1e-6 * model.F);
      EXPECT_LE(sample.tangential_force * sample.slip_rate, 1e-9);
      EXPECT_GE(sample.s, last_s);
      EXPECT_LE(sample.push_force, t.max_push_force);
      EXPECT_GE(sample.push_force, t.min_push_force);
      EXPECT_LE(sample.certificate, t.worst_certificate);
      last_s = sample.s;
    }
  }
}

TEST(Transition, UsesNoHeapWithoutATrace) {
  for (int seed = 0; seed < 60; ++seed) {
    const PushCase c = random_case(seed);
    const Model model = prepare(c.scene);
    const Push push = c.push;
    const testing::NoHeapScope scope;
    const Transition t = apply(model, c.start, push);
    EXPECT_LE(scope.allocations(), 0) << name(t.status);
  }
}

TEST(Transition, RandomPushesAreCertifiedOrStopForAPhysicalReason) {
  std::array<int, 11> counts{};
  for (int seed = 0; seed < 2000; ++seed) {
    const PushCase c = random_case(seed);
    const Transition t = apply(prepare(c.scene), c.start, c.push);
    ++counts[static_cast<int>(t.status)];
    EXPECT_NE(t.status, TransitionStatus::kNotRun) << seed;
    EXPECT_NE(t.status, TransitionStatus::kUncertified) << seed << " " << t.reason;
    EXPECT_NE(t.status, TransitionStatus::kIterationLimit) << seed << " " << t.reason;
    EXPECT_NE(t.status, TransitionStatus::kRefused) << seed << " " << t.reason;
    EXPECT_EQ(t.completed(), t.reason.empty());
    if (t.completed()) {
      EXPECT_EQ(t.done, 1.0);
    }
    if (t.done > 0.0) {
      EXPECT_LE(t.worst_certificate, 1e-6) << seed;
    }
  }
  for (int i = 0; i < 11; ++i) {
    if (counts[i] == 0) continue;
    const auto status = static_cast<TransitionStatus>(i);
    std::printf("%6d %s\n", counts[i], name(status).data());
  }
  EXPECT_GT(counts[static_cast<int>(TransitionStatus::kCompleted)], 1500);
}

}  // namespace
}  // namespace prehensile
