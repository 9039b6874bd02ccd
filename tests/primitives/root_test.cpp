#include "primitives/root.h"

#include <cmath>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

/// Finds the root and counts the evaluations.
template <class Function>
int expect_root(const Function& f, double low, double high, double root,
                double tolerance) {
  int evaluations = 0;
  const auto counted = [&](double x) {
    ++evaluations;
    return f(x);
  };
  const double found = falling_root(counted, low, f(low), high, f(high), tolerance);
  EXPECT_NEAR(found, root, tolerance);
  return evaluations;
}

TEST(Root, SmoothKinkedSteepAndSaturated) {
  const auto smooth = [](double x) { return std::cos(x); };
  EXPECT_LE(expect_root(smooth, 0.0, 3.0, std::acos(0.0), 1e-12), 12);
  const auto kinked = [](double x) { return x < 0.3 ? 0.3 - x : 50.0 * (0.3 - x); };
  EXPECT_LE(expect_root(kinked, 0.0, 1.0, 0.3, 1e-9), 20);
  const auto saturated = [](double x) { return std::min(1e-9, 0.7 - x); };
  EXPECT_LE(expect_root(saturated, 0.0, 1.0, 0.7, 1e-9), 60);
  const auto jump = [](double x) { return x < 0.123 ? 1.0 : -100.0; };
  EXPECT_LE(expect_root(jump, 0.0, 1.0, 0.123, 1e-9), 60);
}

TEST(Root, AtTheEndsOfTheBracket) {
  const auto line = [](double x) { return -x; };
  EXPECT_LE(expect_root(line, 0.0, 1.0, 0.0, 1e-9), 40);
  const auto late = [](double x) { return 1.0 - 1e-12 - x; };
  EXPECT_LE(expect_root(late, 0.0, 1.0, 1.0, 1e-9), 40);
}

}  // namespace
}  // namespace prehensile
