#include "scene/outline.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "scene/lying_prism.h"
#include "scene/near_outline.h"
#include "scene/segment_distance.h"

namespace prehensile {
namespace {

constexpr int kRoundEdges = 64;
constexpr double kParallel = 1e-9;

std::vector<Vec2> rectangle(double size_x, double size_y) {
  const double x = 0.5 * size_x;
  const double y = 0.5 * size_y;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Regular polygon with the area of the circle.
std::vector<Vec2> round_outline(double radius) {
  const double step = 2.0 * std::numbers::pi / kRoundEdges;
  const double r = radius * std::sqrt(step / std::sin(step));
  std::vector<Vec2> outline;
  outline.reserve(kRoundEdges);
  for (int i = 0; i < kRoundEdges; ++i) {
    outline.emplace_back(r * std::cos(i * step), r * std::sin(i * step));
  }
  return outline;
}

struct OutlineOf {
  std::vector<Vec2> operator()(const BoxShape& box) const {
    return rectangle(box.size.x(), box.size.y());
  }
  std::vector<Vec2> operator()(const CylinderShape& cylinder) const {
    switch (cylinder.axis) {
      case Axis::kX:
        return rectangle(cylinder.length, 2.0 * cylinder.radius);
      case Axis::kY:
        return rectangle(2.0 * cylinder.radius, cylinder.length);
      case Axis::kZ:
        break;
    }
    return round_outline(cylinder.radius);
  }
  std::vector<Vec2> operator()(const PrismShape& prism) const {
    if (prism.axis == Axis::kZ) return prism.outline;
    const SectionExtent extent = extent_of(prism.outline);
    return lying_rectangle(prism, extent.low, extent.high);
  }
  std::vector<Vec2> operator()(const SolidShape& solid) const { return solid.outline; }
  std::vector<Vec2> operator()(const MeshShape&) const { return {}; }
};

/// Name of the side whose outward normal is an axis of O, or empty.
std::string side_name(const Vec2& n) {
  if (std::abs(n.x() - 1.0) < kParallel) return "-x";
  if (std::abs(n.x() + 1.0) < kParallel) return "+x";
  if (std::abs(n.y() - 1.0) < kParallel) return "-y";
  if (std::abs(n.y() + 1.0) < kParallel) return "+y";
  return {};
}

struct HalfThickness {
  double operator()(const BoxShape& box) const { return 0.5 * box.size.z(); }
  double operator()(const CylinderShape& cylinder) const {
    return cylinder.axis == Axis::kZ ? 0.5 * cylinder.length : cylinder.radius;
  }
  double operator()(const PrismShape& prism) const {
    return prism.axis == Axis::kZ ? 0.5 * prism.thickness : extent_of(prism.outline).top;
  }
  double operator()(const SolidShape& solid) const { return 0.5 * solid.thickness; }
  double operator()(const MeshShape&) const { return 0.0; }
};

}  // namespace

std::vector<Vec2> outline_of(const Shape& shape) {
  return std::visit(OutlineOf{}, shape);
}

std::vector<Vec2> pad_face_of(const Shape& shape) {
  if (const PrismShape* lying = lying_prism(shape)) {
    const SectionExtent extent = extent_of(lying->outline);
    return lying_rectangle(*lying, extent.face_low, extent.face_high);
  }
  const auto* solid = std::get_if<SolidShape>(&shape);
  return solid ? solid->pad_face : outline_of(shape);
}

std::vector<Face> faces_of(const Shape& shape) {
  const auto* cylinder = std::get_if<CylinderShape>(&shape);
  if (cylinder && cylinder->axis == Axis::kZ) return {};
  const std::vector<Vec2> outline = outline_of(shape);
  const double tolerance = kParallel * longer_side(outline);
  const auto* solid = std::get_if<SolidShape>(&shape);
  const PrismShape* lying = lying_prism(shape);
  const double half = half_thickness(shape);
  std::vector<Face> faces;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Face face;
    face.b = outline[i];
    face.a = outline[(i + 1) % outline.size()];
    face.t = (face.b - face.a).normalized();
    face.n = -perp(face.t);
    face.on_hull = std::all_of(outline.begin(), outline.end(), [&](const Vec2& v) {
      return face.n.dot(v - face.a) >= -tolerance;
    });
    if (face.on_hull) face.name = side_name(face.n);
    face.z_low = solid ? solid->heights[i].x() : -half;
    face.z_high = solid ? solid->heights[i].y() : half;
    if (cylinder && std::abs(face.n[static_cast<int>(cylinder->axis)]) < 0.5) {
      face.z_low = face.z_high = 0.0;  // a round side is met along one line
    }
    const int lateral = lying && lying->axis == Axis::kX ? 1 : 0;
    if (lying && std::abs(face.n[lateral]) > 0.5) {
      const Vec2 heights = side_heights(lying->outline, face.n[lateral] < 0.0);
      face.z_low = heights.x();
      face.z_high = heights.y();
    }
    faces.push_back(face);
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto same = [&](const Face& f) { return f.name == faces[i].name; };
    const bool unique = std::count_if(faces.begin(), faces.end(), same) == 1;
    if (faces[i].name.empty() || !unique) faces[i].name = edge_name(static_cast<int>(i));
  }
  return faces;
}

std::string edge_name(int edge) { return "edge" + std::to_string(edge); }

int find_face(const std::vector<Face>& faces, const std::string& name) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int index = static_cast<int>(i);
    if (faces[i].name == name || edge_name(index) == name) return index;
  }
  return -1;
}

int face_towards(const std::vector<Face>& faces, const Vec2& n) {
  int best = -1;
  double best_dot = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double dot = faces[i].n.dot(n);
    if (faces[i].on_hull && dot > best_dot + kParallel) {
      best = static_cast<int>(i);
      best_dot = dot;
    }
  }
  return best;
}

OutlineProperties properties_of(const std::vector<Vec2>& outline) {
  OutlineProperties p;
  Eigen::Matrix2d about_origin = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    const double w = cross(a, b);
    p.area += 0.5 * w;
    p.centroid += w / 6.0 * (a + b);
    about_origin +=
        w / 24.0 *
        (a * a.transpose() + b * b.transpose() + (a + b) * (a + b).transpose());
  }
  p.centroid /= p.area;
  p.second = about_origin - p.area * p.centroid * p.centroid.transpose();
  return p;
}

double depth_inside(const std::vector<Vec2>& outline, const Vec2& p_O) {
  double squared_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
    squared_distance = std::min(
        squared_distance, squared_distance_to_segment(p_O, outline[before], outline[i]));
  }
  const double distance = std::sqrt(squared_distance);
  return is_inside(outline, p_O) ? distance : -distance;
}

bool contains(const std::vector<Vec2>& outline, const Vec2& p_O) {
  return depth_inside(outline, p_O) >= -1e-12;
}

bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return cross(q - p, r - p);
  };
  const auto overlap = [](double p, double q, double r, double s) {
    return std::max(p, q) >= std::min(r, s) && std::max(r, s) >= std::min(p, q);
  };
  // Rounding decides the sides of segments on one line: their boxes part them.
  return side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0 &&
         overlap(a.x(), b.x(), c.x(), d.x()) && overlap(a.y(), b.y(), c.y(), d.y());
}

bool is_simple(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (outline[i] == outline[(i + 1) % n]) return false;
    const Vec2 in = outline[(i + 1) % n] - outline[i];
    const Vec2 out = outline[(i + 2) % n] - outline[(i + 1) % n];
    if (cross(in, out) == 0.0 && in.dot(out) < 0.0) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segments_touch(outline[i], outline[i + 1], outline[j], outline[(j + 1) % n])) {
        return false;
      }
    }
  }
  return true;
}

bool is_convex(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = outline[(i + 1) % n] - outline[i];
    const Vec2 out = outline[(i + 2) % n] - outline[(i + 1) % n];
    if (!(cross(in, out) > 0.0)) return false;
  }
  return true;
}

bool is_reflex(const std::vector<Vec2>& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vec2& v = outline[i];
  return cross(v - outline[(i + n - 1) % n], outline[(i + 1) % n] - v) < 0.0;
}

double longer_side(const std::vector<Vec2>& outline) {
  Vec2 low = outline.front();
  Vec2 high = outline.front();
  for (const Vec2& v : outline) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

double half_thickness(const Shape& shape) { return std::visit(HalfThickness{}, shape); }

double reach_along_z(const Shape& shape) {
  double reach = half_thickness(shape);
  if (const auto* solid = std::get_if<SolidShape>(&shape)) {
    for (const Vec2& heights : solid->heights) {
      reach = std::max({reach, -heights.x(), heights.y()});
    }
  }
  return reach;
}

namespace {

/// Of a body whose coordinates have the second moments `spread` about its centroid, per
/// unit of mass.
Eigen::Matrix3d gyration(const Eigen::Matrix3d& spread) {
  return spread.trace() * Eigen::Matrix3d::Identity() - spread;
}

/// Centroid of a homogeneous body, and its second moments about it per unit of mass.
struct Homogeneous {
  Vec3 centroid = Vec3::Zero();                      // [m]
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  // [m^2]
};

Homogeneous homogeneous(const Shape& shape) {
  Homogeneous body;
  if (const auto* solid = std::get_if<SolidShape>(&shape)) {
    return {solid->centroid, solid->spread};
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    body.spread.diagonal().setConstant(0.25 * cylinder->radius * cylinder->radius);
    body.spread.diagonal()[static_cast<int>(cylinder->axis)] =
        cylinder->length * cylinder->length / 12.0;
    return body;
  }
  if (const PrismShape* lying = lying_prism(shape)) {
    const OutlineProperties section = properties_of(lying->outline);
    const int lateral = lying->axis == Axis::kX ? 1 : 0;
    body.centroid[lateral] = section.centroid.x();
    body.centroid.z() = section.centroid.y();
    body.spread(lateral, lateral) = section.second(0, 0) / section.area;
    body.spread(2, 2) = section.second(1, 1) / section.area;
    body.spread(lateral, 2) = body.spread(2, lateral) =
        section.second(0, 1) / section.area;
    body.spread(1 - lateral, 1 - lateral) = lying->thickness * lying->thickness / 12.0;
    return body;
  }
  const OutlineProperties outline = properties_of(outline_of(shape));
  const double half = half_thickness(shape);
  body.centroid.head<2>() = outline.centroid;
  body.spread.topLeftCorner<2, 2>() = outline.second / outline.area;
  body.spread(2, 2) = half * half / 3.0;
  return body;
}

}  // namespace

Vec2 centre_of_mass(const Object& object) {
  if (object.p_OCom) return *object.p_OCom;
  const bool is_flat =
      !lying_prism(object.shape) && !std::holds_alternative<SolidShape>(object.shape);
  if (is_flat) return properties_of(outline_of(object.shape)).centroid;
  return homogeneous(object.shape).centroid.head<2>();
}

double height_of_mass(const Object& object) {
  return object.p_OCom ? object.z_OCom : homogeneous(object.shape).centroid.z();
}

Eigen::Matrix3d inertia_of(const Object& object) {
  const Homogeneous body = homogeneous(object.shape);
  const Vec2 p_OCom = centre_of_mass(object);
  const Vec3 shift = Vec3(p_OCom.x(), p_OCom.y(), height_of_mass(object)) - body.centroid;
  Eigen::Matrix3d inertia =
      object.mass * gyration(body.spread + shift * shift.transpose());
  if (object.inertia) inertia(2, 2) = *object.inertia;
  return inertia;
}

double moment_of_inertia(const Object& object) { return inertia_of(object)(2, 2); }

}  // namespace prehensile
