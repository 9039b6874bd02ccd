/// The proximal semismooth Newton method for the spatial instant. Internal to the
/// mechanics layer.
#pragma once

#include "mechanics/proximal_iteration.h"
#include "mechanics/spatial_kernels.h"

namespace prehensile {

/// Where a run starts: rates and force centres, and how far it trusts them.
struct NewtonStart {
  SpatialRates v = SpatialRates::Zero();
  const SpatialForces* forces = nullptr;  ///< null: preloads, and no friction
  double r = 0.3;                         ///< first proximal step of the forces
  double e = 0.0;                         ///< first artificial inertia
  double pace = 1.0;                      ///< scales all proximal steps
  bool pads_only = false;                 ///< without the pusher
  double added_mass = 0.0;                ///< on every rate: lets an object fall
};

/// One run. `forces` receives the contact forces, `steps` counts up to `max_steps`.
NewtonResult run_newton(const ScaledSpatial& problem, const NewtonStart& start,
                        double tolerance, int max_steps, SpatialForces& forces,
                        int& steps) noexcept;

}  // namespace prehensile
