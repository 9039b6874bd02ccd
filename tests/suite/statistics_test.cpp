#include "benchmarks/suite/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile::suite {
namespace {

TEST(Wilson, KnowsTheTextbook) {
  // Newcombe, "Two-sided confidence intervals for the single proportion" (1998), table I.
  const Interval a = wilson(81, 263);
  EXPECT_NEAR(a.low, 0.2553, 5e-5);
  EXPECT_NEAR(a.high, 0.3662, 5e-5);
  const Interval b = wilson(0, 20);
  EXPECT_NEAR(b.low, 0.0, 1e-15);
  EXPECT_NEAR(b.high, 0.1611, 5e-5);
  EXPECT_EQ(wilson(0, 0).low, 0.0);
  EXPECT_EQ(wilson(0, 0).high, 1.0);
}

TEST(Wilson, CoversAsOftenAsItSays) {
  testing::Random random(3);
  int covered = 0;
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    const double p = random.in(0.05, 0.95);
    int hits = 0;
    for (int k = 0; k < 60; ++k) hits += random.in(0.0, 1.0) < p ? 1 : 0;
    const Interval interval = wilson(hits, 60);
    covered += interval.low <= p && p <= interval.high ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(covered) / kTrials, 0.95, 0.015);
}

TEST(SignTest, AgreesWithCounting) {
  for (int n = 0; n <= 12; ++n) {
    for (int wins = 0; wins <= n; ++wins) {
      // Of all 2^n ways to give n pairs to two sides, those at least as lopsided.
      int as_lopsided = 0;
      for (int ways = 0; ways < (1 << n); ++ways) {
        const int other = __builtin_popcount(static_cast<unsigned>(ways));
        if (std::abs(2 * other - n) >= std::abs(2 * wins - n)) ++as_lopsided;
      }
      EXPECT_NEAR(sign_test(wins, n - wins), std::ldexp(as_lopsided, -n), 1e-12);
    }
  }
}

TEST(SignTest, IsSoundForManyPairs) {
  EXPECT_NEAR(sign_test(5000, 5000), 1.0, 1e-9);
  EXPECT_LT(sign_test(5300, 4700), 1e-8);
  EXPECT_GE(sign_test(100000, 0), 0.0);
  EXPECT_NEAR(for_many(1e-6, 100), 1e-4, 1e-8);
  EXPECT_EQ(for_many(1.0, 5), 1.0);
}

TEST(Quantile, IsAValueOfTheSample) {
  const double nan = std::nan("");
  EXPECT_EQ(quantile({3.0, 1.0, nan, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.0), 1.0);
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 1.0), 3.0);
  EXPECT_TRUE(std::isnan(quantile({nan}, 0.5)));
}

}  // namespace
}  // namespace prehensile::suite
