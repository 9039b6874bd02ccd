/// Where an axis has its ticks and what they say. Internal to the plot layer.
#pragma once

#include <string>
#include <vector>

#include "plot/chart.h"

namespace prehensile::plot {

/// Values that a chart draws: finite, within +-1e300, and positive on a logarithmic axis.
bool drawable(double value, Scale scale);

/// The range of an axis, low < high, both drawable, wide enough to tell its ends apart.
struct Range {
  double low = 0.0;
  double high = 1.0;
  Scale scale = Scale::kLinear;

  /// Share of the way from low to high; finite for drawable values.
  double share(double value) const;

  /// The value at a share.
  double value(double share) const;
};

/// Collects data and settles on a range.
class RangeBuilder {
 public:
  explicit RangeBuilder(Scale scale) : scale_(scale) {}
  void add(double value);
  bool empty() const { return !any_; }

  /// With the ends that the options fix; `padding` [share] of empty space at free ends.
  Range range(const AxisOptions& options, double padding) const;

 private:
  Scale scale_;
  bool any_ = false;
  double low_ = 0.0;
  double high_ = 0.0;
};

struct Tick {
  double value = 0.0;
  std::string label;  ///< empty: a minor tick
};

struct Ticks {
  std::vector<Tick> ticks;
  int exponent = 0;  ///< the labels are to be multiplied by ten to this power
};

/// About `wanted` >= 2 labelled ticks inside the range, at round numbers.
Ticks ticks_of(const Range& range, int wanted);

/// One labelled tick at each of 0, 1, 2, ... that lies inside the range.
Ticks ticks_of(const Range& range, const std::vector<std::string>& names);

/// "x10" with the exponent in superior figures; UTF-8.
std::string power_of_ten(int exponent);

}  // namespace prehensile::plot
