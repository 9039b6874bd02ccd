/// How well a share is known from a number of runs.
#pragma once

#include <algorithm>
#include <cmath>

namespace prehensile {

struct ShareInterval {
  double low = 0.0, high = 1.0;
};

/// Wilson's score interval of a share at 95 % confidence; [0, 1] without runs.
inline ShareInterval wilson(int hits, int runs) {
  if (runs <= 0) return {};
  constexpr double kZ = 1.959963984540054;  // 97.5 % of the normal distribution
  const double n = runs;
  const double p = hits / n;
  const double scale = 1.0 + kZ * kZ / n;
  const double centre = (p + kZ * kZ / (2.0 * n)) / scale;
  const double half = kZ / scale * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace prehensile
