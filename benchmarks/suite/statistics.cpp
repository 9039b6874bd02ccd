#include "benchmarks/suite/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prehensile::suite {

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto index = static_cast<std::ptrdiff_t>(std::max(1.0, rank)) - 1;
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

double sign_test(int wins, int losses) {
  const int n = wins + losses;
  if (n == 0) return 1.0;
  // Sum of the smaller tail, each term from logarithms of factorials.
  double tail = 0.0;
  for (int k = 0; k <= std::min(wins, losses); ++k) {
    tail += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) -
                     std::lgamma(n - k + 1.0) - n * std::log(2.0));
  }
  return std::min(1.0, 2.0 * tail);
}

double for_many(double p, int tests) {
  return -std::expm1(tests * std::log1p(-std::min(p, 1.0)));
}

}  // namespace prehensile::suite
