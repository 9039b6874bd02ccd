/// Constants that every layer uses.
#pragma once

#include <limits>
#include <numbers>

namespace prehensile {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace prehensile
