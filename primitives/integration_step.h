/// Steps of an integrator for two coordinates. A `BaseStep` is one step of a method
/// (dormand_prince.h, rosenbrock.h); a `DenseStep` is what is kept of it, with a state at
/// every place inside. The error of a single base step is told by the rates at two places
/// of it (`single` and `judge`); that of a stiff one by what two steps of half the length
/// differ by from it (`doubled`).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/frames.h"

namespace prehensile {

struct BaseStep {
  double s = 0.0;         ///< where it starts
  double h = 0.0;         ///< its length
  Vec2 y = Vec2::Zero();  ///< state at both ends
  Vec2 y_end = Vec2::Zero();
  Vec2 rate = Vec2::Zero();  ///< at both ends; rate_end starts the next step
  Vec2 rate_end = Vec2::Zero();
  Vec2 error = Vec2::Zero();  ///< of the lower order of the pair, at the end
  Vec2 probe = Vec2::Zero();  ///< a small change of y_end and what it does to the rate
  Vec2 probe_rate = Vec2::Zero();
  bool ends = false;  ///< set before the last call of the rate, the one at the end
  Vec2 y_middle = Vec2::Zero();  ///< of order 4; by dormand_prince only

  /// State at the share x in [0, 1] of an explicit step, of order 4: the quartic through
  /// states and rates at the ends and the state in the middle.
  Vec2 at(double x) const {
    const double z = 1.0 - x;
    const double rise = x * x * (3.0 - 2.0 * x);
    const Vec2 bulge = y_middle - 0.5 * (y + y_end) - 0.125 * h * (rate - rate_end);
    return (1.0 - rise) * y + rise * y_end + x * z * h * (z * rate - x * rate_end) +
           16.0 * x * x * z * z * bulge;
  }

  /// Rate of that quartic times the step's length.
  Vec2 change_at(double x) const {
    const double z = 1.0 - x;
    const Vec2 bulge = y_middle - 0.5 * (y + y_end) - 0.125 * h * (rate - rate_end);
    return 6.0 * x * z * (y_end - y) + z * (1.0 - 3.0 * x) * h * rate -
           x * (2.0 - 3.0 * x) * h * rate_end + 32.0 * x * z * (z - x) * bulge;
  }
};

struct DenseStep {
  double s = 0.0;         ///< where it starts
  double h = 0.0;         ///< its length
  Vec2 y = Vec2::Zero();  ///< state at start, middle and end
  Vec2 y_middle = Vec2::Zero();
  Vec2 y_end = Vec2::Zero();
  Vec2 rate = Vec2::Zero();  ///< rate there
  Vec2 rate_middle = Vec2::Zero();
  Vec2 rate_end = Vec2::Zero();
  Vec2 error = Vec2::Zero();     ///< of y_end, made in this step
  bool is_doubled = false;       ///< by `doubled`; then
  bool gave_up = false;          ///< only the embedded error of the whole step is known
  bool is_smooth = true;         ///< errors fall with the method's own order
  Vec2 embedded = Vec2::Zero();  ///< of a single step: the error of the lower order,
  Vec2 defect = Vec2::Zero();    ///< and what its rates are off by, times its length
  Vec2 probe = Vec2::Zero();     ///< a change of state and what it does to the rate
  Vec2 probe_rate = Vec2::Zero();

  /// State at the share x in [0, 1] of the step, by the states and rates at start, middle
  /// and end: of order 5 (doubled) or 4.
  Vec2 at(double x) const {
    const double u = 2.0 * x - 1.0;
    const double k = 0.5 * h;
    const double first = 0.25 * u * u * (u - 1.0) * (u - 1.0);
    const double middle = (1.0 - u * u) * (1.0 - u * u);
    const double last = 0.25 * u * u * (u + 1.0) * (u + 1.0);
    return first * ((3.0 * u + 4.0) * y + (u + 1.0) * k * rate) +
           middle * (y_middle + u * k * rate_middle) +
           last * ((4.0 - 3.0 * u) * y_end + (u - 1.0) * k * rate_end);
  }

  /// Rate of that polynomial.
  Vec2 rate_at(double x) const {
    const double u = 2.0 * x - 1.0;
    const double k = 0.5 * h;
    const double first = 0.25 * u * u * (u - 1.0) * (u - 1.0);
    const double middle = (1.0 - u * u) * (1.0 - u * u);
    const double last = 0.25 * u * u * (u + 1.0) * (u + 1.0);
    const double first_u = 0.5 * u * (u - 1.0) * (2.0 * u - 1.0);
    const double middle_u = -4.0 * u * (1.0 - u * u);
    const double last_u = 0.5 * u * (u + 1.0) * (2.0 * u + 1.0);
    const Vec2 by_u = first_u * ((3.0 * u + 4.0) * y + (u + 1.0) * k * rate) +
                      first * (3.0 * y + k * rate) +
                      middle_u * (y_middle + u * k * rate_middle) +
                      middle * k * rate_middle +
                      last_u * ((4.0 - 3.0 * u) * y_end + (u - 1.0) * k * rate_end) +
                      last * (-3.0 * y_end + k * rate_end);
    return by_u / k;
  }

  /// Least and greatest rate of that polynomial on [0, to] times the step's length, of
  /// each component: bounds, by its Bernstein coefficients there. `to` may exceed 1.
  std::array<Vec2, 2> change_within(double to) const {
    std::array<Vec2, 6> b;
    b[0] = y;
    b[1] = y + 0.2 * h * rate;
    b[4] = y_end - 0.2 * h * rate_end;
    b[5] = y_end;
    const Vec2 sum = 3.2 * y_middle - 0.1 * (b[0] + b[5]) - 0.5 * (b[1] + b[4]);
    const Vec2 difference =
        1.6 * h * rate_middle + 0.5 * (b[0] - b[5]) + 1.5 * (b[1] - b[4]);
    b[2] = 0.5 * (sum - difference);
    b[3] = 0.5 * (sum + difference);
    for (int level = 1; level < 6; ++level) {
      for (int i = 5; i >= level; --i) b[i] = (1.0 - to) * b[i - 1] + to * b[i];
    }
    std::array<Vec2, 2> range{5.0 / to * (b[1] - b[0]), 5.0 / to * (b[1] - b[0])};
    for (int i = 1; i < 5; ++i) {
      const Vec2 change = 5.0 / to * (b[i + 1] - b[i]);
      range[0] = range[0].cwiseMin(change);
      range[1] = range[1].cwiseMax(change);
    }
    return range;
  }

  /// Where the rate of the polynomial tells best what its state lacks at x.
  double telling(double x) const {
    return !is_doubled ? 0.5 : x < 0.5 ? kSteepest : 1.0 - kSteepest;
  }

  /// What the state lacks at x over the step's length times what the rate lacks at
  /// `telling(x)`. The rate lacks a constant times its distances from the nodes where it
  /// is right: start, quadrature nodes and end; of a doubled step, whose state is right
  /// at start, middle and end as well, the derivative of (x (x - 1/2) (x - 1))^2.
  double lack_of_state(double x) const {
    const double w = x * (1.0 - x);
    if (!is_doubled) return 8.0 * w * w * std::abs(1.0 - 2.0 * x);
    constexpr double kAway = 1.0 - 2.0 * kSteepest;
    constexpr double kW = kSteepest * (1.0 - kSteepest);
    return w * w * (1.0 - 2.0 * x) * (1.0 - 2.0 * x) /
           (2.0 * kW * kAway * (1.0 - 6.0 * kW));
  }

 private:
  static constexpr double kSteepest = 0.09;
};

/// The base step over the whole of `step`.
inline BaseStep base_of(const DenseStep& step) {
  BaseStep base;
  base.s = step.s;
  base.h = step.h;
  base.y = step.y;
  base.rate = step.rate;
  return base;
}

/// Takes the base step at the end of `step`, whose last rate is `end_rate`.
template <class Method, class Rate, class EndRate>
double end_with(const Method& method, const Rate& rate, const EndRate& end_rate,
                BaseStep& last, DenseStep& step) {
  const auto rate_to_end = [&](double s, const Vec2& y, Vec2& out) {
    return last.ends ? end_rate(s, y, out) : rate(s, y, out);
  };
  const double failed = method(rate_to_end, last);
  step.y_end = last.y_end;
  step.rate_end = last.rate_end;
  step.probe = last.probe;
  step.probe_rate = last.probe_rate;
  return failed;
}

/// Fills `step` from step.s, step.h, step.y and step.rate. `method(rate, base)` fills a
/// base step and returns the s at which there is no rate, or infinity; so does this.
/// `end_rate` is called last, at the end of the step. `order` is the power of its length
/// with which the error of a base step falls, of its slow part: that of a stiff part
/// falls with the second, and its embedded error says little.
///
/// `is_hopeless(error)` is asked about the embedded error of the whole step, before its
/// halves are taken: if so they are not, and `gave_up` is set.
///
/// Which of the two it is shows in the embedded errors of the base steps.
template <class Method, class Rate, class EndRate, class Hopeless>
double doubled(const Method& method, const Rate& rate, const EndRate& end_rate,
               const Hopeless& is_hopeless, int order, DenseStep& step) {
  constexpr double kDone = std::numeric_limits<double>::infinity();
  constexpr double kOfEmbedded = 0.1;  // a step's own error is seldom less
  BaseStep whole = base_of(step);
  if (const double failed = method(rate, whole); failed != kDone) return failed;
  step.is_doubled = true;
  step.y_end = whole.y_end;
  step.error = whole.error;
  step.gave_up = is_hopeless(whole.error);
  if (step.gave_up) return kDone;
  BaseStep first = whole;
  first.h = 0.5 * step.h;
  first.ends = false;
  if (const double failed = method(rate, first); failed != kDone) return failed;
  BaseStep last;
  last.s = step.s + first.h;
  last.h = step.h - first.h;
  last.y = first.y_end;
  last.rate = first.rate_end;
  if (const double failed = end_with(method, rate, end_rate, last, step);
      failed != kDone) {
    return failed;
  }
  step.y_middle = first.y_end;
  step.rate_middle = first.rate_end;
  // Smooth: the embedded errors of the halves together are 2^(order - 2) times smaller.
  const double embedded = first.error.norm() + last.error.norm();
  const Vec2 difference = whole.y_end - step.y_end;
  const double size = difference.norm();
  step.is_smooth = whole.error.norm() >= 0.4 * (1 << (order - 2)) * embedded;
  const double scale = step.is_smooth ? 1.0 / ((1 << (order - 1)) - 1.0) : 1.0 / 3.0;
  const double least = step.is_smooth ? kOfEmbedded * embedded : 0.0;
  step.error = size > 0.0 ? Vec2(std::max(scale, least / size) * difference)
                          : Vec2(first.error + last.error);
  return kDone;
}

/// Fills `step` by a single base step, as `doubled` does by three, but for its error and
/// its middle, which are left to `judge`.
template <class Method, class Rate, class EndRate>
double single(const Method& method, const Rate& rate, const EndRate& end_rate,
              BaseStep& base, DenseStep& step) {
  base = base_of(step);
  step.is_doubled = false;
  step.gave_up = false;
  const double failed = end_with(method, rate, end_rate, base, step);
  step.embedded = base.error;
  return failed;
}

/// Where a single step is looked at: with its ends these are the nodes of Lobatto's
/// quadrature with four points.
inline constexpr std::array<double, 2> kQuadratureNodes{0.27639320225002103,
                                                        0.72360679774997897};

/// The error of `single`, from the rates at `kQuadratureNodes` of its base step: what the
/// end lacks of the integral of these rates and those at the ends, which is as far from
/// the truth as the end, in another way. Inside, the state is the integral of the cubic
/// through the four rates.
///
/// What the rates are off the base step's quartic falls, where the rate is smooth, with a
/// higher power of the length than its curvature over the step. A kink that bends the
/// rate more than the rest does is a constant share of both, wherever it lies. Then the
/// error is random and may be computed small by chance, but is not far above that
/// difference.
inline void judge(const BaseStep& base, const std::array<Vec2, 2>& rates,
                  DenseStep& step) {
  constexpr double kOfCurvature = 0.01;
  constexpr double kRootOf5 = 2.2360679774997897;
  const Vec2 ends = step.rate + step.rate_end;
  const Vec2 nodes = rates[0] + rates[1];
  step.error = step.y_end - step.y - step.h / 12.0 * (ends + 5.0 * nodes);
  step.rate_middle = 0.125 * (5.0 * nodes - ends);
  const Vec2 bend =
      3.0 * (step.rate - step.rate_end) + 5.0 * kRootOf5 * (rates[0] - rates[1]);
  step.y_middle = 0.5 * (step.y + step.y_end) + step.h / 64.0 * bend;
  const std::array<Vec2, 2> defects{
      step.h * rates[0] - base.change_at(kQuadratureNodes[0]),
      step.h * rates[1] - base.change_at(kQuadratureNodes[1])};
  step.defect = defects[defects[0].squaredNorm() < defects[1].squaredNorm() ? 1 : 0];
  step.is_smooth = step.defect.norm() <= kOfCurvature * step.h * (ends - nodes).norm();
}

}  // namespace prehensile
