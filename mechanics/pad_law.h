/// Friction of a scene's pads in the pad plane by their own law: point by point, or, of
/// soft points, over the ellipsoid, which is theirs exactly (Model::has_soft_points).
///
/// `grasp` is that of the model at a pose (grasp_at); its bounds may have been scaled by
/// a common factor. Units, frames and errors are those of the functions that these choose
/// between. No heap.
#pragma once

#include "mechanics/contact_mode.h"
#include "mechanics/model.h"
#include "mechanics/planar_instant.h"

namespace prehensile {

/// solve_planar or solve_limit_surface.
PlanarInstant solve_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                               const PlanarDrive& drive,
                               const PlanarSolveOptions& options = {}) noexcept;

/// The worst entry of the certificate of such an answer.
double certify_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                          const PlanarDrive& drive, const PlanarInstant& answer) noexcept;

/// solve_planar_in_mode or solve_limit_surface_in_mode.
MotionInMode solve_in_mode_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                                      const PlanarDrive& drive,
                                      const ContactModeOfPush& mode) noexcept;

/// Whether the pads alone hold gravity: least slack of friction power over that of
/// gravity, in units of the friction force and the pads' lever; positive: held. `worst`
/// receives the twist.
double gravity_slack_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                                PlanarTwist* worst = nullptr) noexcept;

/// Power that friction takes in a twist of the object [W for a twist in m/s, rad/s].
double friction_power(const Model& model, const PlanarGrasp& grasp,
                      const PlanarTwist& V_HO) noexcept;

}  // namespace prehensile
