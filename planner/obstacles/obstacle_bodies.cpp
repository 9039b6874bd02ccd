#include "planner/obstacles/obstacle_bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/obstacles/separation.h"
#include "scene/lying_prism.h"
#include "scene/outline.h"
#include "scene/polygon_pieces.h"

namespace prehensile {
namespace {

/// Over an outline in the pad plane, between two heights.
void add_prisms(const std::vector<Vec2>& outline, double low, double high,
                std::vector<ConvexBody>& bodies) {
  const auto add = [&](std::vector<Vec2> convex) {
    ConvexBody body;
    body.shape = PrismShape{.outline = std::move(convex), .thickness = high - low};
    body.position.z() = 0.5 * (low + high);
    bodies.push_back(std::move(body));
  };
  if (is_convex(outline)) return add(outline);
  for (const Triangle& triangle : triangulate(outline)) {
    add({triangle.vertices.begin(), triangle.vertices.end()});
  }
}

/// Of a body about the origin of its own frame.
struct Radius {
  double operator()(const BoxShape& box) const { return 0.5 * box.size.norm(); }
  double operator()(const SphereShape& sphere) const { return sphere.radius; }
  double operator()(const CylinderShape& cylinder) const {
    return std::hypot(cylinder.radius, 0.5 * cylinder.length);
  }
  double operator()(const CapsuleShape& capsule) const {
    return capsule.radius + 0.5 * capsule.length;
  }
  double operator()(const PrismShape& prism) const {
    double most = 0.0;
    for (const Vec3& corner : corners_of(prism)) most = std::max(most, corner.norm());
    return most;
  }
  double operator()(const HalfSpaceShape&) const {
    return std::numeric_limits<double>::infinity();
  }
};

/// Whether a body of the hand has points below both faces of the object. Of a sheet that
/// is thinner than twice kBeside half is as much.
bool reaches_between_faces(const ConvexBody& body, double half_thickness) {
  const PlacedBody placed{&body, pose_of(body)};
  const double inside = half_thickness - std::min(kBeside, half_thickness);
  return support(placed, -Vec3::UnitZ()).z() < inside &&
         support(placed, Vec3::UnitZ()).z() > -inside;
}

}  // namespace

std::vector<ConvexBody> object_bodies(const Model& model) {
  const Shape& shape = model.scene.object.shape;
  std::vector<ConvexBody> bodies;
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    bodies.push_back({.shape = *cylinder});
  } else if (const PrismShape* lying = lying_prism(shape)) {
    bodies.push_back({.shape = *lying});
  } else {
    const double half = half_thickness(shape);
    Vec2 heights{-half, half};
    if (const auto* solid = std::get_if<SolidShape>(&shape)) {
      for (const Vec2& side : solid->heights) {
        heights.x() = std::min(heights.x(), side.x());
        heights.y() = std::max(heights.y(), side.y());
      }
    }
    add_prisms(outline_of(shape), heights.x(), heights.y(), bodies);
  }
  return bodies;
}

std::vector<ConvexBody> palm_bodies(const Model& model) {
  std::vector<ConvexBody> bodies;
  for (const ConvexBody& body : model.scene.obstacles.value_or(Obstacles{}).hand) {
    if (reaches_between_faces(body, model.half_thickness)) bodies.push_back(body);
  }
  return bodies;
}

Eigen::Isometry3d pose_of(const ConvexBody& body) {
  const auto& [x, y, z, w] = body.quaternion;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(body.turn, Vec3::UnitZ()) *
                  Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  pose.translation() = body.position;
  return pose;
}

Eigen::Isometry3d in_space(const PlanarPose& pose, double z) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::AngleAxisd(pose.theta, Vec3::UnitZ()).toRotationMatrix();
  result.translation() << pose.x, pose.y, z;
  return result;
}

std::vector<Vec3> corners_of(const PrismShape& prism) {
  std::vector<Vec3> corners;
  for (const double h : {-0.5 * prism.thickness, 0.5 * prism.thickness}) {
    for (const Vec2& v : prism.outline) {
      switch (prism.axis) {
        case Axis::kX:
          corners.emplace_back(h, v.x(), v.y());
          break;
        case Axis::kY:
          corners.emplace_back(v.x(), -h, v.y());
          break;
        case Axis::kZ:
          corners.emplace_back(v.x(), v.y(), h);
          break;
      }
    }
  }
  return corners;
}

Eigen::Matrix3d turned_to(Axis axis) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  switch (axis) {
    case Axis::kX:
      return Eigen::AngleAxisd(kQuarter, Vec3::UnitY()).toRotationMatrix();
    case Axis::kY:
      return Eigen::AngleAxisd(-kQuarter, Vec3::UnitX()).toRotationMatrix();
    case Axis::kZ:
      break;
  }
  return Eigen::Matrix3d::Identity();
}

double reach_about_z(const ConvexBody& body) {
  return body.position.head<2>().norm() + std::visit(Radius{}, body.shape);
}

}  // namespace prehensile
