/// Grasps and drives that the tests of the instant solvers share.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "mechanics/certificate.h"
#include "mechanics/planar_problem.h"

namespace prehensile::testing {

inline PlanarGrasp grasp_of(std::initializer_list<Vec2> points, double capacity) {
  PlanarGrasp grasp;
  for (const Vec2& p : points) {
    grasp.x[grasp.count] = p.x();
    grasp.y[grasp.count] = p.y();
    grasp.bound[grasp.count] = capacity / static_cast<double>(points.size());
    ++grasp.count;
  }
  return grasp;
}

/// Sunflower points of equal weight on a disc about the origin of H.
inline PlanarGrasp disc_grasp(int points, double radius, double capacity) {
  PlanarGrasp grasp;
  grasp.count = points;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int j = 0; j < points; ++j) {
    const double r = radius * std::sqrt((j + 0.5) / points);
    grasp.x[j] = r * std::cos(golden * j);
    grasp.y[j] = r * std::sin(golden * j);
    grasp.bound[j] = capacity / points;
  }
  return grasp;
}

/// Square grid of points, symmetric about the origin of H.
inline PlanarGrasp square_grasp(int per_side, double half_side, double capacity) {
  PlanarGrasp grasp;
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      grasp.x[grasp.count] = half_side * ((2 * i + 1.0) / per_side - 1.0);
      grasp.y[grasp.count] = half_side * ((2 * j + 1.0) / per_side - 1.0);
      grasp.bound[grasp.count] = capacity / (per_side * per_side);
      ++grasp.count;
    }
  }
  return grasp;
}

inline PlanarDrive point_drive(const Vec2& p, const Vec2& n, double mu, const Vec2& v) {
  PlanarDrive drive;
  drive.count = 1;
  drive.p_HC = {p, p};
  drive.n_H = n;
  drive.mu = mu;
  drive.V_HP = {v.x(), v.y(), 0.0};
  return drive;
}

/// A line about `centre`, its second end along perp(n).
inline PlanarDrive line_drive(const Vec2& centre, double half_length, const Vec2& n,
                              double mu, const Vec2& v) {
  PlanarDrive drive = point_drive(centre, n, mu, v);
  drive.count = 2;
  drive.p_HC = {centre - half_length * perp(n), centre + half_length * perp(n)};
  return drive;
}

/// Everything moved by a pose: the same question seen from another frame.
inline PlanarWrench moved_wrench(const PlanarPose& X, const PlanarWrench& w) {
  const Vec2 f = rotated(X.theta, w.head<2>());
  return {f.x(), f.y(), w[2] + cross(translation(X), f)};
}
inline PlanarTwist moved_twist(const PlanarPose& X, const PlanarTwist& V) {
  const Vec2 v = rotated(X.theta, V.head<2>()) - V[2] * perp(translation(X));
  return {v.x(), v.y(), V[2]};
}
inline PlanarGrasp moved(const PlanarPose& X, PlanarGrasp grasp) {
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 p = transform(X, {grasp.x[j], grasp.y[j]});
    grasp.x[j] = p.x();
    grasp.y[j] = p.y();
  }
  grasp.w_g = moved_wrench(X, grasp.w_g);
  return grasp;
}
inline PlanarDrive moved(const PlanarPose& X, PlanarDrive drive) {
  for (Vec2& p : drive.p_HC) p = transform(X, p);
  drive.n_H = rotated(X.theta, drive.n_H);
  drive.V_HP = moved_twist(X, drive.V_HP);
  return drive;
}

/// Everything mirrored in the x axis. The ends of a line keep their places; t turns over.
inline PlanarGrasp mirrored(PlanarGrasp grasp) {
  for (int j = 0; j < grasp.count; ++j) grasp.y[j] = -grasp.y[j];
  grasp.w_g = {grasp.w_g[0], -grasp.w_g[1], -grasp.w_g[2]};
  return grasp;
}
inline PlanarDrive mirrored(PlanarDrive drive) {
  for (Vec2& p : drive.p_HC) p.y() = -p.y();
  drive.n_H.y() = -drive.n_H.y();
  drive.V_HP = {drive.V_HP[0], -drive.V_HP[1], -drive.V_HP[2]};
  return drive;
}

/// What failed, for messages.
inline std::string told(const Certificate& certificate) {
  std::string text;
  for (int check = 0; check < Certificate::kCheckCount; ++check) {
    const CertificateEntry& entry = certificate.entries[check];
    text += std::string(name(static_cast<Certificate::Check>(check))) + " " +
            std::to_string(entry.value) + " (" + std::to_string(entry.worst) + ")  ";
  }
  return text;
}

}  // namespace prehensile::testing
