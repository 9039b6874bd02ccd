#include "plot/ticks.h"

#include <algorithm>
#include <cmath>

#include "plot/svg.h"

namespace prehensile::plot {
namespace {

constexpr double kMost = 1e300;
constexpr double kLeast = 1e-300;

/// Ranges narrower than this share of their values cannot be labelled.
constexpr double kNarrow = 1e-9;

/// The step, 1, 2 or 5 times a power of ten, of about `wanted` ticks: never so wide that
/// fewer than four are in the range, unless fewer are wanted.
double round_step(double width, int wanted) {
  const double step = width / wanted;
  const double most = width / std::min(wanted, 4);
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  double out = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (out >= step * (1.0 - 1e-9) || factor * power > most * (1.0 + 1e-9)) break;
    out = factor * power;
  }
  return out;
}

Ticks linear_ticks(const Range& range, int wanted) {
  Ticks out;
  const double step = round_step(range.high - range.low, wanted);
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  const int magnitude = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  if (magnitude >= 5 || magnitude <= -4) {
    out.exponent = 3 * static_cast<int>(std::floor(magnitude / 3.0));
  }
  const double unit = std::pow(10.0, -out.exponent);
  const int digits =
      std::clamp(-static_cast<int>(std::floor(std::log10(step * unit) + 1e-9)), 0, 12);
  const double first = std::ceil(range.low / step - 1e-9);
  for (int k = 0; k <= 4 * wanted; ++k) {
    const double value = (first + k) * step;
    if (value > range.high + 1e-9 * step) break;
    out.ticks.push_back({value, fixed(value * unit + 0.0, digits)});
  }
  return out;
}

/// Decades, with 2 and 5 between them where there is room, and minor ticks.
Ticks log_ticks(const Range& range, int wanted) {
  const double low = std::log10(range.low);
  const double high = std::log10(range.high);
  if (high - low < 1.0) {
    return linear_ticks({range.low, range.high, Scale::kLinear}, wanted);
  }
  Ticks out;
  const int stride = std::max(1, static_cast<int>(std::ceil((high - low) / wanted)));
  const bool between = high - low <= 3.0;
  const bool plain = low > -3.5 && high < 4.5;
  for (int decade = static_cast<int>(std::floor(low)); decade <= std::ceil(high);
       ++decade) {
    const double power = std::pow(10.0, decade);
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * power;
      if (value < range.low * (1.0 - 1e-9) || value > range.high * (1.0 + 1e-9)) continue;
      const bool labelled =
          digit == 1 ? decade % stride == 0 : between && (digit == 2 || digit == 5);
      if (!labelled && stride > 1 && digit != 1) continue;
      std::string label;
      if (labelled && (plain || between)) {
        label = plain ? fixed(value, std::max(0, -decade)) : shortest(value);
      } else if (labelled) {
        label = power_of_ten(decade);
      }
      out.ticks.push_back({value, std::move(label)});
    }
  }
  return out;
}

}  // namespace

bool drawable(double value, Scale scale) {
  if (!(std::abs(value) <= kMost)) return false;
  return scale == Scale::kLinear || value >= kLeast;
}

double Range::share(double value) const {
  if (scale == Scale::kLog) {
    return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
  }
  return (value - low) / (high - low);
}

double Range::value(double share) const {
  if (scale == Scale::kLog) {
    return std::exp(std::log(low) + share * (std::log(high) - std::log(low)));
  }
  return low + share * (high - low);
}

void RangeBuilder::add(double value) {
  if (!drawable(value, scale_)) return;
  low_ = any_ ? std::min(low_, value) : value;
  high_ = any_ ? std::max(high_, value) : value;
  any_ = true;
}

Range RangeBuilder::range(const AxisOptions& options, double padding) const {
  Range out{low_, high_, scale_};
  if (!any_) out = {scale_ == Scale::kLog ? 0.1 : 0.0, 1.0, scale_};
  const bool zero = options.from_zero && scale_ == Scale::kLinear;
  if (zero) {
    out.low = std::min(out.low, 0.0);
    out.high = std::max(out.high, 0.0);
  }
  const auto usable = [&](const std::optional<double>& end) {
    return end && drawable(*end, scale_);
  };
  const bool fixed_low = usable(options.low);
  const bool fixed_high = usable(options.high);
  if (fixed_low) out.low = *options.low;
  if (fixed_high) out.high = *options.high;
  if (out.low > out.high) std::swap(out.low, out.high);
  const double largest = std::max(std::abs(out.low), std::abs(out.high));
  if (scale_ == Scale::kLog) {
    if (out.high <= out.low * (1.0 + kNarrow)) {
      out = {std::max(kLeast, 0.5 * out.low), std::min(kMost, 2.0 * out.high), scale_};
    }
    const double factor = std::exp(padding * (std::log(out.high) - std::log(out.low)));
    if (!fixed_low) out.low = std::max(kLeast, out.low / factor);
    if (!fixed_high) out.high = std::min(kMost, out.high * factor);
    return out;
  }
  if (!(out.high - out.low > std::max(kLeast, kNarrow * largest))) {
    const double widening = largest > kLeast ? 0.1 * largest : 1.0;
    return {out.low - widening, out.high + widening, scale_};
  }
  const double space = padding * (out.high - out.low);
  if (!fixed_low && !(zero && out.low == 0.0)) out.low -= space;
  if (!fixed_high && !(zero && out.high == 0.0)) out.high += space;
  return out;
}

Ticks ticks_of(const Range& range, int wanted) {
  return range.scale == Scale::kLog ? log_ticks(range, wanted)
                                    : linear_ticks(range, wanted);
}

Ticks ticks_of(const Range& range, const std::vector<std::string>& names) {
  Ticks out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto value = static_cast<double>(i);
    if (value >= range.low && value <= range.high) out.ticks.push_back({value, names[i]});
  }
  return out;
}

std::string power_of_ten(int exponent) {
  static constexpr const char* kSuperior[] = {"⁰", "¹", "²", "³", "⁴",
                                              "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string digits;
  int rest = std::abs(exponent);
  do {
    digits.insert(0, kSuperior[rest % 10]);
    rest /= 10;
  } while (rest > 0);
  std::string out = "10";
  if (exponent < 0) out += "⁻";
  return out + digits;
}

}  // namespace prehensile::plot
