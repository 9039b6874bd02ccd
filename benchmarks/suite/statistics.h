/// What may be said about shares and pairs of samples.
#pragma once

#include <vector>

namespace prehensile::suite {

/// The smallest value that at least `share` of the values do not exceed, 0 <= share <= 1.
/// NaN values are left out; without any value the answer is NaN.
double quantile(std::vector<double> values, double share);

/// Two-sided exact sign test: how likely pairs as lopsided as `wins` against `losses`
/// are if neither side is better, ties left out. Of binary outcomes it is McNemar's exact
/// test. 1 without any pair.
double sign_test(int wins, int losses);

/// p among many: the probability that any of `tests` tests
/// that find nothing gives this p or less (Sidak).
double for_many(double p, int tests);

}  // namespace prehensile::suite
