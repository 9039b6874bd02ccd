/// One step of the Dormand-Prince pair of order 5(4) for two coordinates.
///
/// Sources: Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19-26; the state in the
/// middle: Shampine, Math. Comp. 46 (1986) 135-150.
#pragma once

#include <limits>

#include "primitives/integration_step.h"

namespace prehensile {

/// Fills `step` from step.s, step.h, step.y and step.rate. `rate(s, y, out)` returns
/// false where there is none; then the step is not valid and the result is that s,
/// otherwise infinity. The last call of `rate` is the one at the end of the step.
template <class Rate>
double dormand_prince(const Rate& rate, BaseStep& step) {
  const double s = step.s;
  const double h = step.h;
  const Vec2& y = step.y;
  const Vec2& k1 = step.rate;
  Vec2 k2, k3, k4, k5, k6, k7;
  const auto no_rate = [&](double c, const Vec2& slope, Vec2& k) {
    return !rate(s + c * h, Vec2(y + h * slope), k);
  };
  if (no_rate(1.0 / 5, k1 / 5, k2)) return s + h / 5;
  if (no_rate(3.0 / 10, 3.0 / 40 * k1 + 9.0 / 40 * k2, k3)) return s + 3 * h / 10;
  if (no_rate(4.0 / 5, 44.0 / 45 * k1 - 56.0 / 15 * k2 + 32.0 / 9 * k3, k4)) {
    return s + 4 * h / 5;
  }
  const Vec2 slope5 =
      19372.0 / 6561 * k1 - 25360.0 / 2187 * k2 + 64448.0 / 6561 * k3 - 212.0 / 729 * k4;
  if (no_rate(8.0 / 9, slope5, k5)) return s + 8 * h / 9;
  const Vec2 slope6 = 9017.0 / 3168 * k1 - 355.0 / 33 * k2 + 46732.0 / 5247 * k3 +
                      49.0 / 176 * k4 - 5103.0 / 18656 * k5;
  if (no_rate(1.0, slope6, k6)) return s + h;
  const Vec2 slope7 = 35.0 / 384 * k1 + 500.0 / 1113 * k3 + 125.0 / 192 * k4 -
                      2187.0 / 6784 * k5 + 11.0 / 84 * k6;
  step.ends = true;
  if (no_rate(1.0, slope7, k7)) return s + h;

  step.y_end = y + h * slope7;
  step.rate_end = k7;
  step.y_middle =
      y + 0.5 * h *
              (6025192743.0 / 30085553152.0 * k1 + 51252292925.0 / 65400821598.0 * k3 -
               2691868925.0 / 45128329728.0 * k4 + 187940372067.0 / 1594534317056.0 * k5 -
               1776094331.0 / 19743644256.0 * k6 + 11237099.0 / 235043384.0 * k7);
  step.error = h * (71.0 / 57600 * k1 - 71.0 / 16695 * k3 + 71.0 / 1920 * k4 -
                    17253.0 / 339200 * k5 + 22.0 / 525 * k6 - 1.0 / 40 * k7);
  step.probe = h * (slope7 - slope6);
  step.probe_rate = k7 - k6;
  return std::numeric_limits<double>::infinity();
}

}  // namespace prehensile
