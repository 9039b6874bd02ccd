/// The parts of the margin that turn and shift: tilt of the pusher, place of the finger
/// axis. What the robust tests accept, every member of the box does.
#include <algorithm>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

StickContact random_contact(Random& random) {
  StickContact contact;
  contact.n = random.direction();
  contact.t = perp(contact.n);
  contact.centre = random.in_disc(0.06);
  const double half = random.log_in(0.005, 0.06);
  contact.a = contact.centre - half * contact.t;
  contact.b = contact.centre + half * contact.t;
  contact.mu = random.chance(0.1) ? 0.0 : random.in(0.05, 1.5);
  if (random.chance(0.7)) contact.gamma = random.in_disc(0.6);
  contact.p_OCom = random.in_disc(0.04);
  contact.c = random.log_in(0.002, 0.015);
  return contact;
}

Margin random_margin(Random& random) {
  Margin margin = Margin{}.scaled(random.in(0.0, 2.0));
  margin.grasp = random.in(0.0, 2e-3);
  margin.tilt = random.in(0.0, 0.05);
  return margin;
}

/// One push as a member of the box has it.
struct Member {
  StickContact contact;
  Vec2 p_OF, e;
};

/// Corners of the box in half of the cases, its inside in the other.
Member member_of_box(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                     const Margin& margin, Random& random) {
  const bool corner = random.chance(0.5);
  const auto pick = [&] {
    return corner ? (random.chance(0.5) ? 1.0 : -1.0) : random.in(-1.0, 1.0);
  };
  Member member{contact, p_OF, e};
  StickContact& c = member.contact;
  c.mu *= 1.0 + margin.friction * pick();
  c.gamma = rotated(margin.tilt * pick(), (1.0 + margin.force * pick()) * c.gamma);
  c.c *= 1.0 + margin.torque_radius * pick();
  const Vec2 shift = margin.place * pick() * c.t;
  c.a += shift;
  c.b += shift;
  c.p_OCom += margin.centre_of_mass * pick() * random.direction();
  member.p_OF += margin.grasp * pick() * random.direction();
  member.e = rotated(margin.tilt * pick(), e);
  return member;
}

TEST(StickingMargin, NoMemberSlipsWhereTheRobustTestsHold) {
  Random random(1);
  int optimistic = 0;
  int inside = 0;
  int empty_by_margin = 0;
  double slackest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 20'000; ++i) {
    const StickContact contact = random_contact(random);
    const Margin margin = random_margin(random);
    const Vec2 p_OF = random.in_disc(0.05);
    const Vec2 e = rotated(random.in(-1.0, 1.0), contact.n);
    const KappaSet robust = robust_kappas(contact, p_OF, e, margin);
    if (robust.empty()) {
      empty_by_margin += !sticking_kappas(contact, p_OF, e).empty();
      continue;
    }
    const KappaSet::Interval& interval = robust.intervals[0];
    const double lo = std::clamp(interval.lo, -1e3, 1e3);
    const double hi = std::clamp(interval.hi, -1e3, 1e3);
    const double kappa = random.chance(0.5) ? (random.chance(0.5) ? lo : hi)
                                            : random.in(lo, std::nextafter(hi, 1e9));
    if (!robust.contains(kappa)) continue;  // beyond what is worth looking at
    ++inside;
    const double omega = kappa / contact.c;
    EXPECT_GE(robust_slack(contact, p_OF, e, omega, margin), -1e-9);
    for (int m = 0; m < 40; ++m) {
      const Member member = member_of_box(contact, p_OF, e, margin, random);
      const double slack =
          stick_test(member.contact, 1.0, member.p_OF, member.e, 1.0, omega).slack;
      slackest = std::min(slackest, slack);
      optimistic += slack < -1e-9;
    }
  }
  std::printf("%d pushes, 40 members each, least slack %.1e; %d sets empty by margin\n",
              inside, slackest, empty_by_margin);
  EXPECT_EQ(optimistic, 0);
  EXPECT_GT(inside, 5000);
  EXPECT_GT(empty_by_margin, 100);
}

TEST(StickingMargin, WhatIsBelowAWantedSlackIsToldSooner) {
  Random random(3);
  int below = 0;
  for (int i = 0; i < 5000; ++i) {
    const StickContact contact = random_contact(random);
    const Margin margin = random_margin(random);
    const Vec2 p_OF = random.in_disc(0.05);
    const Vec2 e = random.direction();
    const double omega = random.in(-2.0, 2.0) / contact.c;
    const double least = random.in(-0.5, 0.1);
    const double slack = robust_slack(contact, p_OF, e, omega, margin);
    const double sooner = robust_slack(contact, p_OF, e, omega, margin, least);
    if (slack < least) {
      EXPECT_LT(sooner, least) << i;
      ++below;
    } else {
      EXPECT_EQ(sooner, slack) << i;
    }
  }
  EXPECT_GT(below, 1000);
}

/// The bound is worth having only if it is near what the box can do.
TEST(StickingMargin, TheWorstMemberIsNear) {
  Random random(2);
  int compared = 0;
  double loose = 0.0;
  for (int i = 0; i < 2000; ++i) {
    StickContact contact = random_contact(random);
    contact.gamma.setZero();
    Margin margin = Margin::none();
    margin.grasp = 1e-3;
    margin.tilt = 0.02;
    const Vec2 p_OF = random.in_disc(0.05);
    const Vec2 e = rotated(random.in(-0.5, 0.5), contact.n);
    const double omega = random.in(-2.0, 2.0) / contact.c;
    const double robust = robust_slack(contact, p_OF, e, omega, margin);
    if (!(robust > 0.0)) continue;
    double worst = std::numeric_limits<double>::infinity();
    for (int m = 0; m < 400; ++m) {
      const Member member = member_of_box(contact, p_OF, e, margin, random);
      worst = std::min(
          worst,
          stick_test(member.contact, 1.0, member.p_OF, member.e, 1.0, omega).slack);
    }
    const double nominal = stick_test(contact, 1.0, p_OF, e, 1.0, omega).slack;
    ++compared;
    EXPECT_GE(worst, robust - 1e-12);
    loose = std::max(loose, (worst - robust) / (nominal - robust + 1e-3));
  }
  std::printf("%d compared, the bound takes at most %.0f %% more than the worst member\n",
              compared, 100.0 * loose);
  EXPECT_GT(compared, 100);
  EXPECT_LT(loose, 0.5);
}

TEST(StickingMargin, LeastTurnedIsBelowEveryTurn) {
  Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 a = random.in_disc(2.0);
    const Vec2 b = random.in_disc(2.0);
    const double tilt = random.in(0.0, 0.3);
    const double least = least_turned(a.dot(b), cross(a, b), tilt);
    for (int k = 0; k <= 4; ++k) {
      EXPECT_LE(least, a.dot(rotated(tilt * (0.5 * k - 1.0), b)) + 1e-14);
    }
    EXPECT_EQ(least_turned(a.dot(b), cross(a, b), 0.0), a.dot(b));
  }
}

}  // namespace
}  // namespace prehensile
