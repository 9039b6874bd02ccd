/// Steps of an integrator for two coordinates. A `BaseStep` is one step of a method
/// (dormand_prince.h, rosenbrock.h); a `DoubledStep` covers a stretch by two base steps
/// of half the length. Their error is told by what they differ by from one base step of
/// the whole length (`doubled`, for stiff methods), or, for less work, by the rates at
/// two places of the polynomial through them (`halved` and `judge_halves`).
#pragma once

#include <algorithm>
#include <array>
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
};

struct DoubledStep {
  double s = 0.0;         ///< where it starts
  double h = 0.0;         ///< its length
  Vec2 y = Vec2::Zero();  ///< state at start, middle and end
  Vec2 y_middle = Vec2::Zero();
  Vec2 y_end = Vec2::Zero();
  Vec2 rate = Vec2::Zero();  ///< rate there
  Vec2 rate_middle = Vec2::Zero();
  Vec2 rate_end = Vec2::Zero();
  Vec2 error = Vec2::Zero();     ///< of y_end, made in this step
  bool gave_up = false;          ///< only the embedded error of the whole step is known
  Vec2 embedded = Vec2::Zero();  ///< size of the halves' own errors, of the lower order
  Vec2 defect = Vec2::Zero();    ///< by how much state and rates inside disagree
  bool is_smooth = true;      ///< of `doubled`: errors fall with the method's own order
  Vec2 probe = Vec2::Zero();  ///< a change of state and what it does to the rate
  Vec2 probe_rate = Vec2::Zero();

  /// State at the share x in [0, 1] of the step: of order 5, by the states and rates at
  /// start, middle and end.
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
};

/// The second half of `step` after its first, and what both say of the whole; a base step
/// is as `doubled` describes it, and so is what this returns.
template <class Method, class Rate, class EndRate>
double second_half(const Method& method, const Rate& rate, const EndRate& end_rate,
                   const BaseStep& first, BaseStep& last, DoubledStep& step) {
  constexpr double kDone = std::numeric_limits<double>::infinity();
  last.s = step.s + first.h;
  last.h = step.h - first.h;
  last.y = first.y_end;
  last.rate = first.rate_end;
  const auto rate_to_end = [&](double s, const Vec2& y, Vec2& out) {
    return last.ends ? end_rate(s, y, out) : rate(s, y, out);
  };
  if (const double failed = method(rate_to_end, last); failed != kDone) return failed;
  step.y_middle = first.y_end;
  step.rate_middle = first.rate_end;
  step.y_end = last.y_end;
  step.rate_end = last.rate_end;
  step.probe = last.probe;
  step.probe_rate = last.probe_rate;
  return kDone;
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
               const Hopeless& is_hopeless, int order, DoubledStep& step) {
  constexpr double kDone = std::numeric_limits<double>::infinity();
  constexpr double kOfEmbedded = 0.1;  // a step's own error is seldom less
  BaseStep whole;
  whole.s = step.s;
  whole.h = step.h;
  whole.y = step.y;
  whole.rate = step.rate;
  if (const double failed = method(rate, whole); failed != kDone) return failed;
  step.y_end = whole.y_end;
  step.error = whole.error;
  step.gave_up = is_hopeless(whole.error);
  if (step.gave_up) return kDone;
  BaseStep first = whole;
  first.h = 0.5 * step.h;
  first.ends = false;
  if (const double failed = method(rate, first); failed != kDone) return failed;
  BaseStep last;
  if (const double failed = second_half(method, rate, end_rate, first, last, step);
      failed != kDone) {
    return failed;
  }
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

/// Where a step that is taken in halves alone is looked at: with its ends and its middle
/// these are the nodes of Lobatto's quadrature with five points.
inline constexpr std::array<double, 2> kQuadratureNodes{0.17267316464601143,
                                                        0.82732683535398857};

/// Fills `step` as `doubled` does, but takes the two halves only; their error is left to
/// `judge_halves`. `is_hopeless(error)` is asked about the embedded error of the first.
template <class Method, class Rate, class EndRate, class Hopeless>
double halved(const Method& method, const Rate& rate, const EndRate& end_rate,
              const Hopeless& is_hopeless, DoubledStep& step) {
  constexpr double kDone = std::numeric_limits<double>::infinity();
  BaseStep first;
  first.s = step.s;
  first.h = 0.5 * step.h;
  first.y = step.y;
  first.rate = step.rate;
  if (const double failed = method(rate, first); failed != kDone) return failed;
  step.error = first.error;
  step.gave_up = is_hopeless(first.error);
  if (step.gave_up) return kDone;
  BaseStep last;
  if (const double failed = second_half(method, rate, end_rate, first, last, step);
      failed != kDone) {
    return failed;
  }
  step.embedded = first.error.cwiseAbs() + last.error.cwiseAbs();
  return kDone;
}

/// The error of `halved`, from the rates at `kQuadratureNodes` of its polynomial: what
/// the end lacks of the integral of these rates, which is one order closer. What rates
/// and polynomial differ by in each node shows a kink, whose errors may cancel in the
/// end.
inline void judge_halves(const std::array<Vec2, 2>& rates, DoubledStep& step) {
  constexpr double kWeight = 49.0 / 180.0;
  const std::array<Vec2, 2> lack{rates[0] - step.rate_at(kQuadratureNodes[0]),
                                 rates[1] - step.rate_at(kQuadratureNodes[1])};
  step.error = -kWeight * step.h * (lack[0] + lack[1]);
  step.defect = kWeight * step.h * (lack[0].cwiseAbs() + lack[1].cwiseAbs());
}

}  // namespace prehensile
