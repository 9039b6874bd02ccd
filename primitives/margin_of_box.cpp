#include <algorithm>
#include <cmath>
#include <limits>

#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

/// Ends of a parameter that cannot be negative.
struct Ends {
  double low, high;
};

Ends ends_of(const UncertaintyBox& box, Unknown unknown, double nominal) {
  const bool absolute = box.is_absolute[static_cast<std::size_t>(unknown)];
  const double width = box[unknown] * (absolute ? 1.0 : nominal);
  return {std::max(0.0, nominal - width), nominal + width};
}

/// Share by which a parameter may fall.
double share_lost(const Ends& ends, double nominal) {
  return nominal > 0.0 ? 1.0 - ends.low / nominal : 0.0;
}

double friction_force(const Scene& scene, double mu_1, double mu_2, double grip,
                      double mass) {
  Gripper gripper = scene.gripper;
  gripper.grip_force = grip;
  const std::array<double, 2> force = jaw_forces(gripper, mass * scene.g_Wz);
  return mu_1 * force[0] + mu_2 * force[1];
}

/// Greatest relative change of mass over friction force. It rises with the mass, and
/// falls with grip and finger friction, so the corners of the box decide.
double force_margin(const Model& model, const UncertaintyBox& box) {
  const Scene& scene = model.scene;
  const auto& mu = scene.gripper.friction;
  const Ends grip = ends_of(box, Unknown::kGripForce, scene.gripper.grip_force);
  const Ends mass = ends_of(box, Unknown::kMass, scene.object.mass);
  const Ends mu_1 = ends_of(box, Unknown::kFingerFriction, mu[0]);
  const Ends mu_2 = ends_of(box, Unknown::kFingerFriction, mu[1]);
  const double nominal = scene.object.mass / model.F;
  const double most =
      mass.high / friction_force(scene, mu_1.low, mu_2.low, grip.low, mass.high);
  const double least =
      mass.low / friction_force(scene, mu_1.high, mu_2.high, grip.high, mass.low);
  const bool is_bounded = std::isfinite(most) && std::isfinite(least);
  if (!is_bounded) return std::numeric_limits<double>::infinity();
  return std::max({0.0, most / nominal - 1.0, 1.0 - least / nominal});
}

constexpr double kTorqueRadiusOfSoftPoints = 0.20;

}  // namespace

Margin margin_of(const Model& model, const UncertaintyBox& box) {
  Margin margin = Margin::none();
  for (const Pusher& pusher : model.scene.pushers) {
    const Ends ends = ends_of(box, Unknown::kFriction, pusher.friction);
    margin.friction = std::max(margin.friction, share_lost(ends, pusher.friction));
  }
  margin.force = force_margin(model, box);
  const Ends radius = ends_of(box, Unknown::kTorqueRadius, model.c);
  margin.torque_radius = share_lost(radius, model.c);
  margin.place = box[Unknown::kPlace];
  margin.centre_of_mass =
      std::hypot(box[Unknown::kCentreOfMassX], box[Unknown::kCentreOfMassY]);
  margin.grasp = std::hypot(box[Unknown::kGraspX], box[Unknown::kGraspY]);
  margin.tilt = box[Unknown::kDirection] + box[Unknown::kTilt];
  return margin;
}

Margin usual_margin(const Model& model) {
  UncertaintyBox box = usual_box();
  if (model.has_soft_points()) box[Unknown::kTorqueRadius] = kTorqueRadiusOfSoftPoints;
  return margin_of(model, box);
}

}  // namespace prehensile
