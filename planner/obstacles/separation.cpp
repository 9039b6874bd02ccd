#include "planner/obstacles/separation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "planner/obstacles/obstacle_bodies.h"

namespace prehensile {
namespace {

constexpr int kMostSteps = 100;
constexpr double kPrecision = 1e-9;  // [m] of the distance, and relative

/// Farthest point along a direction, in the frame of the shape.
struct Farthest {
  Vec3 d;

  Vec3 operator()(const BoxShape& box) const {
    Vec3 p = 0.5 * box.size;
    for (int i = 0; i < 3; ++i) {
      if (d[i] < 0.0) p[i] = -p[i];
    }
    return p;
  }
  Vec3 operator()(const SphereShape& sphere) const {
    return sphere.radius * d.normalized();
  }
  Vec3 operator()(const CylinderShape& cylinder) const {
    const int axis = static_cast<int>(cylinder.axis);
    Vec3 across = d;
    across[axis] = 0.0;
    Vec3 p = cylinder.radius * across.normalized();
    p[axis] = d[axis] < 0.0 ? -0.5 * cylinder.length : 0.5 * cylinder.length;
    return p;
  }
  Vec3 operator()(const CapsuleShape& capsule) const {
    const int axis = static_cast<int>(capsule.axis);
    Vec3 p = capsule.radius * d.normalized();
    p[axis] += d[axis] < 0.0 ? -0.5 * capsule.length : 0.5 * capsule.length;
    return p;
  }
  Vec3 operator()(const PrismShape& prism) const {
    const std::vector<Vec3> corners = corners_of(prism);
    return *std::max_element(
        corners.begin(), corners.end(),
        [&](const Vec3& a, const Vec3& b) { return d.dot(a) < d.dot(b); });
  }
  Vec3 operator()(const HalfSpaceShape&) const { return Vec3::Zero(); }
};

/// Points of the Minkowski difference whose hull contains the point nearest to 0.
struct Simplex {
  int count = 0;
  std::array<Vec3, 4> points;

  void add(const Vec3& p) { points[static_cast<std::size_t>(count++)] = p; }
};

/// Whether the point nearest to 0 of the plane, line or space through these points lies
/// between them all; that point.
bool nearest_inside(const Simplex& part, Vec3& nearest) {
  const Vec3& origin = part.points[0];
  const int n = part.count - 1;
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  for (int i = 0; i < n; ++i) {
    edges.col(i) = part.points[static_cast<std::size_t>(i) + 1] - origin;
  }
  Vec3 shares = Vec3::Zero();
  if (n > 0) {
    const Eigen::Matrix3d gram = edges.transpose() * edges;
    const Vec3 right = -edges.transpose() * origin;
    if (n == 1) {
      shares[0] = right[0] / gram(0, 0);
    } else if (n == 2) {
      shares.head<2>() = gram.topLeftCorner<2, 2>().inverse() * right.head<2>();
    } else {
      shares = edges.inverse() * -origin;
    }
  }
  if (!shares.allFinite() || shares.minCoeff() < 0.0 || shares.sum() > 1.0) return false;
  nearest = origin + edges * shares;
  return true;
}

/// Shrinks a simplex to the part of it that holds the point nearest to 0.
Vec3 reduce(Simplex& simplex) {
  Vec3 best = simplex.points[0];
  double least = std::numeric_limits<double>::infinity();
  Simplex kept;
  for (int mask = 1; mask < 1 << simplex.count; ++mask) {
    Simplex part;
    for (int i = 0; i < simplex.count; ++i) {
      if (mask & 1 << i) part.add(simplex.points[static_cast<std::size_t>(i)]);
    }
    Vec3 nearest;
    if (!nearest_inside(part, nearest) || !(nearest.norm() < least)) continue;
    least = nearest.norm();
    best = nearest;
    kept = part;
  }
  simplex = kept;
  return best;
}

double gap_from_plane(const PlacedBody& body, const PlacedBody& plane) {
  const auto& half_space = std::get<HalfSpaceShape>(plane.body->shape);
  const Vec3 n = plane.pose.linear() * half_space.normal.normalized();
  return n.dot(support(body, -n) - plane.pose.translation());
}

}  // namespace

Vec3 support(const PlacedBody& placed, const Vec3& direction) {
  const Vec3 d = placed.pose.linear().transpose() * direction;
  return placed.pose * std::visit(Farthest{d}, placed.body->shape);
}

double separation(const PlacedBody& a, const PlacedBody& b) {
  if (std::holds_alternative<HalfSpaceShape>(b.body->shape)) return gap_from_plane(a, b);
  if (std::holds_alternative<HalfSpaceShape>(a.body->shape)) return gap_from_plane(b, a);
  Vec3 v = a.pose.translation() - b.pose.translation();
  if (v.isZero()) v = Vec3::UnitX();
  double gap = -std::numeric_limits<double>::infinity();
  Simplex simplex;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3 d = v.normalized();
    const Vec3 w = support(a, -d) - support(b, d);
    gap = std::max(gap, d.dot(w));
    if (simplex.count > 0 && v.norm() - gap <= kPrecision * (1.0 + v.norm())) break;
    if (simplex.count == 4) break;  // they overlap
    simplex.add(w);
    v = reduce(simplex);
    if (simplex.count == 0 || v.norm() <= kPrecision) break;
  }
  return gap;
}

}  // namespace prehensile
