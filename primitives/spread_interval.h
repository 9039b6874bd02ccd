/// An honest interval from a spread: what a box of parameters gives, a floor, and a
/// factor that was learnt on measured pushes, because a box alone covers far less than it
/// says. The factor is that of split conformal prediction (Lei, G'Sell, Rinaldo,
/// Tibshirani, Wasserman, JASA 113, 2018).
#pragma once

#include <vector>

namespace prehensile {

/// Value below which a share of the sorted values lies, interpolated; NaN if empty.
double quantile(const std::vector<double>& sorted, double share);

/// Of a coordinate over the members of a box, against the nominal push, [m] or [rad].
struct SpreadQuantiles {
  double low = 0.0, middle = 0.0, high = 0.0;
};

/// Two-sided, of the middle share `level` of the values.
SpreadQuantiles spread_quantiles(const std::vector<double>& sorted, double level);

struct SpreadInterval {
  double low = 0.0, high = 0.0;
};

/// About the middle: the distance to each quantile, the floor (>= 0) in quadrature, times
/// the factor (>= 0).
SpreadInterval stated_interval(const SpreadQuantiles& spread, double floor,
                               double factor);

/// The least factor whose interval holds the value; infinite where none does.
double factor_needed(const SpreadQuantiles& spread, double floor, double value);

/// The factor that covers a further push like those of `needed` with at least this
/// probability: the ceil((n + 1) level)-th smallest; infinite if there are too few.
double conformal_factor(std::vector<double> needed, double level);

/// The same for a push of none of these groups (another object): pushes of one object are
/// more alike than those of two. The level is raised until, each group left out in turn,
/// the factor of the others covers this share of it on average; fewer than two groups
/// cannot tell, and are pooled.
double conformal_factor_of_groups(const std::vector<std::vector<double>>& needed,
                                  double level);

}  // namespace prehensile
