/// Stands in where Ipopt was switched off at build time.
#include "optimisation/nonlinear_program.h"

namespace prehensile {

NlpResult minimise_ipopt(const NonlinearProgram& program, const NlpOptions&) {
  NlpResult result;
  result.status = NlpStatus::kNotBuilt;
  result.x = program.start;
  result.message = "built without Ipopt";
  return result;
}

bool ipopt_is_built() { return false; }

}  // namespace prehensile
