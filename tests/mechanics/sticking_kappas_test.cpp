#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "scene/constants.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// What gravity and centre of mass do in half of the cases, and nothing in the other.
StickContact random_contact(Random& random) {
  StickContact contact;
  contact.n = random.direction();
  contact.t = perp(contact.n);
  contact.centre = random.in_disc(0.06);
  const double half = random.log_in(0.002, 0.06);
  contact.a = contact.centre - half * contact.t;
  contact.b = contact.centre + half * contact.t;
  contact.mu = random.in(0.05, 1.5);
  const int kind = random.below(4);
  if (kind == 1) contact.gamma = random.in_disc(0.3);
  if (kind == 2) contact.gamma = random.in(0.3, 0.99) * random.direction();
  if (kind == 3) contact.gamma = random.in(-0.99, 0.2) * contact.n + random.in_disc(0.05);
  contact.p_OCom = random.in_disc(0.04);
  contact.c = random.log_in(0.002, 0.015);
  return contact;
}

/// Slack of sticking by the forces at the two ends of the face: an independent statement
/// of the mechanics, in which the pusher is two points with non-negative normal forces.
double slack_by_corner_forces(const StickContact& contact, const Vec2& p, const Vec2& e,
                              double omega_over_v) {
  const double c = contact.c;
  const double w = omega_over_v;
  const double scale = 1.0 / std::hypot(1.0, c * w);
  const Vec2 f = scale * e - contact.gamma;
  const double m = scale * c * c * w - cross(contact.p_OCom - p, contact.gamma);
  // Normal forces N_a + N_b = f_n, and with the friction f_t along the face the moment m.
  const double f_n = f.dot(contact.n);
  const double f_t = f.dot(contact.t);
  const Vec2 a = contact.a - p;
  const Vec2 b = contact.b - p;
  const double lever_a = cross(a, contact.n);
  const double lever_b = cross(b, contact.n);
  const double m_normal = m - f_t * cross(a, contact.t);
  const double N_b = (m_normal - f_n * lever_a) / (lever_b - lever_a);
  const double N_a = f_n - N_b;
  const double length = (b - a).norm();
  // One of the two points at least must move into the object where it stands still.
  const auto advance = [&](const Vec2& r) {
    return scale * (e.dot(contact.n) + w * cross(r, contact.n));
  };
  return std::min({contact.mu * (N_a + N_b) - std::abs(f_t), N_a * length / c,
                   N_b * length / c, std::max(advance(a), advance(b))});
}

double random_kappa(Random& random, const KappaSet& set) {
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  if (set.empty() || random.chance(0.4)) return sign * random.log_in(1e-3, 1e3);
  const KappaSet::Interval& interval = set.intervals[random.below(set.count)];
  const double end = random.chance(0.5) ? interval.lo : interval.hi;
  const double kappa = std::isfinite(end) ? end : 0.0;
  return kappa + sign * random.log_in(1e-8, 1.0) * std::max(1.0, std::abs(kappa));
}

TEST(StickingKappas, AgreeWithCornerForcesInEveryBranch) {
  Random random(1);
  int disagreements = 0;
  int in_band = 0;
  int inside = 0;
  std::array<int, 5> intervals{};
  const int cases = 1'000'000;
  for (int i = 0; i < cases; ++i) {
    const StickContact contact = random_contact(random);
    const Vec2 p = random.in_disc(0.05);
    const Vec2 e = random.chance(0.7) ? rotated(random.in(-1.2, 1.2), contact.n)
                                      : random.direction();
    const KappaSet set = sticking_kappas(contact, p, e);
    ++intervals[set.count];
    const double kappa = random_kappa(random, set);
    const double slack = slack_by_corner_forces(contact, p, e, kappa / contact.c);
    const StickTest test = stick_test(contact, 20.0, p, e, 1.0, kappa / contact.c);
    if (std::abs(slack) < 1e-9) {
      ++in_band;
      continue;
    }
    inside += slack > 0.0;
    if (set.contains(kappa) != (slack > 0.0) || (test.slack >= 0.0) != (slack > 0.0)) {
      ++disagreements;
    }
  }
  std::printf(
      "%d cases, %d inside, %d in the band; sets with 0..4 intervals: %d %d %d %d %d\n",
      cases, inside, in_band, intervals[0], intervals[1], intervals[2], intervals[3],
      intervals[4]);
  EXPECT_EQ(disagreements, 0);
  EXPECT_GT(inside, cases / 20);
  EXPECT_GT(intervals[2], 1000);
  EXPECT_LT(in_band, cases / 100);
}

TEST(StickingKappas, AreOneIntervalWithoutGravity) {
  Random random(2);
  for (int i = 0; i < 100'000; ++i) {
    StickContact contact = random_contact(random);
    contact.gamma.setZero();
    EXPECT_LE(sticking_kappas(contact, random.in_disc(0.05), random.direction()).count,
              1);
  }
}

/// What sticks at the whole weight and without any sticks at each share of it, because
/// the rows are affine in the weight.
TEST(StickingKappas, WithoutTheHelpOfGravityAreThoseOfBothEndsOfTheWeight) {
  Random random(12);
  Margin margin = Margin::none();
  margin.weightless = true;
  int inside = 0, helped = 0;
  for (int i = 0; i < 100'000; ++i) {
    StickContact contact = random_contact(random);
    if (contact.is_point || contact.a == contact.b) continue;
    const Vec2 p_OF = random.in_disc(0.05);
    const Vec2 e = random.direction();
    const KappaSet kappas = robust_kappas(contact, p_OF, e, margin);
    const double kappa = random.in(-4.0, 4.0);
    StickContact floating = contact;
    floating.gamma.setZero();
    const auto slack = [&](const StickContact& at) {
      return stick_test(at, 1.0, p_OF, e, 1.0, kappa / contact.c).slack;
    };
    const double least = std::min(slack(contact), slack(floating));
    if (std::abs(least) < 1e-6) continue;
    EXPECT_TRUE(least > 0.0 || !kappas.contains(kappa)) << i;
    const bool is_sure =
        std::abs(cross(contact.p_OCom - contact.a, contact.gamma)) < 2.0 * contact.c &&
        std::abs(cross(contact.p_OCom - contact.b, contact.gamma)) < 2.0 * contact.c;
    EXPECT_TRUE(!is_sure || kappas.contains(kappa) == (least > 0.0)) << i;
    inside += least > 0.0;
    helped += least < 0.0 && slack(contact) > 0.0;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(helped, 100);
}

TEST(StickingKappas, CanHaveFourIntervals) {
  // Heavy object on a short floor, hand moving up and aside: both tilting moments and the
  // friction edge each cut a gap.
  StickContact contact;
  contact.n = {0.0, 1.0};
  contact.t = {-1.0, 0.0};
  contact.c = 1.0;
  contact.a = {1.155, 0.0};
  contact.b = {-1.155, 0.0};
  contact.mu = 1.44;
  contact.gamma = {0.0, -0.953};
  const Vec2 e(std::sqrt(0.75), -0.5);
  const KappaSet set = sticking_kappas(contact, Vec2::Zero(), e);
  ASSERT_EQ(set.count, 4);
  for (int i = -1500; i < 1500; ++i) {
    const double kappa = 0.0137 * i;
    EXPECT_EQ(set.contains(kappa),
              slack_by_corner_forces(contact, Vec2::Zero(), e, kappa) >= 0.0)
        << kappa;
  }
}

TEST(StickingKappas, OfAPointAreTheValuesWithoutMoment) {
  Random random(3);
  int found = 0;
  int pairs = 0;
  for (int i = 0; i < 100'000; ++i) {
    StickContact contact = random_contact(random);
    contact.a = contact.b = contact.centre + random.in(-0.02, 0.02) * contact.t;
    contact.is_point = true;
    const Vec2 p = random.in_disc(0.05);
    const Vec2 e = rotated(random.in(-1.2, 1.2), contact.n);
    const KappaSet set = sticking_kappas(contact, p, e);
    for (int k = 0; k < set.count; ++k) {
      const double kappa = set.intervals[k].lo;
      EXPECT_EQ(kappa, set.intervals[k].hi);
      const StickTest test = stick_test(contact, 30.0, p, e, 1.0, kappa / contact.c);
      EXPECT_GE(test.slack, -1e-9);
      EXPECT_NEAR(test.centre_of_pressure, (contact.a - contact.centre).dot(contact.t),
                  1e-6);
      const StickTest other =
          stick_test(contact, 30.0, p, e, 1.0, (kappa + 0.1) / contact.c);
      EXPECT_LT(other.slack, 0.0);
    }
    found += set.count > 0;
    pairs += set.count == 2;
  }
  std::printf("%d points stick, %d of them with two turns\n", found, pairs);
  EXPECT_GT(found, 10'000);
  EXPECT_GT(pairs, 0);
}

TEST(StickingKappas, FrictionlessPusherPushesOnlyWhereTheForceIsNormal) {
  StickContact contact;
  contact.n = {1.0, 0.0};
  contact.t = {0.0, 1.0};
  contact.a = {-0.05, -0.05};
  contact.b = {-0.05, 0.05};
  contact.c = 0.006;
  EXPECT_TRUE(sticking_kappas(contact, Vec2::Zero(), contact.n).contains(0.0));
  EXPECT_TRUE(sticking_kappas(contact, Vec2::Zero(), -contact.n).empty());
  EXPECT_TRUE(sticking_kappas(contact, Vec2::Zero(), rotated(0.01, contact.n)).empty());
  // Gravity along the face: a horizontal slide falls off, the right slant does not.
  contact.gamma = {0.0, -0.1};
  EXPECT_TRUE(sticking_kappas(contact, Vec2::Zero(), contact.n).empty());
  const Vec2 slant(std::sqrt(0.99), -0.1);
  EXPECT_TRUE(sticking_kappas(contact, Vec2::Zero(), slant).contains(0.0));
}

/// Members of the box: every corner of friction, force, c, place and centre of mass
/// first.
StickContact member_of_box(const StickContact& contact, const Margin& margin, int index,
                           Random& random) {
  const auto pick = [&](int bit) {
    if (index < 32) return (index >> bit) & 1 ? 1.0 : -1.0;
    return random.in(-1.0, 1.0);
  };
  StickContact member = contact;
  member.mu *= 1.0 + margin.friction * pick(0);
  member.gamma *= 1.0 + margin.force * pick(1);
  member.c *= 1.0 + margin.torque_radius * pick(2);
  const Vec2 shift = margin.place * pick(3) * contact.t;
  member.a += shift;
  member.b += shift;
  const Vec2 across =
      contact.gamma.isZero() ? Vec2(0.0, 0.0) : Vec2(perp(contact.gamma).normalized());
  const Vec2 centre = index < 32 ? Vec2(margin.centre_of_mass * pick(4) * across)
                                 : random.in_disc(margin.centre_of_mass);
  member.p_OCom += centre;
  return member;
}

bool ends_decide(const StickContact& contact, const Margin& margin) {
  const double weight = (1.0 + margin.force) * contact.gamma.norm();
  const double lever =
      std::max((contact.p_OCom - contact.a).norm(), (contact.p_OCom - contact.b).norm()) +
      margin.place + margin.centre_of_mass;
  return weight * lever < 2.0 * (1.0 - margin.torque_radius) * contact.c;
}

TEST(RobustKappas, AreTheIntersectionOverTheBox) {
  Random random(4);
  int optimistic = 0;
  int too_small = 0;
  int too_small_heavy = 0;
  int slack_too_small_heavy = 0;
  int compared = 0;
  int inside = 0;
  for (int i = 0; i < 1500; ++i) {
    const StickContact contact = random_contact(random);
    const Margin margin = Margin{}.scaled(random.in(0.2, 4.0));
    const Vec2 p = random.in_disc(0.05);
    const Vec2 e = rotated(random.in(-1.2, 1.2), contact.n);
    const KappaSet robust = robust_kappas(contact, p, e, margin);
    std::array<double, 20> kappas;
    std::array<double, 20> worst;
    worst.fill(kInfinity);
    for (double& kappa : kappas) kappa = random_kappa(random, robust);
    for (int m = 0; m < 1000; ++m) {
      const StickContact member = member_of_box(contact, margin, m, random);
      for (std::size_t k = 0; k < kappas.size(); ++k) {
        const double w = kappas[k] / contact.c;
        worst[k] = std::min(worst[k], slack_by_corner_forces(member, p, e, w));
      }
    }
    for (std::size_t k = 0; k < kappas.size(); ++k) {
      const bool contained = robust.contains(kappas[k]);
      const double slack = robust_slack(contact, p, e, kappas[k] / contact.c, margin);
      ++compared;
      inside += contained;
      if (contained && worst[k] < -1e-9) ++optimistic;
      if (slack > 1e-9 && worst[k] < -1e-9) ++optimistic;
      if (contained && slack < -1e-9) ++optimistic;
      if (!contained && worst[k] > 1e-9) {
        ++(ends_decide(contact, margin) ? too_small : too_small_heavy);
      }
      if (slack < -1e-9 && worst[k] > 1e-9) {
        ++(ends_decide(contact, margin) ? too_small : slack_too_small_heavy);
      }
    }
  }
  std::printf(
      "%d kappas against 1000 members each, %d inside; for heavy objects %d too "
      "small by the set, %d by the slack\n",
      compared, inside, too_small_heavy, slack_too_small_heavy);
  EXPECT_EQ(optimistic, 0);
  EXPECT_EQ(too_small, 0);
  EXPECT_GT(inside, compared / 20);
  EXPECT_LT(too_small_heavy, compared / 100);
}

TEST(RobustKappas, ShrinkWithTheBox) {
  Random random(5);
  for (int i = 0; i < 20'000; ++i) {
    const StickContact contact = random_contact(random);
    const Vec2 p = random.in_disc(0.05);
    const Vec2 e = rotated(random.in(-1.2, 1.2), contact.n);
    const Margin margin = Margin{}.scaled(random.in(0.0, 3.0));
    const KappaSet nominal = sticking_kappas(contact, p, e);
    const KappaSet small = robust_kappas(contact, p, e, margin.scaled(0.5));
    const KappaSet large = robust_kappas(contact, p, e, margin);
    const double kappa = random_kappa(random, large);
    EXPECT_LE(large.contains(kappa), small.contains(kappa));
    EXPECT_LE(small.contains(kappa), nominal.contains(kappa));
  }
}

TEST(RobustKappas, OfARangeForAPointKeepItsEnds) {
  Random random(6);
  int kept = 0;
  for (int i = 0; i < 10'000; ++i) {
    StickContact contact = random_contact(random);
    contact.gamma.setZero();
    contact.is_point = true;
    const Vec2 p = random.in_disc(0.05);
    const Vec2 e = contact.n;  // well inside the cone: the ends alone decide
    const KappaSet nominal = sticking_kappas(contact, p, e);
    const KappaSet robust = robust_kappas(contact, p, e, Margin{});
    if (nominal.empty() || robust.empty()) continue;
    EXPECT_EQ(nominal.intervals[0].lo, robust.intervals[0].lo);
    EXPECT_EQ(nominal.intervals[0].hi, robust.intervals[0].hi);
    ++kept;
  }
  EXPECT_GT(kept, 1000);
}

TEST(StickingKappas, NeedNoHeap) {
  Random random(7);
  const StickContact contact = random_contact(random);
  double sum = 0.0;
  const testing::NoHeapScope scope;
  for (int i = 0; i < 100; ++i) {
    const Vec2 e = rotated(0.01 * i, contact.n);
    sum += sticking_kappas(contact, Vec2::Zero(), e).count;
    sum += robust_kappas(contact, Vec2::Zero(), e, Margin{}).count;
    sum += robust_slack(contact, Vec2::Zero(), e, 10.0, Margin{});
    sum += stick_test(contact, 1.0, Vec2::Zero(), e, 1.0, 10.0).slack;
  }
  const long allocations = scope.allocations();
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_LE(allocations, 0);
}

}  // namespace
}  // namespace prehensile
