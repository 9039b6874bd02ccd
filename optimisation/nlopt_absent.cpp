/// Stands in where NLopt was switched off at build time.
#include "optimisation/nonlinear_program.h"

namespace prehensile {

NlpResult minimise_nlopt(const NonlinearProgram& program, LocalMethod, const NlpOptions&,
                         double) {
  NlpResult result;
  result.status = NlpStatus::kNotBuilt;
  result.x = program.start;
  result.message = "built without NLopt";
  return result;
}

bool nlopt_is_built() { return false; }

}  // namespace prehensile
