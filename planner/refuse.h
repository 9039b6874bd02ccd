/// Finds reasons why no plan can exist.
#pragma once

#include "planner/plan.h"

namespace prehensile {

/// How far the friction of an isotropic pad's quadrature may point from its motion [rad].
inline constexpr double kIsotropyError = 0.01;

/// A proof that `verify` accepts, or kind kNone.
Proof find_proof(const Model& model);

}  // namespace prehensile
