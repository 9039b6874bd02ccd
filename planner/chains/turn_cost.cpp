#include "planner/chains/turn_cost.h"

#include <algorithm>

namespace prehensile {

TurnCost turn_cost(double length, const KappaSet::Interval& kappas) {
  TurnCost cost;
  for (int k = 0; k < TurnCost::kCount; ++k) {
    const double kappa = std::clamp(TurnCost::kKappas[k], kappas.lo, kappas.hi);
    cost.turn[k] = static_cast<float>(length * kappa);
    cost.travel[k] = static_cast<float>(length * std::sqrt(1.0 + kappa * kappa));
  }
  return cost;
}

TurnCost& TurnCost::operator+=(const TurnCost& other) {
  for (int k = 0; k < kCount; ++k) {
    turn[k] += other.turn[k];
    travel[k] += other.travel[k];
  }
  return *this;
}

bool TurnCost::confine(float low, float high) {
  low = std::max(low, this->low());
  high = std::min(high, this->high());
  if (low > high) return false;
  if (low == this->low() && high == this->high()) return true;
  const TurnCost all = *this;
  for (int k = 0; k < kCount; ++k) {
    const float at = std::clamp(all.turn[k], low, high);
    if (at == all.turn[k]) continue;
    const int next = static_cast<int>(
        std::lower_bound(all.turn.begin(), all.turn.end(), at) - all.turn.begin());
    const int before = std::max(next - 1, 0);
    const float width = all.turn[next] - all.turn[before];
    const float share = width > 0.0F ? (at - all.turn[before]) / width : 0.0F;
    turn[k] = at;
    travel[k] = all.travel[before] + share * (all.travel[next] - all.travel[before]);
  }
  return true;
}

double TurnCost::least_travel(double c_dtheta) const {
  double least = 0.0;
  for (int k = 0; k < kCount; ++k) {
    least = std::max(least, travel[k] + kTurnPrices[k] * (c_dtheta - turn[k]));
  }
  return least;
}

}  // namespace prehensile
