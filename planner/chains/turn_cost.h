/// The shortest ways of pushes one after the other, by what they turn the object
/// together. Internal to the own planner.
///
/// T as a function of c dtheta is convex: the shortest way has one common kappa, clipped
/// to what each push allows (chain.h). So its points at given common kappas add up push
/// by push, without error; between them it is taken for straight, a little too long.
#pragma once

#include <array>
#include <cmath>

#include "mechanics/sticking.h"

namespace prehensile {

struct TurnCost {
  /// The common kappas; where pushes allow more than the last ones, no more is used.
  static constexpr int kCount = 7;
  static constexpr std::array<double, kCount> kKappas = {-30.0, -1.5, -0.5, 0.0,
                                                         0.5,   1.5,  30.0};
  static constexpr int kFree = 3;  ///< of these, where nothing asks for a turn

  std::array<float, kCount> turn{};    ///< [m] c dtheta, ascending
  std::array<float, kCount> travel{};  ///< [m] T

  float low() const { return turn.front(); }
  float high() const { return turn.back(); }

  /// Pushes, then others.
  TurnCost& operator+=(const TurnCost& other);

  /// Leaves the turns from `low` to `high` only; false if there are none.
  bool confine(float low, float high);

  /// From below, for a turn between low() and high() [m].
  double least_travel(double c_dtheta) const;
};

/// Of one push.
TurnCost turn_cost(double length, const KappaSet::Interval& kappas);

/// What a turn is worth where these common kappas are the shortest way: metres of travel
/// per metre of c dtheta, in (-1, 1).
inline const std::array<double, TurnCost::kCount> kTurnPrices = [] {
  std::array<double, TurnCost::kCount> prices{};
  for (int k = 0; k < TurnCost::kCount; ++k) {
    prices[k] = TurnCost::kKappas[k] / std::hypot(1.0, TurnCost::kKappas[k]);
  }
  return prices;
}();

}  // namespace prehensile
