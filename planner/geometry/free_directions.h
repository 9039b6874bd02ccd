/// Directions in which the finger axis can be moved at a place, for the finder of
/// barriers. Internal to the planner.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

inline Vec2 towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
inline double angle_of(const Vec2& way) { return std::atan2(way.y(), way.x()); }

class FreeDirections {
 public:
  /// Evenly spaced directions that are looked at, the first along x.
  static constexpr int kLookedAt = 72;
  static double direction(double k) { return 2.0 * std::numbers::pi * k / kLookedAt; }

  /// None.
  FreeDirections() = default;

  /// Those [rad] in which a test says so; where they begin and end is halved for.
  template <class Test>
  static FreeDirections where(const Test& is_free) {
    constexpr int kHalvings = 7;
    std::array<bool, kLookedAt> free;
    for (int k = 0; k < kLookedAt; ++k) free[k] = is_free(direction(k));
    return {free, [&](int k) {
              double low = 0.0;
              double high = 1.0;
              for (int i = 0; i < kHalvings; ++i) {
                const double middle = 0.5 * (low + high);
                (is_free(direction(k + middle)) == free[k] ? low : high) = middle;
              }
              return high;
            }};
  }

  /// Those with a value of at least `least`, which is linear between those looked at.
  static FreeDirections above(const std::array<double, kLookedAt>& values, double least);

  bool are_none() const { return !all_ && arcs_.empty(); }

  /// The widest range of directions of which none is free, counter-clockwise [rad]: all
  /// around where none is at all.
  struct Gap {
    double from = 0.0, width = 0.0;
  };
  Gap widest_gap() const;

  /// Angle of a direction to the next that is free [rad]; pi if none is.
  double distance(double angle) const;

  /// Sine of the angle of a direction to the next that is free, or `freely` beside one.
  double cheating(double angle, double freely) const;

 private:
  /// `turn(k)`: the share of the way from direction k to the next at which what is free
  /// begins or ends.
  template <class Turn>
  FreeDirections(const std::array<bool, kLookedAt>& free, const Turn& turn) {
    for (int k = 0; k < kLookedAt; ++k) {
      if (free[k] || !free[(k + 1) % kLookedAt]) continue;
      int end = k + 1;
      while (free[(end + 1) % kLookedAt]) ++end;
      arcs_.push_back({direction(k + turn(k)), direction(end + turn(end % kLookedAt))});
    }
    all_ = std::ranges::all_of(free, [](bool yes) { return yes; });
  }

  /// From an angle to another, counter-clockwise [rad].
  struct Arc {
    double from, to;
  };
  std::vector<Arc> arcs_;
  bool all_ = false;
};

/// Those at a place p_OF [m].
using FreeAt = std::function<FreeDirections(const Vec2&)>;

}  // namespace prehensile
