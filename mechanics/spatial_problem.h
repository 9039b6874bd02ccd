/// The question that every spatial instant solver answers, and nothing else: patches of
/// contact points on two jaws and one pusher, the drive of the jaws, gravity, inertia,
/// and the motion of the pusher. Everything in H, about the origin of H.
///
/// Source: paper sections IV to VI, eq. (1) to (10).
#pragma once

#include <array>

#include <Eigen/Geometry>

#include "scene/frames.h"
#include "scene/scene.h"

namespace prehensile {

/// Twist (v, omega) [m/s, rad/s]: velocity of the body point that coincides with the
/// origin of H, and rate of turn; expressed in H. Accelerations from rest where the
/// problem has inertia.
using SpatialTwist = Eigen::Matrix<double, 6, 1>;

/// Wrench (f, m) [N, N m] about the origin of H, expressed in H.
using SpatialWrench = Eigen::Matrix<double, 6, 1>;

enum class ContactBody { kJaw1, kJaw2, kPusher };

/// Points of one flat contact: they share body, frame, friction and pressure law.
///
///   foundation  c_n + R (l_n - l_0) takes the place of c_n in unilateral contact
///   given       l_n = l_0 whatever happens
///   free        rigid, R = 0: as in the paper
struct ContactPatch {
  ContactBody body = ContactBody::kPusher;
  Vec3 n = Vec3::UnitX();  ///< unit normal, into the object
  Vec3 t = Vec3::UnitY();  ///< unit tangent; (n, t, o) is right-handed
  double mu = 0.0;         ///< >= 0; 0: frictionless
  PressureLaw pressure = PressureLaw::kFree;
  double compliance = 0.0;  ///< R [m/s / N], > 0 for kFoundation, else unused
  /// e [m] of a soft point: friction force and spin moment tau about n are bounded
  /// together, |l_t|^2 + (tau / e)^2 <= (mu l_n)^2. 0: points carry no moment.
  double spin_radius = 0.0;
  int first = 0;  ///< index of the patch's first point
  int count = 0;  ///< number of points, >= 1

  Vec3 o() const { return n.cross(t); }
};

struct SpatialProblem {
  static constexpr int kMaxPatches = 4;
  static constexpr int kMaxPoints = 136;

  int patch_count = 0;
  std::array<ContactPatch, kMaxPatches> patch;
  int count = 0;                           ///< points of all patches
  std::array<double, kMaxPoints> x, y, z;  ///< [m] in H
  std::array<double, kMaxPoints> preload;  ///< l_0 [N], >= 0; 0 for kFree

  JawMode jaw_mode = JawMode::kCoupled;
  double grip_force = 0.0;  ///< N [N] of each finger, >= 0

  SpatialWrench w_g = SpatialWrench::Zero();  ///< gravity
  SpatialTwist V_HP = SpatialTwist::Zero();   ///< of the pusher (or its acceleration)

  /// Inertia about the origin of H, and of each jaw; zero is the quasi-static limit, in
  /// which rates are velocities. Otherwise they are accelerations from rest.
  Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
  double jaw_mass = 0.0;  ///< [kg]

  Vec3 p_HC(int point) const { return {x[point], y[point], z[point]}; }
};

/// Freedoms of the jaws, at most two closing rates s [m/s]. Column i of `jaw1` and `jaw2`
/// is the rate at which that jaw moves along its own normal per unit of s_i; `effort` is
/// the force of the actuator on s_i [N].
///
///   coupled        s closes both jaws alike; their forces sum to twice the grip force
///   fixed jaw      s closes the other jaw, which presses with the grip force
///   independent    one s each, each presses with the grip force
///   locked         no freedom: both jaws stand still
struct JawFreedoms {
  int count = 0;
  std::array<double, 2> jaw1{0.0, 0.0};
  std::array<double, 2> jaw2{0.0, 0.0};
  std::array<double, 2> effort{0.0, 0.0};
};
JawFreedoms jaw_freedoms(const SpatialProblem& problem);

}  // namespace prehensile
