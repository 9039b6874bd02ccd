/// Spatial questions that the tests of the spatial instant share.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <vector>

#include "mechanics/spatial_certificate.h"
#include "mechanics/spatial_problem.h"

namespace prehensile::testing {

struct PadLaw {
  double mu = 0.5;
  PressureLaw pressure = PressureLaw::kFoundation;
  double compliance = 1e-6;  ///< [m/s / N]
  double spin_radius = 0.0;
};

/// Two pads with the same points, facing each other at z = -height and +height.
inline SpatialProblem grasp_of(const std::vector<Vec2>& points, double height,
                               double grip_force, const PadLaw& law) {
  SpatialProblem problem;
  problem.grip_force = grip_force;
  for (const double side : {-1.0, 1.0}) {
    ContactPatch& patch = problem.patch[problem.patch_count++];
    patch.body = side < 0.0 ? ContactBody::kJaw1 : ContactBody::kJaw2;
    patch.n = {0.0, 0.0, -side};
    patch.t = Vec3::UnitX();
    patch.mu = law.mu;
    patch.pressure = law.pressure;
    patch.compliance = law.pressure == PressureLaw::kFoundation ? law.compliance : 0.0;
    patch.spin_radius = law.spin_radius;
    patch.first = problem.count;
    patch.count = static_cast<int>(points.size());
    for (const Vec2& p : points) {
      problem.x[problem.count] = p.x();
      problem.y[problem.count] = p.y();
      problem.z[problem.count] = side * height;
      problem.preload[problem.count++] =
          law.pressure == PressureLaw::kFree
              ? 0.0
              : grip_force / static_cast<double>(points.size());
    }
  }
  return problem;
}

/// Square grid of points, symmetric about the origin.
inline std::vector<Vec2> square_points(int per_side, double half_side) {
  std::vector<Vec2> points;
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      points.emplace_back(half_side * ((2 * i + 1.0) / per_side - 1.0),
                          half_side * ((2 * j + 1.0) / per_side - 1.0));
    }
  }
  return points;
}

/// Sunflower points on a disc.
inline std::vector<Vec2> disc_points(int count, double radius) {
  std::vector<Vec2> points;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int j = 0; j < count; ++j) {
    const double r = radius * std::sqrt((j + 0.5) / count);
    points.emplace_back(r * std::cos(golden * j), r * std::sin(golden * j));
  }
  return points;
}

/// A rigid pusher through these points, moving with velocity v.
inline void push(SpatialProblem& problem, std::initializer_list<Vec3> points,
                 const Vec3& n, double mu, const Vec3& v) {
  ContactPatch& patch = problem.patch[problem.patch_count++];
  patch.body = ContactBody::kPusher;
  patch.n = n;
  patch.t = std::abs(n.z()) < 0.9 ? Vec3::UnitZ().cross(n).normalized() : Vec3::UnitX();
  patch.mu = mu;
  patch.pressure = PressureLaw::kFree;
  patch.first = problem.count;
  patch.count = static_cast<int>(points.size());
  for (const Vec3& p : points) {
    problem.x[problem.count] = p.x();
    problem.y[problem.count] = p.y();
    problem.z[problem.count] = p.z();
    problem.preload[problem.count++] = 0.0;
  }
  problem.V_HP << v, Vec3::Zero();
}

inline SpatialWrench weight_at(const Vec3& p, const Vec3& f) {
  SpatialWrench w;
  w << f, p.cross(f);
  return w;
}

/// What failed, for messages.
inline std::string told(const SpatialCertificate& certificate) {
  std::string text;
  for (int check = 0; check < SpatialCertificate::kCheckCount; ++check) {
    const CertificateEntry& entry = certificate.entries[check];
    if (entry.value <= 1e-6) continue;
    text += std::string(name(static_cast<SpatialCertificate::Check>(check))) + " " +
            std::to_string(entry.value) + " (" + std::to_string(entry.worst) + ")  ";
  }
  return text;
}

}  // namespace prehensile::testing
