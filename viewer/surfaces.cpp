#include "viewer/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "planner/obstacles/obstacle_bodies.h"
#include "scene/polygon_pieces.h"

namespace prehensile::viewer {
namespace {

constexpr int kRound = 64;                  // edges of a circle
constexpr int kRings = 9, kMeridians = 18;  // of a ball; an odd number: one in the middle
constexpr double kSlab = 0.02;              // thickness of a half space over its extent

void add_quad(Surface& surface, const Vec3& a, const Vec3& b, const Vec3& c,
              const Vec3& d) {
  surface.triangles.push_back({a, b, c});
  surface.triangles.push_back({a, c, d});
}

/// The prism over a counter-clockwise outline, along z of its drawing.
void add_prism(Surface& surface, const std::vector<Vec2>& outline, double low,
               double high) {
  const auto at = [](const Vec2& p, double z) { return Vec3(p.x(), p.y(), z); };
  for (const Triangle& t : triangulate(outline)) {
    const auto& [a, b, c] = t.vertices;
    surface.triangles.push_back({at(a, high), at(b, high), at(c, high)});
    surface.triangles.push_back({at(a, low), at(c, low), at(b, low)});
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    add_quad(surface, at(a, low), at(b, low), at(b, high), at(a, high));
  }
}

/// From the frame of a section (lateral axis, z, along the axis) to O.
Vec3 lying(const Vec3& p, Axis axis) {
  if (axis == Axis::kX) return {p.z(), p.x(), p.y()};
  if (axis == Axis::kY) return {p.x(), -p.z(), p.y()};
  return p;
}

void add_turned(Surface& surface, const Surface& drawn, Axis axis) {
  for (std::array<Vec3, 3> triangle : drawn.triangles) {
    for (Vec3& p : triangle) p = lying(p, axis);
    surface.triangles.push_back(triangle);
  }
}

std::vector<Vec2> circle(double radius) {
  std::vector<Vec2> outline;
  outline.reserve(kRound);
  for (int i = 0; i < kRound; ++i) {
    outline.push_back(rotated(2.0 * std::numbers::pi * i / kRound, Vec2(radius, 0.0)));
  }
  return outline;
}

/// All points within `radius` of the segment of this length along z, or a ball.
void add_rounded(Surface& surface, double radius, double length) {
  const auto at = [&](int ring, int i) {
    const double up = std::numbers::pi * (static_cast<double>(ring) / kRings - 0.5);
    const double around = 2.0 * std::numbers::pi * i / kMeridians;
    const double lift = ring > kRings / 2 ? 0.5 * length : -0.5 * length;
    return Vec3(radius * std::cos(up) * std::cos(around),
                radius * std::cos(up) * std::sin(around), radius * std::sin(up) + lift);
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int i = 0; i < kMeridians; ++i) {
      const Vec3 a = at(ring, i), b = at(ring, i + 1);
      const Vec3 c = at(ring + 1, i + 1), d = at(ring + 1, i);
      if (ring > 0) surface.triangles.push_back({a, b, c});
      if (ring + 1 < kRings) surface.triangles.push_back({a, c, d});
    }
  }
}

struct DrawBody {
  double extent;
  Surface drawn{};

  Surface turned(Axis axis) const {
    Surface surface;
    add_turned(surface, drawn, axis);
    return surface;
  }
  Surface operator()(const BoxShape& box) {
    const Vec3 half = 0.5 * box.size;
    add_prism(drawn, rectangle(half.x(), half.y()), -half.z(), half.z());
    return drawn;
  }
  Surface operator()(const SphereShape& sphere) {
    add_rounded(drawn, sphere.radius, 0.0);
    return drawn;
  }
  Surface operator()(const CylinderShape& cylinder) {
    add_prism(drawn, circle(cylinder.radius), -0.5 * cylinder.length,
              0.5 * cylinder.length);
    return turned(cylinder.axis);
  }
  Surface operator()(const CapsuleShape& capsule) {
    add_rounded(drawn, capsule.radius, capsule.length);
    return turned(capsule.axis);
  }
  Surface operator()(const PrismShape& prism) {
    return surface_of(ObjectBody{.prisms = {{prism.outline, -0.5 * prism.thickness,
                                             0.5 * prism.thickness, prism.axis}}});
  }
  Surface operator()(const HalfSpaceShape& half_space) {
    add_prism(drawn, rectangle(extent, extent), -kSlab * extent, 0.0);
    const auto up = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), half_space.normal);
    for (auto& triangle : drawn.triangles) {
      for (Vec3& p : triangle) p = up * p;
    }
    return drawn;
  }

  static std::vector<Vec2> rectangle(double x, double y) {
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  }
};

}  // namespace

Surface surface_of(const ObjectSurface& mesh) {
  Surface surface;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&mesh](int i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
    surface.triangles.push_back({at(a), at(b), at(c)});
  }
  return surface;
}

Surface surface_of(const ConvexBody& body, double extent) {
  Surface surface = std::visit(DrawBody{extent}, body.shape);
  const Eigen::Isometry3d X = pose_of(body);
  for (auto& triangle : surface.triangles) {
    for (Vec3& p : triangle) p = X * p;
  }
  return surface;
}

double extent_of(const Model& model) {
  double far = 0.0;
  for (const Pusher& pusher : model.scene.pushers) {
    far = std::max(far, pusher.p_WP.norm());
  }
  return far + 2.0 * reach_of(model);
}

Surface surface_of(const ObjectBody& body) {
  Surface surface;
  for (const PrismBody& prism : body.prisms) {
    Surface drawn;
    const bool is_y = prism.axis == Axis::kY;
    add_prism(drawn, prism.outline, is_y ? -prism.high : prism.low,
              is_y ? -prism.low : prism.high);
    add_turned(surface, drawn, prism.axis);
  }
  for (const CylinderBody& cylinder : body.cylinders) {
    Surface drawn;
    add_prism(drawn, circle(cylinder.radius), -0.5 * cylinder.length,
              0.5 * cylinder.length);
    add_turned(surface, drawn, cylinder.axis);
  }
  for (const Face& side : body.sides) {
    // t runs against the outline, whose normal looks out.
    const Vec3 a(side.a.x(), side.a.y(), side.z_low);
    const Vec3 b(side.b.x(), side.b.y(), side.z_low);
    const Vec3 up(0.0, 0.0, side.z_high - side.z_low);
    add_quad(surface, b, a, a + up, b + up);
  }
  return surface;
}

Surface surface_of(const PadBody& pad, double low, double high) {
  Surface surface;
  add_prism(surface, pad.outline, low, high);
  return surface;
}

Surface surface_of(const PusherBody& pusher, double thickness) {
  const double along = 0.5 * std::max(pusher.length, thickness);
  const double across = 0.5 * std::max(pusher.width, thickness);
  Surface surface;
  add_prism(surface,
            {{-thickness, -along}, {0.0, -along}, {0.0, along}, {-thickness, along}},
            -across, across);
  return surface;
}

std::vector<Vec2> shadow_of(const Surface& surface) {
  std::vector<Vec2> points;
  for (const auto& triangle : surface.triangles) {
    for (const Vec3& p : triangle) points.emplace_back(p.head<2>());
  }
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {  // lower border, then upper
    const std::size_t begin = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= begin + 2 &&
             perp(hull.back() - hull[hull.size() - 2]).dot(p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double volume_of(const Surface& surface) {
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles) volume += a.dot(b.cross(c)) / 6.0;
  return volume;
}

}  // namespace prehensile::viewer
