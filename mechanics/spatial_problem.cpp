#include "mechanics/spatial_problem.h"

namespace prehensile {

JawFreedoms jaw_freedoms(const SpatialProblem& problem) {
  const double N = problem.grip_force;
  JawFreedoms free;
  switch (problem.jaw_mode) {
    case JawMode::kCoupled:
      free.count = 1;
      free.jaw1[0] = 1.0;
      free.jaw2[0] = 1.0;
      free.effort[0] = 2.0 * N;
      break;
    case JawMode::kFixedJaw1:
      free.count = 1;
      free.jaw2[0] = 1.0;
      free.effort[0] = N;
      break;
    case JawMode::kFixedJaw2:
      free.count = 1;
      free.jaw1[0] = 1.0;
      free.effort[0] = N;
      break;
    case JawMode::kIndependent:
      free.count = 2;
      free.jaw1[0] = 1.0;
      free.jaw2[1] = 1.0;
      free.effort = {N, N};
      break;
    case JawMode::kLocked:
      break;
  }
  return free;
}

}  // namespace prehensile
