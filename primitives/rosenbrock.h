/// One step of the Rosenbrock method RODAS of order 4(3), for two coordinates: stiffly
/// accurate and L-stable, so a state that swings quickly to where it trails costs no
/// short steps.
///
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.7 and IV.10.
#pragma once

#include <limits>

#include <Eigen/LU>

#include "primitives/integration_step.h"

namespace prehensile {

/// Derivatives of the rate at the start of a step.
struct RateDerivatives {
  Eigen::Matrix2d by_state = Eigen::Matrix2d::Zero();
  Vec2 by_s = Vec2::Zero();
};

/// Fills `step` from step.s, step.h, step.y and step.rate; `rate` and the result as for
/// dormand_prince. The last call of `rate` is the one at the end of the step.
template <class Rate>
double rosenbrock(const Rate& rate, const RateDerivatives& derivatives, BaseStep& step) {
  constexpr double kGamma = 0.25;
  const double s = step.s;
  const double h = step.h;
  const Vec2& y = step.y;
  const Eigen::Matrix2d inverse =
      (Eigen::Matrix2d::Identity() / (h * kGamma) - derivatives.by_state).inverse();
  const Vec2 f_s = h * derivatives.by_s;
  Vec2 f;
  const Vec2 u1 = inverse * (step.rate + 0.25 * f_s);
  if (!rate(s + 0.386 * h, Vec2(y + 1.544 * u1), f)) return s + 0.386 * h;
  const Vec2 u2 = inverse * (f - 0.1043 * f_s - 5.6688 / h * u1);
  if (!rate(s + 0.21 * h, Vec2(y + 0.9466785280815826 * u1 + 0.2557011698983284 * u2),
            f)) {
    return s + 0.21 * h;
  }
  const Vec2 u3 = inverse * (f + 0.1035 * f_s -
                             (2.430093356833875 * u1 + 0.2063599157091915 * u2) / h);
  const Vec2 y4 =
      y + 3.314825187068521 * u1 + 2.896124015972201 * u2 + 0.9986419139977817 * u3;
  if (!rate(s + 0.63 * h, y4, f)) return s + 0.63 * h;
  const Vec2 u4 =
      inverse *
      (f - 0.0362 * f_s -
       (0.1073529058151375 * u1 + 9.594562251023355 * u2 + 20.47028614809616 * u3) / h);
  const Vec2 y5 = y + 1.221224509226641 * u1 + 6.019134481288629 * u2 +
                  12.53708332932087 * u3 - 0.687886036105895 * u4;
  if (!rate(s + h, y5, f)) return s + h;
  const Vec2 u5 = inverse * (f + (7.496443313967647 * u1 - 10.24680431464352 * u2 -
                                  33.99990352819905 * u3 + 11.7089089320616 * u4) /
                                     h);
  const Vec2 y6 = y5 + u5;
  if (!rate(s + h, y6, f)) return s + h;
  const Vec2 u6 = inverse * (f + (8.083246795921522 * u1 - 7.981132988064893 * u2 -
                                  31.52159432874371 * u3 + 16.31930543123136 * u4 -
                                  6.058818238834054 * u5) /
                                     h);
  step.y_end = y6 + u6;
  step.ends = true;
  if (!rate(s + h, step.y_end, step.rate_end)) return s + h;
  step.error = u6;
  step.probe = u6;
  step.probe_rate = step.rate_end - f;
  return std::numeric_limits<double>::infinity();
}

}  // namespace prehensile
