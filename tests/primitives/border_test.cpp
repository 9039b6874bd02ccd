#include "primitives/border.h"

#include <cmath>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

/// Looks that the border takes; it is within the precision of the wanted one, inside.
template <class Margin>
int looks(const Margin& margin, double inside, double outside, double wanted,
          double precision) {
  int count = 0;
  const auto counted = [&](double x) {
    ++count;
    return margin(x);
  };
  const double found =
      border(counted, {inside, margin(inside)}, {outside, margin(outside)}, precision);
  EXPECT_NEAR(found, wanted, precision);
  EXPECT_GE(margin(found), 0.0);
  return count;
}

TEST(Border, SmoothMarginsTakeFewLooksFromEitherSide) {
  const auto smooth = [](double x) { return std::cos(x); };
  EXPECT_LE(looks(smooth, 0.0, 3.0, std::acos(0.0), 1e-9), 10);
  const auto mirrored = [](double x) { return std::cos(x); };
  EXPECT_LE(looks(mirrored, 0.0, -3.0, -std::acos(0.0), 1e-9), 10);
}

TEST(Border, AKinkAtTheBorderTakesFewToo) {
  const auto kinked = [](double x) { return x < 0.3 ? 0.3 - x : 1e-3 * (0.3 - x); };
  EXPECT_LE(looks(kinked, 0.0, 1.0, 0.3, 1e-9), 20);
}

TEST(Border, JumpsTakeSixLooksMoreThanBisectionAtMost) {
  const int halvings = 30;  // of 1 to 1e-9
  const auto jump = [](double x) { return x < 0.123 ? 1.0 : -1e-3; };
  EXPECT_LE(looks(jump, 0.0, 1.0, 0.123, 1e-9), halvings + 6);
  const auto other = [](double x) { return x < 0.877 ? 1e-3 - 1e-4 * x : -9.0 + x; };
  EXPECT_LE(looks(other, 0.0, 1.0, 0.877, 1e-9), halvings + 6);
  const auto flat = [](double x) { return x < 0.5001 ? 0.0 : -1.0; };
  EXPECT_LE(looks(flat, 0.0, 1.0, 0.5001, 1e-9), halvings + 6);
}

TEST(Border, AnInsideThatIsNoFartherThanThePrecisionIsIt) {
  const auto never = [](double) -> double {
    ADD_FAILURE();
    return 0.0;
  };
  EXPECT_EQ(border(never, {1.0, 0.5}, {1.0 + 1e-10, -1.0}, 1e-9), 1.0);
}

}  // namespace
}  // namespace prehensile
