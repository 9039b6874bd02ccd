/// Stick tests against the instants that know of slip: the contact sticks exactly where
/// the solver, free to let it slip or open, finds the object moving with the pusher.
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"
#include "mechanics/sticking.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

Scene random_scene(Random& random) {
  Scene scene;
  scene.object.shape = BoxShape{{random.in(0.06, 0.15), random.in(0.06, 0.15), 0.03}};
  scene.object.mass = random.log_in(0.02, 0.6);
  scene.object.p_OCom = random.in_box(0.01, 0.01);
  scene.gripper.pad =
      random.chance(0.5)
          ? Pad(DiscPad{random.in(0.004, 0.012)})
          : Pad(RectanglePad{{random.in(0.005, 0.02), random.in(0.005, 0.02)}});
  scene.gripper.friction = {random.in(0.3, 1.0), random.in(0.3, 1.0)};
  scene.gripper.grip_force = random.log_in(10.0, 60.0);
  scene.g_W = 9.81 * random.direction();
  Pusher pusher;
  pusher.name = "edge";
  pusher.feature = LineFeature{random.in(0.02, 0.08)};
  pusher.friction = random.in(0.2, 1.0);
  pusher.faces = {"-x", "+y"};
  scene.pushers.push_back(pusher);
  return scene;
}

struct Case {
  Model model;
  PushContact contact;
  double place;
  PlanarPose X_HO;
  Vec2 p_OF, e;
  double omega;
  PlanarDrive drive;
};

/// Pushes near the border between sticking and slipping, where the grasp holds gravity.
Case random_case(Random& random) {
  while (true) {
    const Model model = prepare(random_scene(random));
    const PushContact contact = model.contacts[random.below(2)];
    const double place = random.in(-0.01, 0.01);
    const Vec2 p_OF = random.in_box(0.025, 0.025);
    const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-3.0, 3.0));
    const Vec2 e = rotated(random.in(-1.0, 1.0), contact.n);
    if (holding_slack(model, p_OF, contact.g_O, Margin::none()) < 0.1) continue;
    const KappaSet set = sticking_kappas(stick_contact(model, contact, place), p_OF, e);
    double kappa = random.in(-3.0, 3.0);
    if (!set.empty() && random.chance(0.8)) {
      const KappaSet::Interval& interval = set.intervals[0];
      const double end = random.chance(0.5) ? interval.lo : interval.hi;
      if (std::isfinite(end)) kappa = end + random.in(-0.3, 0.3);
    }
    const double omega = kappa / model.c;
    const Vec2 v_H = rotated(X_HO.theta, e);
    const PlanarTwist V_HP(v_H.x(), v_H.y(), omega);
    return {model, contact, place, X_HO,
            p_OF,  e,       omega, drive_at(contact, place, X_HO, V_HP)};
  }
}

bool sticks(const PlanarInstant& answer) {
  return answer.status == InstantStatus::kMoves &&
         answer.pusher[0].mode == ContactMode::kStick &&
         answer.pusher[1].mode == ContactMode::kStick;
}

struct Count {
  int compared = 0;
  int stuck = 0;
  int disagree = 0;
  double force_error = 0.0;

  void add(const StickTest& test, const PlanarInstant& answer, double F) {
    if (!usable(answer.status) || std::abs(test.slack) < 1e-6) return;
    ++compared;
    const bool stick = sticks(answer);
    stuck += stick;
    disagree += stick != (test.slack > 0.0);
    if (stick) {
      force_error =
          std::max(force_error, std::abs(test.push_force - answer.push_force) / F);
    }
  }
};

TEST(StickingInstants, EllipsoidSolverSticksExactlyWhereTheTestSays) {
  Random random(1);
  Count count;
  const int cases = 20'000;
  for (int i = 0; i < cases; ++i) {
    const Case c = random_case(random);
    const StickTest test = stick_test(stick_contact(c.model, c.contact, c.place),
                                      c.model.F, c.p_OF, c.e, 1.0, c.omega);
    const PlanarGrasp grasp = grasp_at(c.model, c.X_HO, c.contact.g_O);
    count.add(test, solve_limit_surface(c.model.surface(), grasp.w_g, c.drive),
              c.model.F);
  }
  std::printf("%d instants over the ellipsoid compared, %d stick, force within %.1e F\n",
              count.compared, count.stuck, count.force_error);
  EXPECT_EQ(count.disagree, 0);
  EXPECT_LT(count.force_error, 1e-9);
  EXPECT_GT(count.compared, cases * 9 / 10);
  EXPECT_GT(count.stuck, cases / 10);
}

TEST(StickingInstants, PlanarSolverSticksExactlyWhereTheTestSays) {
  Random random(2);
  Count count;
  const int cases = 5000;
  for (int i = 0; i < cases; ++i) {
    const Case c = random_case(random);
    const StickTest test = exact_stick_test(c.model, c.contact, c.place, c.X_HO, c.e, 1.0,
                                            c.omega, Margin::none());
    const PlanarGrasp grasp = grasp_at(c.model, c.X_HO, c.contact.g_O);
    count.add(test, solve_planar(grasp, c.drive), c.model.F);
  }
  std::printf("%d instants with real pads compared, %d stick, force within %.1e F\n",
              count.compared, count.stuck, count.force_error);
  EXPECT_EQ(count.disagree, 0);
  EXPECT_LT(count.force_error, 1e-7);
  EXPECT_GT(count.compared, cases * 9 / 10);
  EXPECT_GT(count.stuck, cases / 10);
}

/// A test that may end early says no less of whether the slack is below what was named.
TEST(StickingInstants, EndingEarlyDecidesAlike) {
  Random random(3);
  int above = 0;
  int below = 0;
  for (int i = 0; i < 3000; ++i) {
    const Case c = random_case(random);
    const Margin margin = Margin{}.scaled(random.in(0.0, 2.0));
    const double travelled = random.in(0.0, 0.05);
    const auto slack = [&](double least) {
      return exact_stick_test(c.model, c.contact, c.place, c.X_HO, c.e, 1.0, c.omega,
                              margin, travelled, least)
          .slack;
    };
    const double whole = slack(-std::numeric_limits<double>::infinity());
    for (const double least : {-0.2, 0.0, 0.1}) {
      const double known = slack(least);
      ASSERT_EQ(known < least, whole < least) << i;
      if (!(whole < least)) {
        EXPECT_EQ(known, whole) << i;
      }
      (whole < least ? below : above) += 1;
    }
  }
  EXPECT_GT(above, 500);
  EXPECT_GT(below, 500);
}

}  // namespace
}  // namespace prehensile
