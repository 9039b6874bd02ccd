#include "planner/obstacles/closeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace prehensile {
namespace {

/// Of the search for the nearest point [m].
constexpr double kFinestStep = 2e-5;

/// Signed distance from a body that is the product of a flat shape and a segment, or a
/// round of it: across the flat shape and beyond the end of the segment.
double of_product(double across, double beyond) {
  const double outside = std::hypot(std::max(across, 0.0), std::max(beyond, 0.0));
  return outside + std::min(std::max(across, beyond), 0.0);
}

/// A point in a frame whose third axis is the axis of the shape; the first two as the
/// outline of a prism has them.
Vec3 along_axis(Axis axis, const Vec3& p) {
  switch (axis) {
    case Axis::kX:
      return {p.y(), p.z(), p.x()};
    case Axis::kY:
      return {p.x(), p.z(), -p.y()};
    case Axis::kZ:
      break;
  }
  return p;
}

Vec3 from_axis(Axis axis, const Vec3& q) {
  switch (axis) {
    case Axis::kX:
      return {q.z(), q.x(), q.y()};
    case Axis::kY:
      return {q.x(), -q.z(), q.y()};
    case Axis::kZ:
      break;
  }
  return q;
}

/// The signed distance from a convex outline, and the point of it nearest to p.
struct OutlineDistance {
  double signed_distance;
  Vec2 nearest;
};

OutlineDistance distance_from(const std::vector<Vec2>& outline, const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 nearest = p;
  bool inside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2 edge = outline[(i + 1) % outline.size()] - a;
    const double square = edge.squaredNorm();
    const double share =
        square > 0.0 ? std::clamp(edge.dot(p - a) / square, 0.0, 1.0) : 0.0;
    const Vec2 q = a + share * edge;
    inside = inside && cross(edge, p - a) >= 0.0;
    if ((p - q).norm() < least) {
      least = (p - q).norm();
      nearest = q;
    }
  }
  if (inside) return {-least, p};
  return {least, nearest};
}

struct SignedDistance {
  Vec3 p;

  double operator()(const BoxShape& box) const {
    const Vec3 q = p.cwiseAbs() - 0.5 * box.size;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
  }
  double operator()(const SphereShape& sphere) const { return p.norm() - sphere.radius; }
  double operator()(const CylinderShape& cylinder) const {
    const Vec3 q = along_axis(cylinder.axis, p);
    return of_product(q.head<2>().norm() - cylinder.radius,
                      std::abs(q.z()) - 0.5 * cylinder.length);
  }
  double operator()(const CapsuleShape& capsule) const {
    Vec3 q = along_axis(capsule.axis, p);
    const double half = 0.5 * capsule.length;
    q.z() -= std::clamp(q.z(), -half, half);
    return q.norm() - capsule.radius;
  }
  double operator()(const PrismShape& prism) const {
    const Vec3 q = along_axis(prism.axis, p);
    return of_product(distance_from(prism.outline, q.head<2>()).signed_distance,
                      std::abs(q.z()) - 0.5 * prism.thickness);
  }
  double operator()(const HalfSpaceShape& plane) const {
    return plane.normal.normalized().dot(p);
  }
};

Vec2 shortened(const Vec2& p, double most) {
  const double norm = p.norm();
  return norm > most ? Vec2(most / norm * p) : p;
}

Vec3 shortened(const Vec3& p, double most) {
  const double norm = p.norm();
  return norm > most ? Vec3(most / norm * p) : p;
}

struct NearestPoint {
  Vec3 p;

  Vec3 operator()(const BoxShape& box) const {
    return p.cwiseMax(-0.5 * box.size).cwiseMin(0.5 * box.size);
  }
  Vec3 operator()(const SphereShape& sphere) const { return shortened(p, sphere.radius); }
  Vec3 operator()(const CylinderShape& cylinder) const {
    Vec3 q = along_axis(cylinder.axis, p);
    const double half = 0.5 * cylinder.length;
    q.head<2>() = shortened(Vec2(q.head<2>()), cylinder.radius);
    q.z() = std::clamp(q.z(), -half, half);
    return from_axis(cylinder.axis, q);
  }
  Vec3 operator()(const CapsuleShape& capsule) const {
    const Vec3 q = along_axis(capsule.axis, p);
    const double half = 0.5 * capsule.length;
    const Vec3 on_axis{0.0, 0.0, std::clamp(q.z(), -half, half)};
    return from_axis(capsule.axis,
                     on_axis + shortened(Vec3(q - on_axis), capsule.radius));
  }
  Vec3 operator()(const PrismShape& prism) const {
    Vec3 q = along_axis(prism.axis, p);
    const double half = 0.5 * prism.thickness;
    q.head<2>() = distance_from(prism.outline, q.head<2>()).nearest;
    q.z() = std::clamp(q.z(), -half, half);
    return from_axis(prism.axis, q);
  }
  Vec3 operator()(const HalfSpaceShape&) const {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
};

}  // namespace

double signed_distance(const BodyShape& shape, const Vec3& p) {
  return std::visit(SignedDistance{p}, shape);
}

Vec3 nearest_point(const BodyShape& shape, const Vec3& p) {
  return std::visit(NearestPoint{p}, shape);
}

/// A compass search over the points of `a`: the signed distance from a convex body is
/// convex, and the steps go along the axes of both.
double closeness(const PlacedBody& a, const PlacedBody& b) {
  const Eigen::Isometry3d X_AB = a.pose.inverse() * b.pose;
  const Eigen::Isometry3d X_BA = X_AB.inverse();
  const auto distance = [&](const Vec3& p_A) {
    return signed_distance(b.body->shape, X_BA * p_A);
  };
  std::array<Vec3, 6> axes;
  for (int i = 0; i < 3; ++i) {
    axes[static_cast<std::size_t>(i)] = Vec3::Unit(i);
    axes[static_cast<std::size_t>(i) + 3] = X_AB.linear().col(i);
  }
  Vec3 at = nearest_point(a.body->shape, X_AB.translation());
  double least = distance(at);
  const Vec3 middle = nearest_point(a.body->shape, Vec3::Zero());
  double step = std::max(0.25 * (at - middle).norm(), 32.0 * kFinestStep);
  if (distance(middle) < least) {
    least = distance(middle);
    at = middle;
  }
  while (step >= kFinestStep) {
    bool better = false;
    for (const Vec3& axis : axes) {
      for (const double side : {-step, step}) {
        const Vec3 next = nearest_point(a.body->shape, at + side * axis);
        const double found = distance(next);
        if (!(found < least)) continue;
        least = found;
        at = next;
        better = true;
      }
    }
    if (!better) step *= 0.5;
  }
  return least;
}

}  // namespace prehensile
