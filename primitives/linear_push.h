/// Follows a linear push from its start to its end or to the event that ends it: the
/// object rides on a pusher that sticks to a whole face, and is integrated otherwise.
#pragma once

#include <limits>

#include "primitives/transition.h"

namespace prehensile {

/// How far the object may stray before a named primitive counts as left.
struct Guard {
  double angle = std::numeric_limits<double>::infinity();     ///< [rad] of O in H
  double distance = std::numeric_limits<double>::infinity();  ///< [m] of F in O
};

/// Whether the instants of this push are spatial.
bool is_in_space(const Model& model, const LinearPush& push,
                 const TransitionOptions& options) noexcept;

/// The push must be one that `apply` does not refuse; see there.
Transition follow(const Model& model, const Grasp& start, const LinearPush& push,
                  const Guard& guard, const TransitionOptions& options,
                  std::vector<Sample>* trace) noexcept;

}  // namespace prehensile
