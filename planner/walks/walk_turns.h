/// What the pushes of a walk turn the object by. Internal to the own planner.
#pragma once

#include <algorithm>
#include <cmath>

#include "planner/steering/confines.h"
#include "planner/walks/walk_lattice.h"

namespace prehensile {

/// c dtheta that a walk can have produced [m]; none where lo > hi.
struct Turned {
  double lo = 0.0, hi = 0.0;
};

/// After one more push; `window`: what limits leave of it [m].
inline Turned turned_after(const Turned& before, const WalkEdge& edge,
                           const TurnWindow& window) {
  return {std::max(before.lo + edge.lo, window.low),
          std::min(before.hi + edge.hi, window.high)};
}

/// What was produced before the last push of a walk that has `turned` in the end, of what
/// can be before and after that push: as deep in its range as `turned` is.
inline double turned_before(const Turned& before, const WalkEdge& edge,
                            const Turned& after, double turned) {
  const double share =
      after.hi > after.lo ? (turned - after.lo) / (after.hi - after.lo) : 0.5;
  const double low = std::max(before.lo, turned - edge.hi);
  const double high = std::max(low, std::min(before.hi, turned - edge.lo));
  return std::clamp(std::lerp(before.lo, before.hi, share), low, high);
}

}  // namespace prehensile
