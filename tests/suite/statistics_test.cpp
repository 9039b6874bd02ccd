#include "benchmarks/suite/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile::suite {
namespace {

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
