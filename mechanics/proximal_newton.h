/// Proximal semismooth Newton in the object twist: solves an instant with inertia, and
/// any instant that the modes do not. Internal to the mechanics layer.
///
/// Every contact force is the projection of (force centre - rate / r) on its friction
/// set: a disc for a finger point, a cone for a pusher point. With the projections
/// inserted, the balance of wrenches is one equation in three unknowns,
///
///   M u - w_g - sum H' force(u) + e (u - u_before) = 0,
///
/// solved by Newton's method with the generalised Jacobian. Moving the force centres to
/// the forces found makes r vanish from the fixed point, so r may be large enough for
/// well conditioned steps; e > 0 is artificial inertia for hard instants. M is never
/// inverted.
#pragma once

#include <Eigen/Core>

#include "mechanics/pad_friction.h"

namespace prehensile {

struct NewtonAnswer {
  bool converged = false;
  PlanarTwist u = PlanarTwist::Zero();
  std::array<double, 2> normal{0.0, 0.0};
  std::array<double, 2> tangential{0.0, 0.0};
  std::array<Vec2, PlanarGrasp::kCapacity> finger;  ///< friction on the object
  double residual = kNan;  ///< natural map and balance, units of ScaledPush
  int steps = 0;
};

/// `M`: inertia in units of `push`, about its centre. `start`: first twist.
NewtonAnswer solve_proximal_newton(const PadFriction& pads, const ScaledPush& push,
                                   const Eigen::Matrix3d& M, const PlanarTwist& start,
                                   double tolerance, int max_steps) noexcept;

}  // namespace prehensile
