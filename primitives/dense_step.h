/// A step of an integrator for two coordinates, with its continuous extension. The
/// methods that fill it: dormand_prince.h, rosenbrock.h.
#pragma once

#include <array>

#include "scene/frames.h"

namespace prehensile {

struct DenseStep {
  double s = 0.0;             ///< where it starts
  double h = 0.0;             ///< its length
  Vec2 y, y_end;              ///< state at both ends
  Vec2 rate, rate_end;        ///< rate at both ends; rate_end starts the next step
  Vec2 error;                 ///< of the lower order of the pair, at the end
  Vec2 probe, probe_rate;     ///< a small change of y_end and what it does to the rate
  std::array<Vec2, 3> dense;  ///< coefficients of the continuous extension

  /// State at the share x in [0, 1] of the step.
  Vec2 at(double x) const {
    const double z = 1.0 - x;
    return y + x * (y_end - y + z * (dense[0] + x * (dense[1] + z * dense[2])));
  }

  /// Rate of the continuous extension in the middle of the step.
  Vec2 middle_rate() const { return (y_end - y + 0.25 * dense[1]) / h; }
};

}  // namespace prehensile
