/// Plain integrators of a push by a point, to measure the transition function against:
/// fixed steps (Euler, Runge-Kutta 4) and adaptive ones without events, over the same
/// instants.
#pragma once

#include "primitives/transition.h"

namespace prehensile::benchmarks {

enum class Scheme {
  kEuler,
  kRungeKutta,         ///< the classical one of order 4
  kAdaptive,           ///< Dormand-Prince 5(4), blind to changes of contact mode
  kEulerLocated,       ///< as above, with the changes of contact mode located
  kRungeKuttaLocated,  ///< and the mode followed between them
};
const char* name(Scheme scheme);

struct PlainRun {
  bool completed = false;  ///< every instant had a motion
  PlanarPose end;
  int evaluations = 0;
  int events = 0;  ///< located
};

/// `steps` of equal length; for kAdaptive `tolerance` [m] instead. The contact must be a
/// point. Limits of the push (pads and pusher on the face) are not looked at.
PlainRun integrate_plainly(const Model& model, const Grasp& start, const LinearPush& push,
                           const TransitionOptions& options, Scheme scheme, int steps);

}  // namespace prehensile::benchmarks
