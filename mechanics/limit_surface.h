/// The closed-form limit surface of an isotropic grasp: the ellipsoid
/// (|f| / F)^2 + (m / (F c))^2 = 1 about the finger axis, and the instant over it.
///
/// Source: Howe and Cutkosky 1996; Chavan-Dafle, Holladay and Rodriguez 2018. An
/// approximation of a real pad (uniform disc: c = 2/3 r, up to 7 % strong); exact for the
/// published problem family.
#pragma once

#include "mechanics/instant.h"

namespace prehensile {

/// Isotropic grasp: F [N] largest friction force of both pads, c [m] torque radius, so
/// the largest torque is F c.
struct LimitSurface {
  double F = 0.0;
  double c = 0.0;

  /// Friction wrench on the object that moves with twist V (any scale, not zero).
  PlanarWrench friction(const PlanarTwist& V) const noexcept;

  /// Twist direction (p.V = dissipation >= 0) of a sliding friction wrench w on the
  /// surface.
  PlanarTwist sliding_twist(const PlanarWrench& friction) const noexcept;

  /// sqrt((|f|/F)^2 + (m/(F c))^2): below 1 the grasp can balance w.
  double load(const PlanarWrench& w) const noexcept;
};

/// The instant over a limit surface, point or line pusher, gravity w_g about the origin
/// of H. Quasi-static. finger_count of the answer is 0; the status is never out of
/// iterations. No heap. A fraction of a microsecond (docs/benchmarks.md).
PlanarInstant solve_limit_surface(const LimitSurface& surface, const PlanarWrench& w_g,
                                  const PlanarDrive& drive) noexcept;

/// The certificate of such an answer and of what its status claims, derived independently
/// of its solver: forces in units of the surface or of gravity, whichever is larger. NaN
/// for an answer without claim, or without sense.
double limit_surface_residual(const LimitSurface& surface, const PlanarWrench& w_g,
                              const PlanarDrive& drive,
                              const PlanarInstant& answer) noexcept;

}  // namespace prehensile
