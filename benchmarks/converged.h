/// The answer next to a given one, in long double: who is right where two solvers differ?
#pragma once

#include "benchmarks/natural_map.h"

namespace prehensile::benchmarks {

struct ConvergedAnswer {
  SpatialAnswer answer;     ///< rounded to double; not given if Newton's method failed
  double residual = 0.0;    ///< of the natural map, in units, before rounding
  double least_gain = 0.0;  ///< see `converged_from`
};

/// Newton's method on balance and natural map (benchmarks/natural_map.h) from `start`, in
/// rates and forces together, until the residual is below 1e-16 units. It shares nothing
/// with a solver but the laws, and has no tolerance that one could choose in favour of
/// one of them. `least_gain` is the smallest singular value of the Jacobian there: an
/// answer with residual e is off by up to e / least_gain, whoever made it.
ConvergedAnswer converged_from(const SpatialProblem& problem, const SpatialScales& units,
                               const SpatialAnswer& start);

}  // namespace prehensile::benchmarks
