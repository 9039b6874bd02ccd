#include "planner/geometry/free_directions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/constants.h"

namespace prehensile {
namespace {

/// Sine of the angle beyond an arc around `middle`, computed in another way.
double beyond(double angle, double middle, double half, double freely) {
  const double off = std::acos(std::clamp(std::cos(angle - middle), -1.0, 1.0));
  return off <= half + freely ? 0.0 : std::sin(std::min(off - half - freely, kPi / 2.0));
}

TEST(FreeDirections, CheatingIsTheSineBeyondTheNearest) {
  for (const double middle : {0.0, 1.0, 3.1, -2.5}) {
    constexpr double kHalf = 0.4;
    const FreeDirections free = FreeDirections::where(
        [&](double angle) { return std::cos(angle - middle) >= std::cos(kHalf); });
    for (double angle = -4.0; angle < 4.0; angle += 0.05) {
      const double off = std::acos(std::clamp(std::cos(angle - middle), -1.0, 1.0));
      EXPECT_NEAR(free.distance(angle), std::max(0.0, off - kHalf), 2e-3);
      for (const double freely : {0.0, 0.1}) {
        EXPECT_NEAR(free.cheating(angle, freely), beyond(angle, middle, kHalf, freely),
                    2e-3)
            << middle << " " << angle;
      }
    }
  }
}

TEST(FreeDirections, OfAllAndOfNone) {
  const FreeDirections all = FreeDirections::where([](double) { return true; });
  const FreeDirections none = FreeDirections::where([](double) { return false; });
  for (double angle = -4.0; angle < 4.0; angle += 0.1) {
    EXPECT_EQ(all.distance(angle), 0.0);
    EXPECT_EQ(none.distance(angle), kPi);
    EXPECT_EQ(all.cheating(angle, 0.0), 0.0);
    EXPECT_EQ(none.cheating(angle, 0.0), 1.0);
    EXPECT_EQ(FreeDirections().cheating(angle, 0.3), 1.0);
  }
}

TEST(FreeDirections, WidestGapIsBetweenTheRangesFarthestApart) {
  for (double turned = -4.0; turned < 4.0; turned += 0.37) {
    // 0.4 free, 1.1 not, 0.8 free, the rest not.
    const auto is_free = [=](double angle) {
      const double from = std::remainder(angle - turned, 2.0 * kPi);
      return std::abs(from - 0.2) < 0.2 || std::abs(from - 1.9) < 0.4;
    };
    const FreeDirections free = FreeDirections::where(is_free);
    const FreeDirections::Gap gap = free.widest_gap();
    EXPECT_NEAR(std::remainder(gap.from - turned - 2.3, 2.0 * kPi), 0.0, 2e-3) << turned;
    EXPECT_NEAR(gap.width, 2.0 * kPi - 2.3, 4e-3) << turned;
  }
  EXPECT_EQ(FreeDirections::where([](double) { return true; }).widest_gap().width, 0.0);
  EXPECT_EQ(FreeDirections().widest_gap().width, 2.0 * kPi);
  EXPECT_TRUE(FreeDirections().are_none());
}

/// Values that fall to both sides of a direction, as sampled.
TEST(FreeDirections, AboveAValueInterpolates) {
  constexpr double kMiddle = 0.7;
  std::array<double, FreeDirections::kLookedAt> values;
  for (int k = 0; k < FreeDirections::kLookedAt; ++k) {
    values[k] = std::cos(FreeDirections::direction(k) - kMiddle);
  }
  for (const double half : {0.3, 0.9, 1.6}) {
    const FreeDirections free = FreeDirections::above(values, std::cos(half));
    for (double angle = -4.0; angle < 4.0; angle += 0.05) {
      EXPECT_NEAR(free.cheating(angle, 0.0), beyond(angle, kMiddle, half, 0.0), 5e-3);
    }
  }
}

}  // namespace
}  // namespace prehensile
