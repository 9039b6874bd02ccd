#include "mechanics/spatial_model.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

void add_pad(const Gripper& gripper, ContactBody body, double z, double compliance,
             const ContactPoints& points, SpatialProblem& problem) {
  ContactPatch& patch = problem.patch[problem.patch_count++];
  const bool is_jaw_1 = body == ContactBody::kJaw1;
  patch.body = body;
  patch.n = (is_jaw_1 ? 1.0 : -1.0) * Vec3::UnitZ();
  patch.t = Vec3::UnitX();
  patch.mu = gripper.friction[is_jaw_1 ? 0 : 1];
  patch.pressure = PressureLaw::kFoundation;
  patch.compliance = compliance;
  patch.first = problem.count;
  patch.count = points.count;
  for (int j = 0; j < points.count; ++j, ++problem.count) {
    problem.x[problem.count] = points.x[j];
    problem.y[problem.count] = points.y[j];
    problem.z[problem.count] = z;
    problem.preload[problem.count] = gripper.grip_force * points.weight[j];
  }
}

void add_pusher(const PlanarDrive& drive, double height, SpatialProblem& problem) {
  ContactPatch& patch = problem.patch[problem.patch_count++];
  patch.body = ContactBody::kPusher;
  patch.n << drive.n_H, 0.0;
  patch.t << drive.t_H(), 0.0;
  patch.mu = drive.mu;
  patch.pressure = PressureLaw::kFree;
  patch.first = problem.count;
  patch.count = drive.count;
  for (int i = 0; i < drive.count; ++i, ++problem.count) {
    problem.x[problem.count] = drive.p_HC[i].x();
    problem.y[problem.count] = drive.p_HC[i].y();
    problem.z[problem.count] = height;
    problem.preload[problem.count] = 0.0;
  }
}

/// Size of the pusher's motion at the middle of the contact [m/s].
double rate_of(const PlanarDrive& drive, double out_of_plane_rate) {
  const Vec2 middle = 0.5 * (drive.p_HC[0] + drive.p_HC[drive.count - 1]);
  return std::hypot(point_velocity(drive.V_HP, middle).norm(), out_of_plane_rate);
}

}  // namespace

SpatialProblem spatial_problem_at(const Model& model, const PushContact& contact,
                                  double place, const PlanarPose& X_HO,
                                  const PlanarTwist& V_HP,
                                  const OutOfPlane& out_of_plane) noexcept {
  SpatialProblem problem;
  const Gripper& gripper = model.scene.gripper;
  const ContactPoints points = model.region.at(X_HO);
  const PlanarDrive drive = drive_at(contact, place, X_HO, V_HP);
  if (points.count == 0 || 2 * points.count + drive.count > SpatialProblem::kMaxPoints) {
    return problem;
  }
  const double force = std::max(gripper.grip_force, model.mass * contact.g_O.norm()) *
                       std::max({1.0, gripper.friction[0], gripper.friction[1]});
  const double compliance = out_of_plane.compliance * rate_of(drive, out_of_plane.rate) /
                            (force > 0.0 ? force : 1.0);
  const double z = model.half_thickness;
  add_pad(gripper, ContactBody::kJaw1, -z, compliance, points, problem);
  add_pad(gripper, ContactBody::kJaw2, z, compliance, points, problem);
  add_pusher(drive, out_of_plane.height, problem);

  problem.jaw_mode = gripper.jaw_mode;
  problem.grip_force = gripper.grip_force;
  const Vec2 weight = model.mass * rotated(X_HO.theta, contact.g_O);
  const PlanarWrench w_g = wrench_of(transform(X_HO, model.p_OCom), weight);
  problem.w_g << w_g.head<2>(), 0.0, 0.0, 0.0, w_g[2];
  problem.V_HP << V_HP.head<2>(), out_of_plane.rate, 0.0, 0.0, V_HP[2];
  return problem;
}

}  // namespace prehensile
