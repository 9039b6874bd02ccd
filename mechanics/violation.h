/// Folds over violations and slacks in which not-a-number stays: std::max and std::min
/// may drop it, and a check that drops it passes.
#pragma once

#include <cmath>
#include <initializer_list>

namespace prehensile {

/// The larger of two violations; not-a-number is the worst.
inline double worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }
inline double worst_of(std::initializer_list<double> violations) {
  double worst = 0.0;
  for (const double violation : violations) worst = worse(worst, violation);
  return worst;
}

/// The smaller of two slacks; not-a-number is the tightest.
inline double tighter(double a, double b) { return std::isnan(a) || a <= b ? a : b; }

}  // namespace prehensile
