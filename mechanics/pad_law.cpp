#include "mechanics/pad_law.h"

#include <cmath>

#include "mechanics/certificate.h"

namespace prehensile {
namespace {

LimitSurface surface_of(const Model& model, const PlanarGrasp& grasp) {
  return {grasp.capacity(), model.c};
}

}  // namespace

PlanarInstant solve_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                               const PlanarDrive& drive,
                               const PlanarSolveOptions& options) noexcept {
  return model.has_soft_points()
             ? solve_limit_surface(surface_of(model, grasp), grasp.w_g, drive)
             : solve_planar(grasp, drive, options);
}

double certify_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                          const PlanarDrive& drive,
                          const PlanarInstant& answer) noexcept {
  return model.has_soft_points()
             ? limit_surface_residual(surface_of(model, grasp), grasp.w_g, drive, answer)
             : certify(grasp, drive, answer).worst;
}

MotionInMode solve_in_mode_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                                      const PlanarDrive& drive,
                                      const ContactModeOfPush& mode) noexcept {
  return model.has_soft_points() ? solve_limit_surface_in_mode(surface_of(model, grasp),
                                                               grasp.w_g, drive, mode)
                                 : solve_planar_in_mode(grasp, drive, mode);
}

double gravity_slack_by_pad_law(const Model& model, const PlanarGrasp& grasp,
                                PlanarTwist* worst) noexcept {
  if (!model.has_soft_points()) return gravity_slack(grasp, worst);
  // Friction takes F |V| of a twist whose rotation counts with c, gravity gives w_g.V:
  // least where V points along w_g in these units.
  const LimitSurface surface = surface_of(model, grasp);
  if (worst) *worst = surface.sliding_twist(-grasp.w_g);
  return 1.0 - surface.load(grasp.w_g);
}

double friction_power(const Model& model, const PlanarGrasp& grasp,
                      const PlanarTwist& V_HO) noexcept {
  if (model.has_soft_points()) {
    return grasp.capacity() * std::hypot(V_HO[0], V_HO[1], model.c * V_HO[2]);
  }
  double power = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    power += grasp.bound[j] * point_velocity(V_HO, {grasp.x[j], grasp.y[j]}).norm();
  }
  return power;
}

}  // namespace prehensile
