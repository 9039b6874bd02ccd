/// Root of a continuous function in a bracket, for the location of events.
#pragma once

#include <algorithm>
#include <limits>

namespace prehensile {

/// A point within `tolerance` of a sign change of f in [low, high], where f(low) = f_low
/// >= 0 > f_high = f(high). The contact mode changes with a kink at the root itself, so a
/// line is laid through the last two points of one side, where f is smooth; a bisection
/// follows whenever two such guesses have not halved the bracket.
template <class Function>
double falling_root(const Function& f, double low, double f_low, double high,
                    double f_high, double tolerance) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  struct Side {
    double x, value, x_before, value_before;
    double guess() const { return x - value * (x - x_before) / (value - value_before); }
  };
  Side left{low, f_low, kNone, kNone};
  Side right{high, f_high, kNone, kNone};
  bool left_moved = true;
  int slow = 0;
  while (right.x - left.x > tolerance) {
    const double width = right.x - left.x;
    const auto inside = [&](double x) { return x >= left.x && x <= right.x; };
    double x = (left_moved ? left : right).guess();
    if (!inside(x)) x = (left_moved ? right : left).guess();
    if (!inside(x)) x = left.x + width * left.value / (left.value - right.value);
    if (slow >= 2) x = left.x + 0.5 * width;
    // A guess at an end is moved inward, so that the bracket closes around it.
    x = std::clamp(x, left.x + 0.5 * tolerance, right.x - 0.5 * tolerance);
    const double value = f(x);
    left_moved = value >= 0.0;
    Side& moved = left_moved ? left : right;
    moved = {x, value, moved.x, moved.value};
    slow = right.x - left.x > 0.5 * width ? slow + 1 : 0;
  }
  return 0.5 * (left.x + right.x);
}

}  // namespace prehensile
