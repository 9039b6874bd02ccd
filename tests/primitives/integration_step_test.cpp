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

const auto method = [](const auto& f, BaseStep& base) { return dormand_prince(f, base); };

/// A single step with its error.
template <class Rate>
double take(const Rate& rate, DenseStep& step) {
  rate(step.s, step.y, step.rate);
  BaseStep base;
  const double failed = single(method, rate, rate, base, step);
  std::array<Vec2, 2> rates;
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = kQuadratureNodes[i];
    rate(step.s + x * step.h, base.at(x), rates[i]);
  }
  judge(base, rates, step);
  return failed;
}

/// Relative size of what a step's error is told to be.
template <class Rate>
double doubled_error(const Rate& rate, double h, DenseStep& step) {
  step.s = 0.4;
  step.h = h;
  step.y = exact(0.4);
  rate(step.s, step.y, step.rate);
  EXPECT_TRUE(std::isinf(doubled(method, rate, rate, never, kOrder, step)));
  return step.error.norm() / (step.y_end - exact(0.4 + h)).norm();
}

DenseStep single_over(double h) {
  DenseStep step;
  step.s = 0.4;
  step.h = h;
  step.y = exact(0.4);
  EXPECT_TRUE(std::isinf(take(spiral, step)));
  return step;
}

DenseStep doubled_over(double h) {
  DenseStep step;
  doubled_error(spiral, h, step);
  return step;
}

TEST(DenseStep, ErrorIsOfTheSizeOfThatOfTheStateItKeeps) {
  for (const double h : {0.4, 0.2, 0.1}) {
    const DenseStep step = single_over(h);
    const double error = (step.y_end - exact(0.4 + h)).norm();
    EXPECT_GT(step.error.norm(), 0.4 * error) << h;
    EXPECT_LT(step.error.norm(), 0.6 * error) << h;
    EXPECT_GT(step.embedded.norm(), step.error.norm()) << h;
    EXPECT_TRUE(step.is_smooth) << h;
    DenseStep other;
    const double share = doubled_error(spiral, h, other);
    EXPECT_TRUE(other.is_smooth);
    EXPECT_GT(share, 0.5) << h;
    EXPECT_LT(share, 10.0) << h;
  }
  const double halved = single_over(0.2).error.norm() / single_over(0.1).error.norm();
  EXPECT_NEAR(std::log2(halved), 6.0, 0.5);
}

double worst_inside(const DenseStep& step) {
  EXPECT_NEAR((step.at(0.0) - step.y).norm(), 0.0, 1e-15);
  EXPECT_NEAR((step.at(0.5) - step.y_middle).norm(), 0.0, 1e-15);
  EXPECT_NEAR((step.at(1.0) - step.y_end).norm(), 0.0, 1e-15);
  double error = 0.0;
  for (const double x : {0.1, 0.2, 0.35, 0.7, 0.9}) {
    error = std::max(error, (step.at(x) - exact(0.4 + x * step.h)).norm());
  }
  return error;
}

TEST(DenseStep, StateInsideIsOfItsOrderAndExactAtTheNodes) {
  const auto local_order = [](auto&& step_over) {
    return std::log2(worst_inside(step_over(0.4)) / worst_inside(step_over(0.2)));
  };
  EXPECT_GT(local_order(single_over), 5.0);  // that of the end, of order 6, rules
  EXPECT_NEAR(local_order(doubled_over), 6.0, 0.5);
}

TEST(DenseStep, RateInsideIsTheDerivativeOfTheState) {
  const DenseStep step = single_over(0.3);
  for (const double x : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    const double d = 1e-5;
    const Vec2 difference = (step.at(x + d) - step.at(x - d)) / (2.0 * d * step.h);
    EXPECT_NEAR((step.rate_at(x) - difference).norm(), 0.0, 1e-8) << x;
  }
}

// An event is met on the state inside. What that is off by is a share of what the end is
// off by, and what one rate tells.
TEST(DenseStep, OneRateTellsWhatTheStateInsideLacks) {
  for (const DenseStep& step : {single_over(0.4), single_over(0.1), single_over(0.05),
                                doubled_over(0.4), doubled_over(0.1)}) {
    const double at_end = (step.y_end - exact(step.s + step.h)).norm();
    for (const double x : {0.15, 0.3, 0.4, 0.5, 0.65, 0.8}) {
      const double at = step.telling(x);
      Vec2 rate;
      spiral(step.s + at * step.h, step.at(at), rate);
      const double told =
          step.h * (rate - step.rate_at(at)).norm() * step.lack_of_state(x);
      const double lacks = (step.at(x) - exact(step.s + x * step.h)).norm();
      EXPECT_LT(lacks, 1.1 * told + 1.2 * x * at_end) << step.is_doubled << ' ' << x;
      EXPECT_LT(told, 2.0 * (lacks + at_end)) << step.is_doubled << ' ' << x;
    }
  }
}

// A kink inside: the error falls with the second power of the step, not with the sixth,
// and is random: where the kink is decides.
TEST(DenseStep, SeesAKinkWhereverItIs) {
  int seen = 0;
  int enough = 0;
  constexpr int kPlaces = 200;
  for (int i = 0; i < kPlaces; ++i) {
    const double kink = (i + 0.5) / kPlaces;
    const auto kinked = [kink](double s, const Vec2&, Vec2& rate) {
      rate = {std::max(0.0, s - kink), 1.0};
      return true;
    };
    DenseStep step;
    step.h = 1.0;
    step.y.setZero();
    ASSERT_TRUE(std::isinf(take(kinked, step)));
    const double error = std::abs(step.y_end[0] - 0.5 * (1.0 - kink) * (1.0 - kink));
    seen += step.is_smooth ? 0 : 1;
    enough += std::max(7.5 * step.error.norm(), 3.0 * step.defect.norm()) > error;
  }
  EXPECT_EQ(seen, kPlaces);
  EXPECT_GE(enough, 0.99 * kPlaces);
}

// Of smooth rates of many kinds a quartic lacks little, over steps worth taking.
TEST(DenseStep, SmoothRatesAreNotTakenForKinks) {
  for (int kind = 0; kind < 5; ++kind) {
    const auto rate = [kind](double s, const Vec2& y, Vec2& out) {
      const double turn = 1.0 + 0.5 * kind;
      out = kind % 2 == 0 ? Vec2(std::cos(turn * s), y[0] * y[1])
                          : Vec2(y[1] / (1.0 + y[0] * y[0]), -turn * std::sin(y[0]));
      return true;
    };
    for (int i = 0; i < 40; ++i) {
      DenseStep step;
      step.s = 0.1 * i;
      step.h = 0.1 + 0.01 * (i % 20);
      step.y = {std::sin(1.7 * i), std::cos(0.9 * i)};
      ASSERT_TRUE(std::isinf(take(rate, step)));
      EXPECT_TRUE(step.is_smooth) << kind << ' ' << i;
    }
  }
}

TEST(DenseStep, LastCallIsTheOneAtTheEnd) {
  DenseStep step;
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
  ASSERT_TRUE(std::isinf(doubled(method, rate, end_rate, never, kOrder, step)));
  EXPECT_EQ(at_end, 1);
  EXPECT_EQ(others_after, 0);
  at_end = 0;
  BaseStep base;
  ASSERT_TRUE(std::isinf(single(method, rate, end_rate, base, step)));
  EXPECT_EQ(at_end, 1);
  EXPECT_EQ(others_after, 0);
}

TEST(DenseStep, GivesUpBeforeTheHalves) {
  DenseStep step;
  step.h = 1.0;
  step.y = exact(0.0);
  step.rate = Vec2(0.0, 2.0);
  int calls = 0;
  const auto rate = [&](double s, const Vec2& y, Vec2& out) {
    ++calls;
    return spiral(s, y, out);
  };
  const auto always = [](const Vec2&) { return true; };
  ASSERT_TRUE(std::isinf(doubled(method, rate, rate, always, kOrder, step)));
  EXPECT_TRUE(step.gave_up);
  EXPECT_EQ(calls, 6);
  EXPECT_GT(step.error.norm(), 0.0);
}

// Nothing inside changes faster than the bound says, nor beyond the end of the step.
TEST(IntegrationStep, ChangesStayWithinTheirBounds) {
  for (const double h : {0.1, 0.8}) {
    for (const bool is_doubled : {false, true}) {
      DenseStep step;
      if (is_doubled) {
        doubled_error(spiral, h, step);
      } else {
        step = single_over(h);
      }
      for (const double to : {0.3, 1.0, 2.5}) {
        const auto [least, most] = step.change_within(to);
        Vec2 seen_least = h * step.rate_at(0.0);
        Vec2 seen_most = seen_least;
        for (int i = 0; i <= 200; ++i) {
          const Vec2 change = h * step.rate_at(to * i / 200.0);
          seen_least = seen_least.cwiseMin(change);
          seen_most = seen_most.cwiseMax(change);
        }
        EXPECT_TRUE(((seen_least - least).array() > -1e-12).all()) << h << " " << to;
        EXPECT_TRUE(((most - seen_most).array() > -1e-12).all()) << h << " " << to;
        // And they are no idle ones.
        const double range = (seen_most - seen_least).norm();
        EXPECT_LT((most - least).norm(), 3.0 * range + 1e-12) << h << " " << to;
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
