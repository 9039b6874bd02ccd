#include "planner/checks/share_interval.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile {
namespace {

TEST(Wilson, KnowsTheTextbook) {
  // Newcombe, "Two-sided confidence intervals for the single proportion" (1998), table I.
  const ShareInterval a = wilson(81, 263);
  EXPECT_NEAR(a.low, 0.2553, 5e-5);
  EXPECT_NEAR(a.high, 0.3662, 5e-5);
  const ShareInterval b = wilson(0, 20);
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
    const ShareInterval interval = wilson(hits, 60);
    covered += interval.low <= p && p <= interval.high ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(covered) / kTrials, 0.95, 0.015);
}

}  // namespace
}  // namespace prehensile
