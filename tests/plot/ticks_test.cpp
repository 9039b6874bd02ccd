#include "plot/ticks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "problems/random_stream.h"

namespace prehensile::plot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Range range_of(double low, double high, Scale scale = Scale::kLinear) {
  RangeBuilder builder(scale);
  builder.add(low);
  builder.add(high);
  return builder.range({}, 0.0);
}

TEST(Ticks, AreRoundNumbers) {
  const Ticks ticks = ticks_of(range_of(0.0, 10.0), 5);
  ASSERT_EQ(ticks.ticks.size(), 6U);
  EXPECT_EQ(ticks.ticks[1].label, "2");
  EXPECT_EQ(ticks_of(range_of(0.0, 1.0), 5).ticks[1].label, "0.2");
  EXPECT_EQ(ticks_of(range_of(-1.0, 1.0), 4).ticks[2].label, "0.0");
}

TEST(Ticks, LargeAndSmallNumbersShareAPowerOfTen) {
  const Ticks small = ticks_of(range_of(0.0, 4e-6), 4);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(small.ticks.back().label, "4");
  const Ticks large = ticks_of(range_of(0.0, 3e7), 3);
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(large.ticks.back().label, "30");
  EXPECT_EQ(power_of_ten(-12), "10⁻¹²");
}

TEST(Ticks, DecadesOnALogarithmicAxis) {
  const Ticks ticks = ticks_of(range_of(1e-6, 1e6, Scale::kLog), 6);
  std::set<std::string> labels;
  for (const Tick& tick : ticks.ticks) labels.insert(tick.label);
  EXPECT_TRUE(labels.contains("10⁻⁶"));
  EXPECT_TRUE(labels.contains("10⁶"));
  const Ticks two = ticks_of(range_of(1.0, 10.0, Scale::kLog), 6);
  labels.clear();
  for (const Tick& tick : two.ticks) labels.insert(tick.label);
  for (const char* label : {"1", "2", "5", "10"}) EXPECT_TRUE(labels.contains(label));
}

TEST(Ticks, AxesOfAnyRangeHaveEnoughOfThem) {
  RandomStream random(6);
  for (int i = 0; i < 20000; ++i) {
    const bool log = random.chance(0.4);
    const double low = log ? random.log_in(1e-3, 1e3) : random.in(-100.0, 100.0);
    const double high =
        log ? low * random.log_in(1.3, 1e12) : low + random.log_in(1e-3, 1e3);
    const int wanted = random.chance(0.5) ? 4 : 7;
    const Ticks ticks =
        ticks_of(range_of(low, high, log ? Scale::kLog : Scale::kLinear), wanted);
    const auto labelled =
        std::count_if(ticks.ticks.begin(), ticks.ticks.end(),
                      [](const Tick& tick) { return !tick.label.empty(); });
    ASSERT_GE(labelled, log ? 2 : 4) << low << ' ' << high;
    ASSERT_LE(labelled, 10) << low << ' ' << high;
  }
}

TEST(Ticks, RandomRangesOfAllSizesHaveDistinctTicksInside) {
  RandomStream random(5);
  for (int i = 0; i < 20000; ++i) {
    const bool log = random.chance(0.4);
    const double size = random.log_in(1e-250, 1e250);
    const double low = log ? size : random.in(-1.0, 1.0) * size;
    const double high =
        log ? size * random.log_in(1.01, 1e30) : low + random.log_in(1e-6, 1.0) * size;
    const Range range = range_of(low, high, log ? Scale::kLog : Scale::kLinear);
    ASSERT_LT(range.low, range.high);
    const Ticks ticks = ticks_of(range, 6);
    std::set<std::string> labels;
    int labelled = 0;
    for (const Tick& tick : ticks.ticks) {
      ASSERT_TRUE(std::isfinite(tick.value));
      ASSERT_GE(range.share(tick.value), -1e-6) << low << ' ' << high;
      ASSERT_LE(range.share(tick.value), 1.0 + 1e-6) << low << ' ' << high;
      if (tick.label.empty()) continue;
      ++labelled;
      labels.insert(tick.label);
    }
    ASSERT_EQ(static_cast<int>(labels.size()), labelled) << low << ' ' << high;
    ASSERT_GE(labelled, 1) << low << ' ' << high << ' ' << log;
    ASSERT_LE(labelled, 30) << low << ' ' << high << ' ' << log;
  }
}

TEST(Ranges, DegenerateDataStillHaveARange) {
  for (const double value : {0.0, 1.0, -3.0, 1e300, -1e300, 1e-300, 5e-324}) {
    const Range range = range_of(value, value);
    EXPECT_LT(range.low, range.high) << value;
    EXPECT_GE(range.share(value), 0.0) << value;
    EXPECT_LE(range.share(value), 1.0) << value;
  }
  const Range wide = range_of(-1e300, 1e300);
  EXPECT_NEAR(wide.share(0.0), 0.5, 1e-12);
  const Range log = range_of(1e-300, 1e300, Scale::kLog);
  EXPECT_NEAR(log.share(1.0), 0.5, 1e-12);
  EXPECT_NEAR(log.value(0.5), 1.0, 1e-9);
}

TEST(Ranges, WhatCannotBeDrawnDoesNotCount) {
  RangeBuilder linear(Scale::kLinear);
  for (const double v : {kInfinity, -kInfinity, std::nan(""), 1e301}) linear.add(v);
  EXPECT_TRUE(linear.empty());
  RangeBuilder log(Scale::kLog);
  log.add(0.0);
  log.add(-2.0);
  EXPECT_TRUE(log.empty());
  EXPECT_LT(log.range({}, 0.05).low, log.range({}, 0.05).high);
}

TEST(Ranges, FixedEndsHoldAndBadOnesAreIgnored) {
  RangeBuilder builder(Scale::kLinear);
  builder.add(1.0);
  builder.add(2.0);
  const Range range = builder.range({.low = 5.0, .high = -5.0}, 0.05);
  EXPECT_EQ(range.low, -5.0);
  EXPECT_EQ(range.high, 5.0);
  EXPECT_LT(builder.range({.low = std::nan("")}, 0.0).low, 1.1);
  EXPECT_EQ(builder.range({.from_zero = true}, 0.05).low, 0.0);
}

}  // namespace
}  // namespace prehensile::plot
