#include "primitives/spread_interval.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/random_stream.h"

namespace prehensile {
namespace {

TEST(SpreadInterval, TheNeededFactorIsTheLeastThatHoldsTheValue) {
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const double middle = random.in(-1.0, 1.0);
    const SpreadQuantiles spread{middle - random.in(0.0, 1.0), middle,
                                 middle + random.in(0.0, 1.0)};
    const double floor = random.in(1e-3, 0.5);
    const double value = random.in(-3.0, 3.0);
    const double needed = factor_needed(spread, floor, value);
    const SpreadInterval more = stated_interval(spread, floor, 1.0001 * needed + 1e-12);
    const SpreadInterval less = stated_interval(spread, floor, 0.9999 * needed - 1e-12);
    EXPECT_TRUE(more.low <= value && value <= more.high) << i;
    EXPECT_FALSE(less.low <= value && value <= less.high) << i;
  }
}

TEST(SpreadInterval, WithoutWidthNoFactorHelps) {
  EXPECT_TRUE(std::isinf(factor_needed({0.0, 0.0, 0.0}, 0.0, 0.1)));
  EXPECT_EQ(factor_needed({0.0, 0.0, 0.0}, 0.0, 0.0), 0.0);
}

TEST(SpreadInterval, ConformalFactorsCoverNewDraws) {
  RandomStream random(2);
  const int trials = 2000;
  for (const double level : {0.5, 0.9}) {
    for (const int count : {9, 20, 99}) {
      int covered = 0;
      for (int trial = 0; trial < trials; ++trial) {
        const auto draw = [&] { return std::exp(random.in(-3.0, 3.0)); };  // heavy tail
        std::vector<double> needed;
        needed.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) needed.push_back(draw());
        covered += draw() <= conformal_factor(needed, level);
      }
      const double slack = 3.5 * std::sqrt(level * (1.0 - level) / trials);
      EXPECT_GT(covered, (level - slack) * trials) << level << ' ' << count;
      EXPECT_LT(covered, (level + 1.0 / (count + 1) + slack) * trials)
          << level << ' ' << count;
    }
  }
}

TEST(SpreadInterval, TooFewPushesHaveNoFactor) {
  EXPECT_TRUE(std::isinf(conformal_factor({1.0, 2.0, 3.0}, 0.9)));
  EXPECT_TRUE(std::isinf(conformal_factor({}, 0.5)));
  EXPECT_EQ(conformal_factor({1.0, 2.0, 3.0}, 0.75), 3.0);
}

// Objects differ more than the pushes of one object: pooled pushes then cover a new
// object less often than they say; groups come closer.
TEST(SpreadInterval, FactorsOfGroupsCoverNewGroups) {
  RandomStream random(3);
  constexpr double kLevel = 0.8;
  constexpr int kTrials = 400;
  constexpr int kPushes = 60;
  double by_groups = 0.0;
  double by_pool = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto object = [&] {
      const double scale = std::exp(random.in(-0.6, 0.6));
      std::vector<double> needed(kPushes);
      for (double& value : needed) value = scale * random.in(0.0, 1.0);
      return needed;
    };
    std::vector<std::vector<double>> groups;
    std::vector<double> pool;
    for (int g = 0; g < 5; ++g) {
      groups.push_back(object());
      pool.insert(pool.end(), groups.back().begin(), groups.back().end());
    }
    const std::vector<double> other = object();
    const auto share = [&](double factor) {
      return static_cast<double>(std::count_if(other.begin(), other.end(),
                                               [&](double v) { return v <= factor; })) /
             kPushes;
    };
    by_groups += share(conformal_factor_of_groups(groups, kLevel)) / kTrials;
    by_pool += share(conformal_factor(pool, kLevel)) / kTrials;
    EXPECT_GE(conformal_factor_of_groups(groups, kLevel), conformal_factor(pool, kLevel));
  }
  EXPECT_LT(by_pool, kLevel - 0.01);
  EXPECT_NEAR(by_groups, kLevel, 0.02);
}

TEST(SpreadInterval, OneGroupIsPooled) {
  const std::vector<double> needed{1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(conformal_factor_of_groups({needed}, 0.5), conformal_factor(needed, 0.5));
  EXPECT_EQ(conformal_factor_of_groups({needed, {}}, 0.5), conformal_factor(needed, 0.5));
  EXPECT_TRUE(std::isinf(conformal_factor_of_groups({}, 0.5)));
}

}  // namespace
}  // namespace prehensile
