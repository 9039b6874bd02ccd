#include "benchmarks/siconos_peer.h"

namespace prehensile::benchmarks {

const char* name(SiconosSolver) { return "siconos"; }

SiconosRun solve_siconos(const SpatialProblem&, SiconosSolver, int) { return {}; }

bool siconos_is_built() { return false; }

}  // namespace prehensile::benchmarks
