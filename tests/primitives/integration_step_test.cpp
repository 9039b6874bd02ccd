#include "primitives/integration_step.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "primitives/dormand_prince.h"

namespace prehensile {
namespace {

constexpr int kOrder = 6;

// A turning and growing spiral with a known solution.
Vec2 exact(double s) {
  return std::exp(0.3 * s * s) * Vec2(std::cos(2.0 * s), std::sin(2.0 * s));
}

bool spiral(double s, const Vec2& y, Vec2& rate) {
  rate = 0.6 * s * y + 2.0 * perp(y);
  return true;
}

bool never(const Vec2&) { return false; }

template <class Rate>
double take(const Rate& rate, DoubledStep& step) {
  const auto method = [](const auto& f, BaseStep& base) {
    return dormand_prince(f, base);
  };
  rate(step.s, step.y, step.rate);
  const double failed = halved(method, rate, rate, never, step);
  std::array<Vec2, 2> rates;
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = kQuadratureNodes[i];
    rate(step.s + x * step.h, step.at(x), rates[i]);
  }
  judge_halves(rates, step);
  return failed;
}

/// Relative size of what a step's error is told to be.
template <class Rate>
double doubled_error(const Rate& rate, double h, DoubledStep& step) {
  const auto method = [](const auto& f, BaseStep& base) {
    return dormand_prince(f, base);
  };
  step.s = 0.4;
  step.h = h;
  step.y = exact(0.4);
  rate(step.s, step.y, step.rate);
  EXPECT_TRUE(std::isinf(doubled(method, rate, rate, never, kOrder, step)));
  return step.error.norm() / (step.y_end - exact(0.4 + h)).norm();
}

DoubledStep step_over(double h) {
  DoubledStep step;
  step.s = 0.4;
  step.h = h;
  step.y = exact(0.4);
  EXPECT_TRUE(std::isinf(take(spiral, step)));
  return step;
}

TEST(DoubledStep, ErrorIsThatOfTheStateItKeeps) {
  for (const double h : {0.4, 0.2, 0.1}) {
    const DoubledStep step = step_over(h);
    const double error = (step.y_end - exact(0.4 + h)).norm();
    // The first term of the error, so that what is missing falls with the step.
    EXPECT_LT((step.error - (step.y_end - exact(0.4 + h))).norm(), 1.2 * h * error) << h;
    EXPECT_LT(step.defect.norm(), 0.3 * step.embedded.norm()) << h;
    DoubledStep other;
    const double share = doubled_error(spiral, h, other);
    EXPECT_TRUE(other.is_smooth);
    EXPECT_GT(share, 0.5) << h;
    EXPECT_LT(share, 10.0) << h;
    EXPECT_EQ((other.y_end - step.y_end).norm(), 0.0);
  }
}

TEST(DoubledStep, StateInsideIsOfFifthOrderAndExactAtTheNodes) {
  const auto worst = [](double h) {
    const DoubledStep step = step_over(h);
    EXPECT_NEAR((step.at(0.0) - step.y).norm(), 0.0, 1e-15);
    EXPECT_NEAR((step.at(0.5) - step.y_middle).norm(), 0.0, 1e-15);
    EXPECT_NEAR((step.at(1.0) - step.y_end).norm(), 0.0, 1e-15);
    double error = 0.0;
    for (const double x : {0.1, 0.2, 0.35, 0.7, 0.9}) {
      error = std::max(error, (step.at(x) - exact(0.4 + x * h)).norm());
    }
    return error;
  };
  EXPECT_NEAR(std::log2(worst(0.4) / worst(0.2)), 6.0, 0.5);  // local order
}

TEST(DoubledStep, RateInsideIsTheDerivativeOfTheState) {
  const DoubledStep step = step_over(0.3);
  for (const double x : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    const double d = 1e-5;
    const Vec2 difference = (step.at(x + d) - step.at(x - d)) / (2.0 * d * step.h);
    EXPECT_NEAR((step.rate_at(x) - difference).norm(), 0.0, 1e-8) << x;
  }
}

// A kink inside: the error falls with the second power of the step, not with the sixth,
// and is random: where the kink is decides.
TEST(DoubledStep, SeesAKinkWhereverItIs) {
  int seen = 0;
  int enough = 0;
  constexpr int kPlaces = 200;
  for (int i = 0; i < kPlaces; ++i) {
    const double kink = (i + 0.5) / kPlaces;
    const auto kinked = [kink](double s, const Vec2&, Vec2& rate) {
      rate = {std::max(0.0, s - kink), 1.0};
      return true;
    };
    DoubledStep step;
    step.h = 1.0;
    step.y.setZero();
    ASSERT_TRUE(std::isinf(take(kinked, step)));
    const double error = std::abs(step.y_end[0] - 0.5 * (1.0 - kink) * (1.0 - kink));
    seen += step.defect.norm() > 0.3 * step.embedded.norm() ? 1 : 0;
    enough += 7.5 * step.error.norm() > error ? 1 : 0;
  }
  EXPECT_EQ(seen, kPlaces);
  EXPECT_GT(enough, 0.9 * kPlaces);
}

TEST(DoubledStep, LastCallIsTheOneAtTheEnd) {
  DoubledStep step;
  step.h = 1.0;
  step.y = exact(0.0);
  step.rate = Vec2(0.0, 2.0);
  int at_end = 0;
  int others_after = 0;
  const auto rate = [&](double s, const Vec2& y, Vec2& out) {
    others_after += at_end;
    return spiral(s, y, out);
  };
  const auto end_rate = [&](double s, const Vec2& y, Vec2& out) {
    EXPECT_EQ(s, 1.0);
    ++at_end;
    return spiral(s, y, out);
  };
  const auto method = [](const auto& f, BaseStep& base) {
    return dormand_prince(f, base);
  };
  ASSERT_TRUE(std::isinf(doubled(method, rate, end_rate, never, kOrder, step)));
  EXPECT_EQ(at_end, 1);
  EXPECT_EQ(others_after, 0);
}

TEST(DoubledStep, GivesUpBeforeTheHalves) {
  DoubledStep step;
  step.h = 1.0;
  step.y = exact(0.0);
  step.rate = Vec2(0.0, 2.0);
  int calls = 0;
  const auto rate = [&](double s, const Vec2& y, Vec2& out) {
    ++calls;
    return spiral(s, y, out);
  };
  const auto method = [](const auto& f, BaseStep& base) {
    return dormand_prince(f, base);
  };
  const auto always = [](const Vec2&) { return true; };
  ASSERT_TRUE(std::isinf(doubled(method, rate, rate, always, kOrder, step)));
  EXPECT_TRUE(step.gave_up);
  EXPECT_EQ(calls, 6);
  EXPECT_GT(step.error.norm(), 0.0);
}

}  // namespace
}  // namespace prehensile
