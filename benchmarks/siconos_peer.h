/// Siconos' frictional contact solvers on our instants, as a peer to measure against.
#pragma once

#include <array>

#include "benchmarks/natural_map.h"

namespace prehensile::benchmarks {

enum class SiconosSolver { kProx, kNsnFb, kNsnAc, kNsgs };
inline constexpr std::array kSiconosSolvers{SiconosSolver::kProx, SiconosSolver::kNsnFb,
                                            SiconosSolver::kNsnAc, SiconosSolver::kNsgs};
const char* name(SiconosSolver solver);

struct SiconosRun {
  SpatialAnswer answer;
  double time_us = 0.0;  ///< of the solver alone, without the assembly of its matrix
  int iterations = 0;
};

/// Runs one solver in a process of its own, because some of them do not always come back:
/// after `seconds` it is stopped and there is no answer. Needs inertia (its unknowns are
/// forces, and rates follow by its inverse) and hard points with friction.
SiconosRun solve_siconos(const SpatialProblem& problem, SiconosSolver solver,
                         int seconds);

bool siconos_is_built();

}  // namespace prehensile::benchmarks
