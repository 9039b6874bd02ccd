#include "primitives/spread_interval.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

namespace {

/// All groups but one; `left_out` < 0: all.
std::vector<double> pooled(const std::vector<std::vector<double>>& groups, int left_out) {
  std::vector<double> out;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (static_cast<int>(g) == left_out) continue;
    out.insert(out.end(), groups[g].begin(), groups[g].end());
  }
  return out;
}

/// Mean share of each group that the factor of the others covers.
double coverage_of_new_groups(const std::vector<std::vector<double>>& groups,
                              double level) {
  double sum = 0.0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double factor = conformal_factor(pooled(groups, static_cast<int>(g)), level);
    const auto covered = std::count_if(groups[g].begin(), groups[g].end(),
                                       [&](double needed) { return needed <= factor; });
    sum += static_cast<double>(covered) / static_cast<double>(groups[g].size());
  }
  return sum / static_cast<double>(groups.size());
}

}  // namespace

double conformal_factor_of_groups(const std::vector<std::vector<double>>& needed,
                                  double level) {
  std::vector<std::vector<double>> groups;
  std::copy_if(needed.begin(), needed.end(), std::back_inserter(groups),
               [](const auto& group) { return !group.empty(); });
  double low = level;
  if (groups.size() >= 2 && coverage_of_new_groups(groups, low) < level) {
    double high = 1.0;
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (low + high);
      (coverage_of_new_groups(groups, middle) < level ? low : high) = middle;
    }
    low = high;
  }
  return conformal_factor(pooled(groups, -1), low);
}

}  // namespace prehensile
