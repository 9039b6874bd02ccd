#include "planner/chains/turn_cost.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "planner/steering/chain.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// A few pushes with made-up lengths and kappas, and what they cost together.
struct Case {
  explicit Case(Random& random) {
    chain.count = 1 + random.below(5);
    for (int k = 0; k < chain.count; ++k) {
      Leg& leg = chain.legs[k];
      leg.contact = 0;
      leg.length = random.in(0.002, 0.05);
      leg.kappas.count = 1;
      const double low = random.in(-4.0, 3.0);
      leg.kappas.intervals[0] = {low, low + (random.chance(0.2) ? 0.0 : random.in(0, 4))};
      low_turn += leg.length * leg.kappas.intervals[0].lo;
      high_turn += leg.length * leg.kappas.intervals[0].hi;
      cost += turn_cost(leg.length, leg.kappas.intervals[0]);
    }
  }

  /// T of the shortest way that turns the object by so much, but for rounding.
  double travel(const SearchModel& search, double c_dtheta) {
    c_dtheta = std::clamp(c_dtheta, low_turn + 1e-9, high_turn - 1e-9);
    EXPECT_TRUE(solve_chain(search, c_dtheta / search.model->c, chain));
    double travel = 0.0;
    for (int k = 0; k < chain.count; ++k) {
      travel += chain.legs[k].length * std::hypot(1.0, chain.kappa[k]);
    }
    return travel;
  }

  Chain chain;
  double low_turn = 0.0, high_turn = 0.0;  ///< [m]
  TurnCost cost;
};

constexpr double kFloat = 1e-6;  // [m] rounding of the costs

TEST(TurnCost, PointsAreThoseOfTheShortestWays) {
  const Model model = prepare(published_square(0));
  const SearchModel search = prepare_search(model, Margin::none());
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    Case c(random);
    for (int k = 1; k < TurnCost::kCount; ++k) {
      EXPECT_LE(c.cost.turn[k - 1], c.cost.turn[k]);
    }
    if (c.high_turn - c.low_turn < 1e-6) continue;
    for (int k = 1; k + 1 < TurnCost::kCount; ++k) {
      EXPECT_NEAR(c.cost.travel[k], c.travel(search, c.cost.turn[k]), kFloat);
    }
  }
}

TEST(TurnCost, BoundsTheTravelFromBelow) {
  const Model model = prepare(published_square(0));
  const SearchModel search = prepare_search(model, Margin::none());
  Random random(2);
  double most_off = 0.0;
  for (int i = 0; i < 2000; ++i) {
    Case c(random);
    const double margin = 1e-3 * (c.cost.high() - c.cost.low());
    const double turn = random.in(c.cost.low() + margin, c.cost.high() - margin);
    if (margin == 0.0) continue;
    const double travel = c.travel(search, turn);
    const double least = c.cost.least_travel(turn);
    EXPECT_LE(least, travel + kFloat);
    most_off = std::max(most_off, travel / least - 1.0);
  }
  EXPECT_LT(most_off, 0.1);
}

TEST(TurnCost, KeepsWhatIsWithinLimits) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const TurnCost all = Case(random).cost;
    const float low = static_cast<float>(random.in(-0.1, 0.1));
    const float high = low + static_cast<float>(random.in(0.0, 0.1));
    TurnCost some = all;
    if (!some.confine(low, high)) {
      EXPECT_TRUE(all.high() < low || all.low() > high);
      continue;
    }
    EXPECT_EQ(some.low(), std::max(low, all.low()));
    EXPECT_EQ(some.high(), std::min(high, all.high()));
    for (int k = 0; k < TurnCost::kCount; ++k) {
      EXPECT_GE(some.travel[k], all.least_travel(some.turn[k]) - kFloat);
      if (all.turn[k] >= low && all.turn[k] <= high) {
        EXPECT_EQ(some.turn[k], all.turn[k]);
        EXPECT_EQ(some.travel[k], all.travel[k]);
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
