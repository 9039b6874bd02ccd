#include "viewer/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "scene/polygon_pieces.h"

namespace prehensile::viewer {
namespace {

constexpr int kRound = 64;  // edges of a circle

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

}  // namespace

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

double volume_of(const Surface& surface) {
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles) volume += a.dot(b.cross(c)) / 6.0;
  return volume;
}

}  // namespace prehensile::viewer
