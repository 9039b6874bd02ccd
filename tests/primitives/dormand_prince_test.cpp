#include "primitives/dormand_prince.h"

#include <cmath>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

// A turning and growing spiral that depends on s: y' = A(s) y with a known solution.
Vec2 exact(double s) {
  return std::exp(0.3 * s * s) * Vec2(std::cos(2.0 * s), std::sin(2.0 * s));
}
bool spiral(double s, const Vec2& y, Vec2& rate) {
  rate = 0.6 * s * y + 2.0 * perp(y);
  return true;
}

BaseStep step_from(double s, const Vec2& y, double h) {
  BaseStep step;
  step.s = s;
  step.h = h;
  step.y = y;
  spiral(s, y, step.rate);
  EXPECT_TRUE(std::isinf(dormand_prince(spiral, step)));
  return step;
}

double error_with(int steps) {
  Vec2 y = exact(0.0);
  for (int i = 0; i < steps; ++i) y = step_from(1.0 * i / steps, y, 1.0 / steps).y_end;
  return (y - exact(1.0)).norm();
}

TEST(DormandPrince, FifthOrder) {
  const double order = std::log2(error_with(10) / error_with(20));
  EXPECT_NEAR(order, 5.0, 0.2);
}

TEST(DormandPrince, ErrorEstimateIsOfFifthOrderAndLargerThanTheError) {
  const BaseStep wide = step_from(0.4, exact(0.4), 0.1);
  const BaseStep narrow = step_from(0.4, exact(0.4), 0.05);
  EXPECT_NEAR(std::log2(wide.error.norm() / narrow.error.norm()), 5.0, 0.3);
  EXPECT_GT(wide.error.norm(), (wide.y_end - exact(0.5)).norm());
}

TEST(DormandPrince, StateInsideIsOfFourthOrder) {
  const auto worst = [](double h) {
    const BaseStep step = step_from(0.4, exact(0.4), h);
    EXPECT_NEAR((step.at(0.0) - step.y).norm(), 0.0, 1e-15);
    EXPECT_NEAR((step.at(0.5) - step.y_middle).norm(), 0.0, 1e-15);
    EXPECT_NEAR((step.at(1.0) - step.y_end).norm(), 0.0, 1e-15);
    double error = 0.0;
    for (const double x : {0.1, 0.28, 0.5, 0.72, 0.9}) {
      error = std::max(error, (step.at(x) - exact(0.4 + x * h)).norm());
    }
    return error;
  };
  EXPECT_NEAR(std::log2(worst(0.2) / worst(0.1)), 5.0, 0.4);  // local order
}

TEST(DormandPrince, EndRateStartsTheNextStepAndTheProbeShowsTheGrowth) {
  const BaseStep step = step_from(0.4, exact(0.4), 0.01);
  Vec2 rate;
  spiral(0.41, step.y_end, rate);
  EXPECT_EQ(step.rate_end, rate);
  EXPECT_GT(step.probe.norm(), 0.0);
  EXPECT_NEAR(step.probe.dot(step.probe_rate) / step.probe.squaredNorm(), 0.6 * 0.41,
              1e-6);
}

TEST(DormandPrince, SaysWhereThereIsNoRate) {
  const auto wall = [](double s, const Vec2&, Vec2& rate) {
    rate.setZero();
    return s < 0.5;
  };
  BaseStep step;
  step.h = 1.0;
  step.y.setZero();
  step.rate.setZero();
  EXPECT_EQ(dormand_prince(wall, step), 0.8);
}

}  // namespace
}  // namespace prehensile
