#include "planner/geometry/free_directions.h"

namespace prehensile {

FreeDirections FreeDirections::above(const std::array<double, kLookedAt>& values,
                                     double least) {
  std::array<bool, kLookedAt> free;
  for (int k = 0; k < kLookedAt; ++k) free[k] = values[k] >= least;
  return {free, [&](int k) {
            const double from = values[k] - least;
            return from / (from - (values[(k + 1) % kLookedAt] - least));
          }};
}

FreeDirections::Gap FreeDirections::widest_gap() const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (all_) return {};
  if (arcs_.empty()) return {0.0, kTurn};
  Gap widest;
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const bool is_last = i + 1 == arcs_.size();
    const double next = is_last ? arcs_[0].from + kTurn : arcs_[i + 1].from;
    const double width = next - arcs_[i].to;
    if (width > widest.width) widest = {arcs_[i].to, width};
  }
  return widest;
}

double FreeDirections::distance(double angle) const {
  if (all_) return 0.0;
  double least = std::numbers::pi;
  for (const Arc& arc : arcs_) {
    const double half = 0.5 * (arc.to - arc.from);
    const double off =
        std::abs(std::remainder(angle - arc.from - half, 2.0 * std::numbers::pi));
    least = std::min(least, off - half);
  }
  return std::max(0.0, least);
}

double FreeDirections::cheating(double angle, double freely) const {
  const double beyond = std::min(0.5 * std::numbers::pi, distance(angle) - freely);
  return beyond <= 1e-9 ? 0.0 : std::sin(beyond);
}

}  // namespace prehensile
