#include "planner/obstacles/collision_bodies.h"

#include <algorithm>
#include <array>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>
#include <vector>

#include "planner/obstacles/obstacle_bodies.h"

namespace prehensile {
namespace {

/// Of FCL's iteration from step to step; the distances of round bodies are then good to
/// about its square root.
constexpr double kTolerance = 1e-11;  // [m]

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// What FCL knows of a body; nothing of a half-space, for which it has no distances.
struct MakeGeometry {
  Geometry operator()(const BoxShape& box) const {
    return std::make_shared<fcl::Boxd>(box.size);
  }
  Geometry operator()(const SphereShape& sphere) const {
    return std::make_shared<fcl::Sphered>(sphere.radius);
  }
  Geometry operator()(const CylinderShape& cylinder) const {
    return std::make_shared<fcl::Cylinderd>(cylinder.radius, cylinder.length);
  }
  Geometry operator()(const CapsuleShape& capsule) const {
    return std::make_shared<fcl::Capsuled>(capsule.radius, capsule.length);
  }
  Geometry operator()(const PrismShape& prism) const {
    const int n = static_cast<int>(prism.outline.size());
    std::vector<int> faces = {n};
    for (int i = n - 1; i >= 0; --i) faces.push_back(i);
    faces.push_back(n);
    for (int i = 0; i < n; ++i) faces.push_back(n + i);
    for (int i = 0; i < n; ++i) {
      const int next = (i + 1) % n;
      faces.insert(faces.end(), {4, i, next, n + next, n + i});
    }
    return std::make_shared<fcl::Convexd>(
        std::make_shared<const std::vector<Vec3>>(corners_of(prism)), n + 2,
        std::make_shared<const std::vector<int>>(std::move(faces)));
  }
  Geometry operator()(const HalfSpaceShape&) const { return nullptr; }
};

/// FCL's axis is z.
Axis axis_of(const BodyShape& shape) {
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) return cylinder->axis;
  if (const auto* capsule = std::get_if<CapsuleShape>(&shape)) return capsule->axis;
  return Axis::kZ;
}

/// Least w.p over the points p of a body in its own frame.
struct LeastAlong {
  Vec3 w;

  double operator()(const BoxShape& box) const {
    return -0.5 * box.size.dot(w.cwiseAbs());
  }
  double operator()(const SphereShape& sphere) const { return -sphere.radius * w.norm(); }
  double operator()(const CylinderShape& cylinder) const {
    const double along = w[static_cast<int>(cylinder.axis)];
    const double across = std::sqrt(std::max(0.0, w.squaredNorm() - along * along));
    return -0.5 * cylinder.length * std::abs(along) - cylinder.radius * across;
  }
  double operator()(const CapsuleShape& capsule) const {
    const double along = w[static_cast<int>(capsule.axis)];
    return -0.5 * capsule.length * std::abs(along) - capsule.radius * w.norm();
  }
  double operator()(const PrismShape& prism) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : corners_of(prism)) least = std::min(least, w.dot(corner));
    return least;
  }
  double operator()(const HalfSpaceShape&) const {
    return -std::numeric_limits<double>::infinity();
  }
};

/// A body at rest in its frame.
struct Solid {
  BodyShape shape;
  Geometry geometry;
  Eigen::Isometry3d pose;           ///< of the shape
  Eigen::Isometry3d geometry_pose;  ///< of FCL's
  double radius = 0.0;              ///< of a ball about its origin that contains it

  explicit Solid(const ConvexBody& body)
      : shape(body.shape),
        geometry(std::visit(MakeGeometry{}, body.shape)),
        pose(pose_of(body)),
        geometry_pose(pose) {
    geometry_pose.linear() *= turned_to(axis_of(shape));
    ConvexBody centred = body;
    centred.position.setZero();
    radius = reach_about_z(centred);
  }
};

std::vector<Solid> solids_of(const std::vector<ConvexBody>& bodies) {
  return {bodies.begin(), bodies.end()};
}

/// Along which bodies of its kind are told apart from others.
std::array<Vec3, 3> sides_of(const Solid& body, const Eigen::Isometry3d& X_WB,
                             const Vec3& towards) {
  if (std::holds_alternative<BoxShape>(body.shape)) {
    return {X_WB.linear().col(0), X_WB.linear().col(1), X_WB.linear().col(2)};
  }
  const Vec3 axis = X_WB.linear().col(static_cast<int>(axis_of(body.shape)));
  const Vec3 across = towards - axis.dot(towards) * axis;
  const double length = across.norm();
  return {axis, length > 0.0 ? Vec3(across / length) : axis, axis};
}

/// No more than the distance of two bodies: the widest gap between planes across the line
/// of their centres and along their sides. A prism has only the former.
double gap_of(const Solid& body, const Eigen::Isometry3d& X_WB, const Solid& fixed) {
  const Vec3 apart = X_WB.translation() - fixed.pose.translation();
  const auto gap_along = [&](const Vec3& w) {
    const Vec3 n = w.dot(apart) < 0.0 ? Vec3(-w) : w;
    return n.dot(apart) +
           std::visit(LeastAlong{X_WB.linear().transpose() * n}, body.shape) +
           std::visit(LeastAlong{-(fixed.pose.linear().transpose() * n)}, fixed.shape);
  };
  const double distance = apart.norm();
  if (!(distance > 0.0)) return 0.0;
  double gap = gap_along(apart / distance);
  for (const Solid* solid : {&body, &fixed}) {
    if (std::holds_alternative<PrismShape>(solid->shape)) continue;
    for (const Vec3& w : sides_of(*solid, solid == &body ? X_WB : solid->pose, apart)) {
      gap = std::max(gap, gap_along(w));
    }
  }
  return gap;
}

/// Of a body from a half-space at rest in W.
double distance_from_plane(const Solid& body, const Eigen::Isometry3d& X_WB,
                           const Solid& plane) {
  const Vec3 n =
      plane.pose.linear() * std::get<HalfSpaceShape>(plane.shape).normal.normalized();
  const Vec3 w = X_WB.linear().transpose() * n;
  return n.dot(X_WB.translation() - plane.pose.translation()) +
         std::visit(LeastAlong{w}, body.shape);
}

}  // namespace

struct CollisionBodies::Bodies {
  std::vector<Solid> fixture, hand, palm, object;
  double hand_reach = 0.0, object_reach = 0.0;
  std::int64_t queries = 0;

  double distance(const std::vector<Solid>& moving, const Eigen::Isometry3d& X_W,
                  const std::vector<Solid>& still, double enough, double coarse) {
    double least = enough;
    for (const Solid& body : moving) {
      for (const Solid& fixed : still) {
        least = std::min(least, distance_of_pair(body, X_W, fixed, least, coarse));
        if (least <= 0.0) return 0.0;
      }
    }
    return least;
  }

  double distance_of_pair(const Solid& body, const Eigen::Isometry3d& X_W,
                          const Solid& fixed, double least, double coarse) {
    const Eigen::Isometry3d X_WB = X_W * body.pose;
    if (!fixed.geometry) return distance_from_plane(body, X_WB, fixed);
    const double apart = (X_WB.translation() - fixed.pose.translation()).norm();
    if (apart - body.radius - fixed.radius >= least) return least;
    const double gap = gap_of(body, X_WB, fixed);
    if (gap >= std::min(least, coarse)) return gap;
    ++queries;
    return distance_by_fcl(body, X_W, fixed);
  }

  /// Where FCL gives up, the bodies count as overlapping.
  static double distance_by_fcl(const Solid& body, const Eigen::Isometry3d& X_W,
                                const Solid& fixed) {
    fcl::DistanceRequestd request;
    request.distance_tolerance = kTolerance;
    fcl::DistanceResultd result;
    try {
      const double found =
          fcl::distance(body.geometry.get(), X_W * body.geometry_pose,
                        fixed.geometry.get(), fixed.geometry_pose, request, result);
      return std::isfinite(found) ? std::max(0.0, found) : 0.0;
    } catch (const std::exception&) {
      return 0.0;
    }
  }
};

bool collisions_are_built() { return true; }

CollisionBodies::CollisionBodies(const Model& model)
    : bodies_(std::make_unique<Bodies>()) {
  if (!model.scene.obstacles) return;
  const Obstacles& obstacles = *model.scene.obstacles;
  bodies_->fixture = solids_of(obstacles.fixture);
  bodies_->hand = solids_of(obstacles.hand);
  bodies_->palm = solids_of(palm_bodies(model));
  bodies_->object = solids_of(object_bodies(model));
  for (const ConvexBody& body : obstacles.hand) {
    bodies_->hand_reach = std::max(bodies_->hand_reach, reach_about_z(body));
  }
  for (const ConvexBody& body : object_bodies(model)) {
    bodies_->object_reach = std::max(bodies_->object_reach, reach_about_z(body));
  }
}

CollisionBodies::~CollisionBodies() = default;

double CollisionBodies::hand_distance(const PlanarPose& X_WH, double enough, double z,
                                      double coarse) const {
  return bodies_->distance(bodies_->hand, in_space(X_WH, z), bodies_->fixture, enough,
                           coarse);
}

double CollisionBodies::object_distance(const PlanarPose& X_WO, double enough, double z,
                                        double coarse) const {
  return bodies_->distance(bodies_->object, in_space(X_WO, z), bodies_->fixture, enough,
                           coarse);
}

double CollisionBodies::palm_distance(const PlanarPose& X_OH, double enough,
                                      double coarse) const {
  return bodies_->distance(bodies_->palm, in_space(X_OH, 0.0), bodies_->object, enough,
                           coarse);
}

double CollisionBodies::hand_reach() const { return bodies_->hand_reach; }

double CollisionBodies::object_reach() const { return bodies_->object_reach; }

std::int64_t CollisionBodies::queries() const { return bodies_->queries; }

}  // namespace prehensile
