#include "planner/pads/ring_pads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/constants.h"
#include "tests/planner/law_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_margin;

/// One circle of this radius.
ContactPoints circle(double radius) {
  ContactPoints points;
  points.count = 4;
  for (int i = 0; i < 4; ++i) {
    points.x[i] = radius * std::cos(0.5 * kPi * i);
    points.y[i] = radius * std::sin(0.5 * kPi * i);
    points.weight[i] = 0.25;
  }
  return points;
}

/// The same by summing over the circle, in steps that the centre of rotation never hits.
RingFriction summed(double radius, double c, double angle) {
  constexpr int kSteps = 200'000;
  RingFriction friction;
  const double speed = std::cos(angle), spin = std::sin(angle) / c;
  for (int i = 0; i < kSteps; ++i) {
    const double at = 2.0 * kPi * (i + 0.5) / kSteps;
    const Vec2 r(radius * std::cos(at), radius * std::sin(at));
    const Vec2 v = Vec2(speed, 0.0) + spin * perp(r);
    const Vec2 f = v.normalized() / kSteps;
    friction.along += f.x();
    friction.moment += cross(r, f);
  }
  return friction;
}

TEST(RingPads, FrictionIsThatOfTheWholeCircle) {
  Random random(1);
  const double c = 0.006;
  for (int i = 0; i < 60; ++i) {
    const double radius = random.in(0.3, 1.5) * c;
    // Centres of rotation far off, at the middle, on the circle, and next to it.
    const double share = i % 4 == 0   ? random.log_in(1e-7, 1e7)
                         : i % 4 == 1 ? 1.0 + random.in(-1e-3, 1e-3)
                         : i % 4 == 2 ? 1.0
                                      : random.in(0.0, 3.0);
    const double angle = std::atan2(1.0, share * radius / c);
    const RingFriction exact = ring_friction(circle(radius), c, angle);
    const RingFriction sum = summed(radius, c, angle);
    EXPECT_NEAR(exact.along, sum.along, 2e-5) << share;
    EXPECT_NEAR(exact.moment, sum.moment, 2e-5 * radius) << share;
    EXPECT_NEAR(exact.drag * std::cos(angle), exact.along, 1e-12) << share;
  }
}

TEST(RingPads, FrictionIsSmoothWhereItsFormulasMeet) {
  const double c = 0.006;
  for (const double share : {1e-6, 1e4}) {
    const auto at = [&](double factor) {
      return ring_friction(circle(c), c, std::atan2(1.0, share * factor));
    };
    EXPECT_NEAR(at(1.0 - 1e-9).along, at(1.0 + 1e-9).along, 1e-9);
    EXPECT_NEAR(at(1.0 - 1e-9).moment / at(1.0 + 1e-9).moment, 1.0, 1e-7);
  }
}

/// A member of a margin's box, and the motion as it does it.
struct Member {
  Model model;
  PushContact contact;
  Vec2 p_OF, e;
  double stretch = 1.0;
};

Member member_of(const Model& model, const PushContact& contact, const Vec2& p_OF,
                 const Vec2& e, const Margin& margin, Random& random) {
  const auto part = [&](double most) {  // corners often
    return random.chance(0.5) ? random.in(-most, most)
                              : (random.chance(0.5) ? most : -most);
  };
  Member member{model, contact, p_OF, e};
  member.contact.mu *= std::max(0.0, 1.0 + part(margin.friction));
  const double shift = part(margin.place);
  member.contact.a += shift * contact.t;
  member.contact.b += shift * contact.t;
  const double weight = random.chance(0.5) ? margin.least_weight() : margin.most_weight();
  member.contact.g_O = weight * rotated(part(margin.tilt), contact.g_O);
  member.model.p_OCom += part(margin.centre_of_mass) * random.direction();
  member.p_OF += part(margin.grasp) * random.direction();
  member.e = rotated(part(margin.tilt), e);
  member.stretch = random.chance(0.3)   ? 1.0
                   : random.chance(0.5) ? 1.0 - margin.torque_radius
                                        : 1.0 + margin.torque_radius;
  return member;
}

double slack_of(const Member& member, double turn) {
  const double c = member.stretch * member.model.c;
  const RingFriction friction = ring_friction(member.model.region.whole(), member.model.c,
                                              std::atan2(c * std::abs(turn), 1.0));
  const double moment = std::copysign(member.stretch * friction.moment, turn);
  return slack_of_friction(member.model, member.contact, member.p_OF,
                           {friction.along * member.e, moment});
}

TEST(RingPads, SlackOverAMarginIsNoMoreThanThatOfItsMembers) {
  Random random(2);
  int sticking = 0, close = 0;
  for (int i = 0; i < 3000; ++i) {
    Scene scene = random.chance(0.5) ? published_square(random.below(50))
                                     : published_tee(random.below(50));
    scene.gripper.grip_force = random.log_in(8.0, 100.0);
    if (random.chance(0.4)) scene.g_W.setZero();
    const Model model = prepare(scene);
    const PushContact& contact =
        model.contacts[random.below(static_cast<int>(model.contacts.size()))];
    const Vec2 p_OF = random.in_box(0.045, 0.045);
    const Vec2 e = rotated(random.in(-1.0, 1.0), contact.n);
    const Margin margin = random_margin(random);
    const double turn = testing::random_kappa(random) / model.c;
    const double slack = ring_slack(model, contact, p_OF, e, 1.0, turn, margin);
    EXPECT_LE(slack, ring_slack(model, contact, p_OF, e, 1.0, turn));
    if (!(slack >= 0.0)) continue;
    ++sticking;
    for (int k = 0; k < 100; ++k) {
      const double of_member =
          slack_of(member_of(model, contact, p_OF, e, margin, random), turn);
      EXPECT_GE(of_member, slack - 1e-4) << i;
      close += of_member < slack + 0.02;
    }
  }
  EXPECT_GT(sticking, 100);
  EXPECT_GT(close, sticking);
}

/// Rounding puts a motion along the edge of the friction cone to either side of it: where
/// the friction may be less, neither sticks.
TEST(RingPads, OnTheNominalEdgeTheMarginDecides) {
  Random random(6);
  Margin margin = Margin::none();
  margin.friction = 0.05;
  int inside = 0, outside = 0;
  for (int i = 0; i < 400; ++i) {
    Scene scene = published_square(0);
    scene.g_W.setZero();
    scene.pushers[0].friction = random.in(0.2, 0.7);
    const Model model = prepare(scene);
    const PushContact& contact = model.contacts[0];
    const double lean = std::atan(contact.mu);
    const Vec2 e = rotated(random.chance(0.5) ? lean : -lean, contact.n);
    const double nominal =
        ring_slack(model, contact, Vec2::Zero(), e, 1e-3, 0.0, Margin::none());
    EXPECT_NEAR(nominal, 0.0, 1e-12);
    (nominal >= 0.0 ? inside : outside) += 1;
    EXPECT_LT(ring_slack(model, contact, Vec2::Zero(), e, 1e-3, 0.0, margin), -1e-3);
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

}  // namespace
}  // namespace prehensile
