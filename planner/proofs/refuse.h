/// Finds reasons why no plan can exist.
#pragma once

#include <functional>

#include "planner/planner.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// How far the friction of an isotropic pad's quadrature may point from its motion [rad].
inline constexpr double kIsotropyError = 0.01;

/// A proof that `verify` accepts, or kind kNone: those that cost microseconds, and among
/// obstacles milliseconds.
Proof find_proof(const Model& model);

/// The same by a barrier (barrier.h), which takes some tens of milliseconds, or seconds
/// where the face clips discs. Given up when `stopped` says so.
Proof find_barrier_proof(const Model& model, const std::function<bool()>& stopped = {});

/// The same if `options` ask for it, within their time limit.
Proof look_for_barrier(const Model& model, const PlanOptions& options, const Work& work);

}  // namespace prehensile
