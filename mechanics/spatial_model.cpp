#include "mechanics/spatial_model.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

/// Opens a patch at the end of the problem.
ContactPatch& add_patch(ContactBody body, SpatialProblem& problem) {
  ContactPatch& patch = problem.patch[problem.patch_count++];
  patch.body = body;
  patch.first = problem.count;
  return patch;
}

void add_point(const Vec3& p, double preload, SpatialProblem& problem) {
  problem.x[problem.count] = p.x();
  problem.y[problem.count] = p.y();
  problem.z[problem.count] = p.z();
  problem.preload[problem.count] = preload;
  ++problem.count;
  ++problem.patch[problem.patch_count - 1].count;
}

void add_pad(const Model& model, ContactBody body, PressureLaw law, double compliance,
             const ContactPoints& points, SpatialProblem& problem) {
  const Gripper& gripper = model.scene.gripper;
  const bool is_jaw_1 = body == ContactBody::kJaw1;
  const double z = (is_jaw_1 ? -1.0 : 1.0) * model.half_thickness;
  const double force = model.jaw_force[is_jaw_1 ? 0 : 1];
  const auto* point = std::get_if<PointPad>(&gripper.pad);
  ContactPatch& patch = add_patch(body, problem);
  patch.n = (is_jaw_1 ? 1.0 : -1.0) * Vec3::UnitZ();
  patch.t = Vec3::UnitX();
  patch.mu = gripper.friction[is_jaw_1 ? 0 : 1];
  patch.pressure = law;
  patch.compliance = patch.pressure == PressureLaw::kFoundation ? compliance : 0.0;
  patch.spin_radius = point ? point->spin_radius.value_or(0.0) : 0.0;
  const double known = patch.pressure == PressureLaw::kFree ? 0.0 : force;
  if (point) {
    add_point({0.0, 0.0, z}, known, problem);
    return;
  }
  for (int j = 0; j < points.count; ++j) {
    add_point({points.x[j], points.y[j], z}, known * points.weight[j], problem);
  }
}

/// A feature touches by its vertices, which span its support (paper section IV-D). Four
/// share a load that three would determine, so they rest on a foundation.
void add_pusher(const PlanarDrive& drive, double z_low, double z_high, double compliance,
                SpatialProblem& problem) {
  const int across = z_high > z_low ? 2 : 1;
  ContactPatch& patch = add_patch(ContactBody::kPusher, problem);
  patch.n << drive.n_H, 0.0;
  patch.t << drive.t_H(), 0.0;
  patch.mu = drive.mu;
  patch.pressure =
      drive.count * across > 2 ? PressureLaw::kFoundation : PressureLaw::kFree;
  patch.compliance = patch.pressure == PressureLaw::kFoundation ? compliance : 0.0;
  for (int i = 0; i < drive.count; ++i) {
    const Vec2& p = drive.p_HC[i];
    add_point({p.x(), p.y(), z_low}, 0.0, problem);
    if (across == 2) add_point({p.x(), p.y(), z_high}, 0.0, problem);
  }
}

/// Size of the pusher's motion at the middle of the contact [m/s].
double rate_at(const Vec3& p, const SpatialTwist& V) {
  return (V.head<3>() + V.tail<3>().cross(p)).norm();
}

Eigen::Matrix3d cross_matrix(const Vec3& p) {
  Eigen::Matrix3d m;
  m << 0.0, -p.z(), p.y(), p.z(), 0.0, -p.x(), -p.y(), p.x(), 0.0;
  return m;
}

/// Generalised inertia about the origin of H.
Eigen::Matrix<double, 6, 6> inertia_at(const Model& model, const PlanarPose& X_HO,
                                       const Vec3& p_HCom) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(X_HO.theta, Vec3::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d c = cross_matrix(p_HCom);
  const double m = model.mass;
  Eigen::Matrix<double, 6, 6> inertia;
  inertia << m * Eigen::Matrix3d::Identity(), -m * c,  //
      m * c, R * model.inertia_O * R.transpose() - m * c * c;
  return inertia;
}

SpatialProblem problem_at(const Model& model, const PushContact& contact,
                          const PlanarDrive& drive, const PlanarPose& X_HO,
                          const Vec2& g_O, const SpatialTwist& V_HP,
                          const SpatialQuestionOptions& options) {
  SpatialProblem problem;
  const Gripper& gripper = model.scene.gripper;
  const ContactPoints points = model.region.at(X_HO);
  const bool is_carried = model.jaw_force[0] + model.jaw_force[1] > 0.0 ||
                          (gripper.grip_force == 0.0 && model.scene.g_Wz == 0.0);
  if (points.count == 0 || !is_carried ||
      2 * points.count + 2 * drive.count > SpatialProblem::kMaxPoints) {
    return problem;
  }
  const Face& face = model.faces[contact.face];
  const double middle = 0.5 * (contact.z_low + contact.z_high);
  const double shift = options.height ? *options.height - middle : 0.0;
  const double z_low = std::clamp(contact.z_low + shift, face.z_low, face.z_high);
  const double z_high = std::clamp(contact.z_high + shift, face.z_low, face.z_high);

  const Vec2 touch = 0.5 * (drive.p_HC[0] + drive.p_HC[drive.count - 1]);
  double rate = rate_at({touch.x(), touch.y(), 0.5 * (z_low + z_high)}, V_HP);
  // A line that turns about its middle moves at its ends.
  for (int i = 0; i < drive.count; ++i) {
    const Vec2& end = drive.p_HC[i];
    rate = std::max(rate, 1e-3 * rate_at({end.x(), end.y(), z_low}, V_HP));
  }
  const double g_z = model.scene.g_Wz;
  const double weight = model.mass * std::hypot(g_O.norm(), g_z);
  const double force = std::max(gripper.grip_force, weight) *
                       std::max({1.0, gripper.friction[0], gripper.friction[1]});
  const double compliance =
      gripper.pressure.compliance * rate / (force > 0.0 ? force : 1.0);
  const bool follows =
      options.follow_free_pressure && gripper.pressure.law == PressureLaw::kFree;
  const PressureLaw law = follows ? PressureLaw::kFoundation : gripper.pressure.law;
  add_pad(model, ContactBody::kJaw1, law, compliance, points, problem);
  add_pad(model, ContactBody::kJaw2, law, compliance, points, problem);
  add_pusher(drive, z_low, z_high, compliance, problem);

  problem.jaw_mode = gripper.jaw_mode;
  problem.grip_force = gripper.grip_force;
  const Vec2 p = transform(X_HO, model.p_OCom);
  const Vec2 g_H = rotated(X_HO.theta, g_O);
  const Vec3 p_HCom(p.x(), p.y(), model.z_OCom);
  const Vec3 f = model.mass * Vec3(g_H.x(), g_H.y(), g_z);
  problem.w_g << f, p_HCom.cross(f);
  problem.V_HP = V_HP;
  if (options.from_rest) problem.inertia = inertia_at(model, X_HO, p_HCom);
  return problem;
}

}  // namespace

SpatialTwist in_space(const PlanarTwist& V) {
  SpatialTwist spatial;
  spatial << V[0], V[1], 0.0, 0.0, 0.0, V[2];
  return spatial;
}

PlanarTwist in_pad_plane(const SpatialTwist& V) { return {V[0], V[1], V[5]}; }

bool lies_in_pad_plane(const SpatialTwist& V) {
  return V[2] == 0.0 && V[3] == 0.0 && V[4] == 0.0;
}

SpatialProblem spatial_problem_at(const Model& model, const PushContact& contact,
                                  double place, const PlanarPose& X_HO,
                                  const SpatialTwist& V_HP,
                                  const SpatialQuestionOptions& options) noexcept {
  const PlanarDrive drive = drive_at(contact, place, X_HO, in_pad_plane(V_HP));
  return problem_at(model, contact, drive, X_HO, contact.g_O, V_HP, options);
}

SpatialProblem spatial_problem_at(const Model& model, const PushContact& contact,
                                  const PlanarDrive& drive, const PlanarPose& X_HO,
                                  const Vec2& g_O,
                                  const SpatialQuestionOptions& options) noexcept {
  return problem_at(model, contact, drive, X_HO, g_O, in_space(drive.V_HP), options);
}

}  // namespace prehensile
