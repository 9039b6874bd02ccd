/// Frames, planar poses, twists and wrenches.
///
/// Frame letters: W world (fixed to the pushers), H hand, O object, P pusher, C contact,
/// F finger axis (the origin of H seen from another frame). H: z is the closing
/// direction from jaw 1 to jaw 2; x and y span the pad plane. Everything here lives in
/// that plane; angles turn about +z. SI units, radians.
///
/// Monogram names: X_HO is the pose of O in H, p_OF is the position of F from O in O,
/// V_HO is the twist of O relative to H. A product is right when adjacent letters cancel.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace prehensile {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// Twist (v_x, v_y, omega) [m/s, m/s, rad/s]: velocity of the body point that coincides
/// with the origin of H, and rate of turn; expressed in H.
using PlanarTwist = Eigen::Vector3d;

/// Wrench (f_x, f_y, m_z) [N, N, N m] about the origin of H, expressed in H.
using PlanarWrench = Eigen::Vector3d;

/// Pose of one planar frame in another, for example X_HO: (x, y) [m], theta [rad].
struct PlanarPose {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;

  friend bool operator==(const PlanarPose&, const PlanarPose&) = default;
};

/// Quarter turn counter-clockwise: perp(x axis) = y axis.
inline Vec2 perp(const Vec2& v) { return {-v.y(), v.x()}; }

/// Moment about +z of a force f that acts at r.
inline double cross(const Vec2& r, const Vec2& f) {
  return r.x() * f.y() - r.y() * f.x();
}

inline Vec2 rotated(double angle, const Vec2& v) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

inline Vec2 translation(const PlanarPose& X_AB) { return {X_AB.x, X_AB.y}; }

/// Point fixed in B, seen from A: X_AB * p_B.
inline Vec2 transform(const PlanarPose& X_AB, const Vec2& p_B) {
  return translation(X_AB) + rotated(X_AB.theta, p_B);
}

/// X_AC = X_AB * X_BC; angles add without wrapping.
inline PlanarPose compose(const PlanarPose& X_AB, const PlanarPose& X_BC) {
  const Vec2 p = transform(X_AB, translation(X_BC));
  return {p.x(), p.y(), X_AB.theta + X_BC.theta};
}

inline PlanarPose inverse(const PlanarPose& X_AB) {
  const Vec2 p = -rotated(-X_AB.theta, translation(X_AB));
  return {p.x(), p.y(), -X_AB.theta};
}

/// Place of the finger axis in the object, p_OF. With theta it is the planner's state.
inline Vec2 finger_in_object(const PlanarPose& X_HO) {
  return translation(inverse(X_HO));
}

/// X_HO from the place of the finger axis in the object and the angle of O in H.
inline PlanarPose pose_from_finger(const Vec2& p_OF, double theta) {
  const Vec2 p = -rotated(theta, p_OF);
  return {p.x(), p.y(), theta};
}

/// Velocity of the body point at p (from the origin of H, in H).
inline Vec2 point_velocity(const PlanarTwist& V, const Vec2& p) {
  return {V[0] - V[2] * p.y(), V[1] + V[2] * p.x()};
}

/// Wrench of a force f that acts at p, both in H.
inline PlanarWrench wrench_of(const Vec2& p, const Vec2& f) {
  return {f.x(), f.y(), cross(p, f)};
}

/// The angle in (-pi, pi] that differs from `angle` by whole turns.
double wrapped(double angle);

}  // namespace prehensile
