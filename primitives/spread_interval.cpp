#include "primitives/spread_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prehensile {

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at =
      std::clamp(share, 0.0, 1.0) * (static_cast<double>(sorted.size()) - 1);
  const std::size_t low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  const double rest = at - static_cast<double>(low);
  return (1.0 - rest) * sorted[low] + rest * sorted[high];
}

SpreadQuantiles spread_quantiles(const std::vector<double>& sorted, double level) {
  return {quantile(sorted, 0.5 - 0.5 * level), quantile(sorted, 0.5),
          quantile(sorted, 0.5 + 0.5 * level)};
}

SpreadInterval stated_interval(const SpreadQuantiles& spread, double floor,
                               double factor) {
  return {spread.middle - factor * std::hypot(spread.middle - spread.low, floor),
          spread.middle + factor * std::hypot(spread.high - spread.middle, floor)};
}

double factor_needed(const SpreadQuantiles& spread, double floor, double value) {
  const double off = std::abs(value - spread.middle);
  if (off == 0.0) return 0.0;
  const double side =
      value < spread.middle ? spread.middle - spread.low : spread.high - spread.middle;
  const double width = std::hypot(side, floor);
  return width > 0.0 ? off / width : std::numeric_limits<double>::infinity();
}

double conformal_factor(std::vector<double> needed, double level) {
  const double rank = std::ceil((static_cast<double>(needed.size()) + 1.0) * level);
  if (rank > static_cast<double>(needed.size())) {
    return std::numeric_limits<double>::infinity();
  }
  const auto at = std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(rank) - 1);
  std::nth_element(needed.begin(), needed.begin() + at, needed.end());
  return needed[static_cast<std::size_t>(at)];
}

}  // namespace prehensile
