#include "planner/steering/chain.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/pads/ring_pads.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::Random;

/// A chain with made-up lengths and intervals.
Chain random_chain(Random& random, int legs, int intervals) {
  Chain chain;
  chain.count = legs;
  for (int k = 0; k < legs; ++k) {
    Leg& leg = chain.legs[k];
    leg.contact = random.below(2);
    leg.length = random.in(0.005, 0.05);
    leg.kappas.count = 1 + random.below(intervals);
    double at = random.in(-3.0, 0.0);
    for (int i = 0; i < leg.kappas.count; ++i) {
      const double hi = at + random.in(0.0, 2.0);
      leg.kappas.intervals[i] = {at, hi};
      at = hi + random.in(0.1, 1.0);
    }
  }
  return chain;
}

double travel_of(const Chain& chain) {
  double travel = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    travel += chain.legs[k].length * std::hypot(1.0, chain.kappa[k]);
  }
  return travel;
}

/// Least travel of a two-leg chain by scanning the first kappa; infinity if none fits.
double scanned_travel(const Chain& chain, double c_dtheta) {
  const Leg& first = chain.legs[0];
  const Leg& second = chain.legs[1];
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < first.kappas.count; ++i) {
    const auto [lo, hi] = first.kappas.intervals[i];
    for (int step = 0; step <= 4000; ++step) {
      const double kappa = lo + (hi - lo) * step / 4000.0;
      const double rest = (c_dtheta - first.length * kappa) / second.length;
      if (!second.kappas.contains(rest)) continue;
      best = std::min(best, first.length * std::hypot(1.0, kappa) +
                                second.length * std::hypot(1.0, rest));
    }
  }
  return best;
}

class ChainTest : public ::testing::Test {
 protected:
  Model model_ = prepare(published_square(0));
  SearchModel search_ = testing::search_over_ellipsoid(model_, Margin{});
};

TEST_F(ChainTest, FindsTheShortestOfAllRotations) {
  Random random(1);
  int solved = 0;
  for (int i = 0; i < 3000; ++i) {
    Chain chain = random_chain(random, 2, 3);
    const double c_dtheta = random.in(-0.1, 0.1);
    const double scanned = scanned_travel(chain, c_dtheta);
    if (!solve_chain(search_, c_dtheta / model_.c, chain)) {
      EXPECT_TRUE(std::isinf(scanned)) << i;
      continue;
    }
    ++solved;
    EXPECT_LE(travel_of(chain), scanned + 1e-12) << i;
    double sum = 0.0;
    for (int k = 0; k < 2; ++k) {
      sum += chain.legs[k].length * chain.kappa[k];
      EXPECT_TRUE(chain.legs[k].kappas.contains(chain.kappa[k]));
    }
    EXPECT_NEAR(sum, c_dtheta, 1e-12);
    EXPECT_NEAR(chain.cost, placements(search_, chain) + travel_of(chain) / model_.L,
                1e-12);
  }
  EXPECT_GT(solved, 1000);
}

TEST_F(ChainTest, NoSmallExchangeOfRotationShortensALongChain) {
  Random random(2);
  int solved = 0;
  for (int i = 0; i < 1000; ++i) {
    Chain chain = random_chain(random, 3 + random.below(6), 1);
    if (!solve_chain(search_, random.in(-0.2, 0.2) / model_.c, chain)) continue;
    ++solved;
    const double least = travel_of(chain);
    for (int k = 0; k < 20; ++k) {
      Chain other = chain;
      const int from = random.below(chain.count);
      const int to = random.below(chain.count);
      const double part = random.in(0.0, 1e-4);
      other.kappa[from] -= part / chain.legs[from].length;
      other.kappa[to] += part / chain.legs[to].length;
      const bool allowed = chain.legs[from].kappas.contains(other.kappa[from]) &&
                           chain.legs[to].kappas.contains(other.kappa[to]);
      if (!allowed) continue;
      EXPECT_GE(travel_of(other), least - 1e-13);
    }
  }
  EXPECT_GT(solved, 200);
}

TEST_F(ChainTest, CentringKeepsTheSumAndTheIntervals) {
  Random random(3);
  int solved = 0;
  for (int i = 0; i < 1000; ++i) {
    Chain chain = random_chain(random, 2 + random.below(4), 2);
    const double dtheta = random.in(-0.1, 0.1) / model_.c;
    if (!solve_chain(search_, dtheta, chain)) continue;
    ++solved;
    const double shortest = chain.cost;
    centre_chain(search_, dtheta, random.in(0.0, 1.0), chain);
    EXPECT_GE(chain.cost, shortest - 1e-12);
    double turn = 0.0;
    for (int k = 0; k < chain.count; ++k) {
      turn += turn_of(search_, chain, k);
      const double kappa = chain.kappa[k];
      const bool inside = chain.legs[k].kappas.contains(kappa - 1e-12) ||
                          chain.legs[k].kappas.contains(kappa + 1e-12);
      EXPECT_TRUE(inside);
    }
    EXPECT_NEAR(turn, dtheta, 1e-9);
  }
  EXPECT_GT(solved, 300);
}

TEST_F(ChainTest, LegsAgreeWithTheSteeringOfTheirMoves) {
  Random random(4);
  Work work{.budget = kNoBudget};
  int legs = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 from = random.in_box(0.045, 0.045);
    const Vec2 to = from + random.in_disc(0.03);
    const int contact = random.below(static_cast<int>(search_.contacts.size()));
    Leg leg;
    if (!make_leg({search_}, contact, {from}, {to}, work, leg)) continue;
    ++legs;
    const auto [lo, hi] = leg.kappas.intervals[0];
    const double middle = 0.5 * (lo + hi);
    const double turn = middle * leg.length / model_.c;
    EXPECT_TRUE(move_sticks(search_, contact, {from, 0.3}, {to, 0.3 + turn}, work)) << i;
  }
  EXPECT_GT(legs, 1000);
}

TEST_F(ChainTest, LegsOverDiscsTurnAsRingsLetThem) {
  const SearchModel search = prepare_search(model_, Margin{});
  ASSERT_TRUE(search.rings);
  Random random(5);
  Work work{.budget = kNoBudget};
  int legs = 0, wider = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 from = random.in_box(0.045, 0.045);
    const Vec2 way = random.in_disc(0.03);
    const int contact = random.below(static_cast<int>(search.contacts.size()));
    Leg leg, other;
    if (!make_leg({search}, contact, {from}, {from + way}, work, leg)) continue;
    ++legs;
    const PushContact& pushed = model_.contacts[search.contacts[contact].contact];
    const auto [lo, hi] = leg.kappas.intervals[0];
    for (const double kappa : {lo, 0.5 * (lo + hi), hi}) {
      const double turn = kappa * leg.length / model_.c;
      EXPECT_GE(ring_slack(model_, pushed, from, -way.normalized(), leg.length, turn,
                           search.margin_from(from)),
                -1e-6)
          << i;
    }
    wider += make_leg({search_}, contact, {from}, {from + way}, work, other) &&
             hi - lo > other.kappas.intervals[0].hi - other.kappas.intervals[0].lo + 0.1;
  }
  EXPECT_GT(legs, 1000);
  EXPECT_GT(wider, legs / 20);
}

/// Steeper pushes stick as well, and would turn the object by more than anybody wants.
TEST_F(ChainTest, LegsDoNotWindTheHandUp) {
  constexpr double kMostTurn = 100.0;  // [rad]
  Random random(7);
  Work work{.budget = kNoBudget};
  int legs = 0;
  int cut = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 from = random.in_box(0.045, 0.045);
    const Vec2 way = random.log_in(1e-4, 1.0) * random.in_disc(0.03);
    const int contact = random.below(static_cast<int>(search_.contacts.size()));
    Leg leg;
    if (!make_leg({search_}, contact, {from}, {from + way}, work, leg)) continue;
    ++legs;
    const KappaSet all = robust_kappas(search_.contacts[contact].stick, from,
                                       -way.normalized(), search_.margin_from(from));
    const double most = std::min(1e4, kMostTurn * model_.c / way.norm());
    for (int k = 0; k < leg.kappas.count; ++k) {
      const auto [lo, hi] = leg.kappas.intervals[k];
      EXPECT_LE(std::max(-lo, hi), most * (1.0 + 1e-12));
      EXPECT_TRUE(all.contains(0.5 * (lo + hi)) || hi - lo < 1e-9);
    }
    for (int k = 0; k < all.count; ++k) {
      const double kappa = random.in(all.intervals[k].lo, all.intervals[k].hi);
      EXPECT_EQ(leg.kappas.contains(kappa), std::abs(kappa) <= most);
      cut += std::abs(kappa) > most;
    }
  }
  EXPECT_GT(legs, 1000);
  EXPECT_GT(cut, 0);
}

/// A line goes on from where it stands, a point stands elsewhere for each push.
TEST_F(ChainTest, PointsArePlacedAnewForEachPush) {
  Random random(6);
  Chain chain = random_chain(random, 3, 1);
  chain.legs[0].contact = chain.legs[1].contact = 0;
  chain.legs[2].contact = 1;
  EXPECT_EQ(placements(search_, chain), 2);
  search_.contacts[0].stick.is_point = true;
  EXPECT_EQ(placements(search_, chain), 3);
  search_.points_stay = true;
  EXPECT_EQ(placements(search_, chain), 2);
}

}  // namespace
}  // namespace prehensile
