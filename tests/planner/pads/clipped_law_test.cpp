#include "planner/pads/clipped_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/pad_law.h"
#include "planner/steering/steering.h"
#include "scene/constants.h"
#include "tests/planner/clipped_cases.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::clipped_place;
using testing::clipped_square;
using testing::Random;
using testing::random_kappa;

Scene random_clipped_scene(Random& random) {
  Scene scene = clipped_square();
  scene.gripper.grip_force = random.log_in(8.0, 200.0);
  scene.g_W = random.chance(0.3) ? Vec2(0.0, 0.0) : Vec2(9.81 * random.direction());
  for (auto& pusher : scene.pushers) {
    pusher.friction = random.in(0.0, 1.2);
    if (random.chance(0.3)) pusher.feature = PointFeature{};
  }
  return scene;
}

struct Line {
  PlaceSpan places;
  Vec2 out;

  Vec2 at(double share) const { return places.a + share * (places.b - places.a); }
};

/// As long as the check of barriers looks at, at most.
Line random_line(const Model& model, Random& random) {
  const Vec2 a = clipped_place(model, random);
  const Vec2 along = random.direction();
  const double length = random.log_in(0.005, ClippedLaw::kLongest) * model.c;
  return {{a, a + length * along}, random.chance(0.5) ? perp(along) : Vec2(-perp(along))};
}

/// Whether a contact carries the finger axis across the line, somewhere, at some instant
/// of many.
bool crosses(const Model& model, const PushContact& contact, const Line& line, int tries,
             Random& random) {
  for (int i = 0; i < tries; ++i) {
    const Vec2 p_OF = line.at(random.in(0.0, 1.0));
    if (!contains(model.pad_face, p_OF)) continue;
    const Vec2 e = rotated(random.in(-0.5, 0.5) * kPi, Vec2(-line.out));
    const double omega = random_kappa(random) / model.c;
    if (advance_of(contact, p_OF, e, omega) < 0.0) continue;
    if (spread_slack(model, contact, p_OF, e, omega) >= 0.0) return true;
  }
  return false;
}

void attack(int lines, int tries) {
  Random random(11);
  int denied = 0, crossed = 0;
  for (int i = 0; i < lines; ++i) {
    const Model model = prepare(random_clipped_scene(random));
    const Line line = random_line(model, random);
    const ClippedLaw law(model, line.places, line.out);
    if (!law.is_known()) continue;
    for (std::size_t k = 0; k < model.contacts.size(); ++k) {
      const bool may = law.may_cross(static_cast<int>(k));
      const bool does = crosses(model, model.contacts[k], line, tries, random);
      EXPECT_TRUE(may || !does) << "line " << i << ", contact " << k;
      denied += may ? 0 : 1;
      crossed += does ? 1 : 0;
    }
  }
  EXPECT_GT(denied, lines / 5);
  EXPECT_GT(crossed, lines / 2);
}

TEST(ClippedLaw, WhatItDeniesNoInstantDoes) { attack(60, 200); }

TEST(ClippedLaw, FullWhatItDeniesNoInstantDoes) { attack(3000, 2000); }

TEST(ClippedLaw, IsOfClippedDiscs) {
  Scene scene = clipped_square();
  EXPECT_TRUE(has_clipped_law(prepare(scene)));
  scene.pushers[0].feature = PointFeature{};
  EXPECT_TRUE(has_clipped_law(prepare(scene)));
  scene = clipped_square();
  scene.overhang = Overhang::kIgnore;
  EXPECT_FALSE(has_clipped_law(prepare(scene)));
}

/// The pushed object moves away from the wall, so the finger axis towards it.
TEST(ClippedLaw, OneWallPushesOneWay) {
  Scene scene = clipped_square();
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const PushContact& contact = model.contacts[0];
  const Vec2 face = 0.5 * (contact.a + contact.b);
  const Vec2 at = face + 0.8 * model.c * contact.n;
  const Vec2 half = 0.02 * model.c * contact.t;
  const ClippedLaw towards_wall(model, {at - half, at + half}, -contact.n);
  EXPECT_TRUE(towards_wall.may_cross(0));
  const ClippedLaw away(model, {at - half, at + half}, contact.n);
  EXPECT_FALSE(away.may_cross(0));
}

TEST(ClippedLaw, FallsWhereGravityIsStrongerThanThePads) {
  Scene scene = clipped_square();
  const Model model = prepare(scene);
  const PushContact& contact = model.contacts[0];
  Random random(6);
  const Vec2 p_OF = clipped_place(model, random);
  const PlanarTwist down(contact.g_O.x(), contact.g_O.y(), 0.0);
  const auto falls = [&](double grip) {
    scene.gripper.grip_force = grip;
    const Model held = prepare(scene);
    return ClippedLaw(held, {p_OF, p_OF}, contact.n).falls(held.contacts[0], down, 0.05);
  };
  const double weight = model.mass * contact.g_O.norm();
  const double grip_of_weight = scene.gripper.grip_force * weight / model.F;
  EXPECT_TRUE(falls(0.9 * grip_of_weight));
  EXPECT_FALSE(falls(1.0 * grip_of_weight));
  EXPECT_FALSE(falls(5.0 * grip_of_weight));
}

/// No inequality of any motion leaves more between the ends than at one of them and the
/// widening.
TEST(ClippedLaw, WideningCoversPlacesBetween) {
  Random random(14);
  int lines = 0;
  double most = 0.0;  // of the widening that is used
  while (lines < 400) {
    const Model model = prepare(random_clipped_scene(random));
    const Line line = random_line(model, random);
    const Vec2 between = line.at(random.in(0.0, 1.0));
    const SpreadPads at_a(model, line.places.a), at_b(model, line.places.b),
        at(model, between);
    if (at_a.are_lost() || at_b.are_lost() || at.are_lost()) continue;
    ++lines;
    const double widening = widening_between(at_a, at_b, line.places, model.c);
    const PushContact& contact = model.contacts[lines % model.contacts.size()];
    const StickDemands of_a(model, contact, line.places.a);
    const StickDemands of_b(model, contact, line.places.b);
    const StickDemands demands(model, contact, between);
    for (int k = 0; k < 100; ++k) {
      const Vec2 e = random.direction();
      const Eigen::Vector3d motion(e.x(), e.y(), random_kappa(random));
      const auto left = [&](const StickDemands& of, const SpreadPads& pads, int i) {
        return of[i].eta.dot(friction_in(pads, motion, model.c)) + of[i].constant;
      };
      for (int i = 0; i < demands.count(); ++i) {
        const double at_ends = std::max(left(of_a, at_a, i), left(of_b, at_b, i));
        const double beyond = left(demands, at, i) - at_ends;
        EXPECT_LE(beyond, widening + 1e-6) << "line " << lines << ", inequality " << i;
        if (widening > 1e-4) most = std::max(most, beyond / widening);
      }
    }
  }
  EXPECT_GT(most, 0.1);
}

/// At no angle of the object do the points that stand for the discs resist a fall by more
/// than what a barrier wants it to leave (1 %) over the points spread over all angles.
TEST(ClippedLaw, FallsMeetTheSameFrictionAtEveryAngle) {
  Random random(15);
  int falls = 0;
  while (falls < 200) {
    Scene scene = random_clipped_scene(random);
    scene.g_W = 9.81 * random.direction();
    scene.gripper.grip_force = random.log_in(0.1, 5.0);
    const Model model = prepare(scene);
    const Vec2 p_OF = clipped_place(model, random);
    const Vec2& g_O = model.contacts[0].g_O;
    PlanarTwist fall = PlanarTwist::Zero();
    const auto grasp = [&](double theta) {
      return grasp_at(model, pose_from_finger(p_OF, theta), g_O);
    };
    if (gravity_slack_by_pad_law(model, grasp(0.0), &fall) >= 0.0) continue;
    ++falls;
    const double spread =
        model.F * SpreadPads(model, p_OF).power(fall.head<2>(), fall[2]);
    for (int k = 0; k < 24; ++k) {
      const double theta = 2.0 * kPi * k / 24;
      PlanarTwist turned = fall;
      turned.head<2>() = rotated(theta, Vec2(fall.head<2>()));
      EXPECT_LT(friction_power(model, grasp(theta), turned), 1.01 * spread);
    }
  }
}

/// The inequalities are those of the slack, whose sign they share.
TEST(StickDemands, HaveTheSignOfTheSlack) {
  Random random(12);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Model model = prepare(random_clipped_scene(random));
    const PushContact& contact = model.contacts[i % model.contacts.size()];
    const Vec2 p_OF = clipped_place(model, random);
    const Vec2 e = rotated(random.in(-0.6, 0.6), contact.n);
    const double omega = random_kappa(random) / model.c;
    const PadDrag drag = SpreadPads(model, p_OF).drag(e, omega);
    const double slack =
        StickDemands(model, contact, p_OF)
            .slack({drag.force.x(), drag.force.y(), drag.moment / model.c});
    const double other = spread_slack(model, contact, p_OF, e, omega);
    if (std::abs(other) < 1e-9) continue;
    EXPECT_EQ(slack > 0.0, other > 0.0) << slack << " " << other;
    met += slack > 0.0 ? 1 : 0;
  }
  EXPECT_GT(met, 50);
}

}  // namespace
}  // namespace prehensile
