/// Small spatial instants on pads of few points, and random ones of the ordinary range,
/// for tests of the polyhedral solvers.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "mechanics/spatial_problem.h"
#include "tests/support/random.h"

namespace prehensile::testing {

/// Appends a patch with these points.
inline ContactPatch& add_patch(SpatialProblem& q, ContactBody body, const Vec3& n,
                               const Vec3& t, double mu,
                               const std::vector<Vec3>& points) {
  ContactPatch& patch = q.patch[q.patch_count++];
  patch.body = body;
  patch.n = n;
  patch.t = t;
  patch.mu = mu;
  patch.first = q.count;
  patch.count = static_cast<int>(points.size());
  for (const Vec3& p : points) {
    q.x[q.count] = p.x();
    q.y[q.count] = p.y();
    q.z[q.count] = p.z();
    q.preload[q.count++] = 0.0;
  }
  return patch;
}

/// Both jaws, at z = -/+ half_gap, with the same points in the pad plane and an even
/// preload. `softness`: R in units of push rate over grip force.
inline void add_jaws(SpatialProblem& q, double grip, double mu, double half_gap,
                     const std::vector<Vec2>& points, double softness, double rate) {
  q.grip_force = grip;
  for (const double side : {-1.0, 1.0}) {
    std::vector<Vec3> at;
    at.reserve(points.size());
    for (const Vec2& p : points) at.emplace_back(p.x(), p.y(), side * half_gap);
    ContactPatch& patch =
        add_patch(q, side < 0.0 ? ContactBody::kJaw1 : ContactBody::kJaw2,
                  {0.0, 0.0, -side}, {1.0, 0.0, 0.0}, mu, at);
    patch.pressure = PressureLaw::kFoundation;
    patch.compliance = softness * rate / grip;
    for (int i = patch.first; i < q.count; ++i) {
      q.preload[i] = grip / static_cast<double>(points.size());
    }
  }
}

inline void set_gravity(SpatialProblem& q, const Vec3& weight, const Vec3& centre) {
  q.w_g.head<3>() = weight;
  q.w_g.tail<3>() = centre.cross(weight);
}

struct RandomSpatialOptions {
  int points_per_pad = 4;  ///< a square number
  int pushers = 1;         ///< 1 or 2
  double softness = 1e-2;  ///< R in units of push rate over grip force
  double push_rate = 0.1;
  bool inertia = false;
};

/// A box in a random grasp, pushed on one of four faces, off the middle plane too.
inline SpatialProblem random_spatial(Random& random,
                                     const RandomSpatialOptions& options) {
  SpatialProblem q;
  const Vec3 half(random.in(15e-3, 75e-3), random.in(15e-3, 75e-3),
                  random.in(5e-3, 30e-3));
  const double mass = random.log_in(0.02, 1.0);
  const double grip = random.log_in(5.0, 100.0);
  const double mu = random.in(0.2, 1.0);
  const Vec2 pad(random.in(3e-3, 12e-3), random.in(3e-3, 12e-3));
  const double turn = random.in(-3.0, 3.0);
  const int side = static_cast<int>(std::lround(std::sqrt(options.points_per_pad)));
  std::vector<Vec2> points;
  for (int i = 0; i < options.points_per_pad; ++i) {
    const int row = i / side;
    const int column = i % side;
    const Vec2 share((2.0 * column + 1.0) / side - 1.0, (2.0 * row + 1.0) / side - 1.0);
    points.push_back(rotated(turn, pad.cwiseProduct(share)));
  }
  add_jaws(q, grip, mu, half.z(), points, options.softness, options.push_rate);

  const Vec3 middle(random.in(-0.4, 0.4) * half.x(), random.in(-0.4, 0.4) * half.y(),
                    0.0);
  const bool along_x = random.chance(0.5);
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  const Vec3 n = along_x ? Vec3(sign, 0.0, 0.0) : Vec3(0.0, sign, 0.0);
  const Vec3 t = along_x ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
  const double depth = along_x ? half.x() : half.y();
  const double width = along_x ? half.y() : half.x();
  const Vec3 place = middle - depth * n + random.in(-0.6, 0.6) * width * t +
                     Vec3(0.0, 0.0, random.in(-0.5, 0.5) * half.z());
  std::vector<Vec3> pushers{place};
  if (options.pushers == 2) pushers = {place - 0.3 * width * t, place + 0.3 * width * t};
  add_patch(q, ContactBody::kPusher, n, t, random.in(0.1, 0.9), pushers);
  const double tilt = random.in(-1.0, 1.0);
  q.V_HP.head<3>() = options.push_rate * (std::cos(tilt) * n + std::sin(tilt) * t);

  const Vec3 centre =
      middle + 0.3 * half.cwiseProduct(Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0),
                                            random.in(-1.0, 1.0)));
  const Vec2 down = random.direction();
  set_gravity(q, 9.81 * mass * Vec3(down.x(), down.y(), 0.0), centre);
  if (!options.inertia) return q;
  Eigen::Matrix3d skew;
  skew << 0.0, -centre.z(), centre.y(), centre.z(), 0.0, -centre.x(), -centre.y(),
      centre.x(), 0.0;
  const Vec3 square = half.cwiseAbs2() * mass / 3.0;
  Eigen::Matrix3d turning = Eigen::Matrix3d::Identity() * square.sum();
  turning.diagonal() -= square;
  q.inertia.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
  q.inertia.topRightCorner<3, 3>() = -mass * skew;
  q.inertia.bottomLeftCorner<3, 3>() = mass * skew;
  q.inertia.bottomRightCorner<3, 3>() = turning - mass * skew * skew;
  q.jaw_mass = 0.1;
  return q;
}

}  // namespace prehensile::testing
