#include "primitives/rosenbrock.h"

#include <cmath>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

// y' = A(s) y, a turning and growing spiral with a known solution.
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
  RateDerivatives derivatives;
  derivatives.by_state << 0.6 * s, -2.0, 2.0, 0.6 * s;
  derivatives.by_s = 0.6 * y;
  EXPECT_TRUE(std::isinf(rosenbrock(spiral, derivatives, step)));
  return step;
}

double error_with(int steps) {
  Vec2 y = exact(0.0);
  for (int i = 0; i < steps; ++i) y = step_from(1.0 * i / steps, y, 1.0 / steps).y_end;
  return (y - exact(1.0)).norm();
}

TEST(Rosenbrock, FourthOrder) {
  EXPECT_NEAR(std::log2(error_with(20) / error_with(40)), 4.0, 0.2);
}

TEST(Rosenbrock, ErrorEstimateIsOfFourthOrderAndLargerThanTheError) {
  const BaseStep wide = step_from(0.4, exact(0.4), 0.1);
  const BaseStep narrow = step_from(0.4, exact(0.4), 0.05);
  EXPECT_NEAR(std::log2(wide.error.norm() / narrow.error.norm()), 4.0, 0.3);
  EXPECT_GT(wide.error.norm(), (wide.y_end - exact(0.5)).norm());
}

// A fast part that dies out, far beyond what an explicit method could follow, and a slow
// one: y0' = -1e6 (y0 - cos s) - sin s, y1' = -y1.
TEST(Rosenbrock, StiffPartDiesOutInLongSteps) {
  const double stiffness = 1e6;
  const auto rate = [&](double s, const Vec2& y, Vec2& out) {
    out = {-stiffness * (y[0] - std::cos(s)) - std::sin(s), -y[1]};
    return true;
  };
  BaseStep step;
  step.y = {1.0, 1.0};
  step.h = 0.1;
  for (int i = 0; i < 10; ++i) {
    step.s = 0.1 * i;
    rate(step.s, step.y, step.rate);
    RateDerivatives derivatives;
    derivatives.by_state << -stiffness, 0.0, 0.0, -1.0;
    derivatives.by_s = {-stiffness * std::sin(step.s) - std::cos(step.s), 0.0};
    ASSERT_TRUE(std::isinf(rosenbrock(rate, derivatives, step)));
    step.y = step.y_end;
  }
  EXPECT_NEAR(step.y[0], std::cos(1.0), 1e-5);
  EXPECT_NEAR(step.y[1], std::exp(-1.0), 1e-6);
}

TEST(Rosenbrock, SaysWhereThereIsNoRate) {
  const auto rate = [](double s, const Vec2&, Vec2& out) {
    out = {1.0, 0.0};
    return s < 0.5;
  };
  BaseStep step;
  step.h = 1.0;
  step.y = Vec2::Zero();
  step.rate = {1.0, 0.0};
  EXPECT_EQ(rosenbrock(rate, {}, step), 0.63);
}

}  // namespace
}  // namespace prehensile
