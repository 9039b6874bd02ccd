#include "mjcf/looks.h"

#include <algorithm>

#include "scene/pad_quadrature.h"
#include "scene/polygon_pieces.h"

namespace prehensile::mjcf {
namespace {

constexpr const char* kObjectColour = "0.45 0.62 0.82 0.6";
constexpr const char* kPadColour = "0.2 0.22 0.25 0.5";
constexpr double kThickPad = 0.004;  // [m]
constexpr double kThinPad = 0.0005;  // [m] half width of a line, radius of a point

void show_prism(XMLElement* body, const char* mesh, const char* rgba) {
  set(add_look(body, "mesh", rgba), "mesh", std::string(mesh));
}

struct ShowObject {
  XMLElement* body;
  XMLElement* asset;
  const Model& model;

  void operator()(const BoxShape& box) const {
    set(add_look(body, "box", kObjectColour), "size", Vec3(0.5 * box.size));
  }
  void operator()(const CylinderShape& cylinder) const {
    XMLElement* look = add_look(body, "cylinder", kObjectColour);
    set(look, "size", text({cylinder.radius, 0.5 * cylinder.length}));
    set(look, "zaxis", Vec3(Vec3::Unit(static_cast<int>(cylinder.axis))));
  }
  void operator()(const PrismShape& prism) const {
    const double half = 0.5 * prism.thickness;
    if (!model.prism) {
      add_prism_asset(asset, "object", prism.outline, -half, half);
    } else {
      const Vec2& lateral = model.prism->lateral;
      add_prism_asset(asset, "object", prism.outline, -half, half,
                      {lateral.x(), lateral.y(), 0.0}, Vec3::UnitZ());
    }
    show_prism(body, "object", kObjectColour);
  }
  /// By its silhouette: the triangles of the file are not in a scene.
  void operator()(const SolidShape& solid) const {
    const double half = 0.5 * solid.thickness;
    add_prism_asset(asset, "object", solid.outline, -half, half);
    show_prism(body, "object", kObjectColour);
  }
  void operator()(const MeshShape&) const {}  // `check` refuses it
};

struct ShowPad {
  XMLElement* hand;
  XMLElement* asset;
  double z;  // of its middle

  void operator()(const DiscPad& pad) const {
    XMLElement* look = add_look(hand, "cylinder", kPadColour);
    set(look, "size", text({pad.radius, 0.5 * kThickPad}));
    set(look, "pos", at());
  }
  void operator()(const RectanglePad& pad) const { box(0.5 * pad.size, 0.0); }
  void operator()(const LinePad& pad) const {
    box({0.5 * pad.length, kThinPad}, pad.angle);
  }
  void operator()(const PointPad&) const {
    XMLElement* look = add_look(hand, "cylinder", kPadColour);
    set(look, "size", text({kThinPad, 0.5 * kThickPad}));
    set(look, "pos", at());
  }
  void operator()(const PolygonPad& pad) const {
    const std::string name = z < 0.0 ? "pad_1" : "pad_2";
    add_prism_asset(asset, name, pad.outline, z - 0.5 * kThickPad, z + 0.5 * kThickPad);
    show_prism(hand, name.c_str(), kPadColour);
  }

  Vec3 at() const { return {0.0, 0.0, z}; }
  void box(const Vec2& half, double angle) const {
    XMLElement* look = add_look(hand, "box", kPadColour);
    set(look, "size", Vec3(half.x(), half.y(), 0.5 * kThickPad));
    set(look, "pos", at());
    set(look, "quat", about_z(angle));
  }
};

}  // namespace

void show_object(XMLElement* body, XMLElement* asset, const Model& model) {
  std::visit(ShowObject{body, asset, model}, model.scene.object.shape);
}

void show_pads(XMLElement* hand, XMLElement* asset, const Model& model) {
  const double z = model.half_thickness + 0.5 * kThickPad;
  for (const double side : {-1.0, 1.0}) {
    std::visit(ShowPad{hand, asset, side * z}, model.scene.gripper.pad);
  }
}

void add_prism_asset(XMLElement* asset, const std::string& name,
                     const std::vector<Vec2>& outline, double low, double high,
                     const Vec3& u, const Vec3& v) {
  const Vec3 w = u.cross(v);
  const std::size_t n = outline.size();
  std::vector<double> vertices;
  for (const double height : {low, high}) {
    for (const Vec2& p : outline) {
      const Vec3 at = p.x() * u + p.y() * v + height * w;
      vertices.insert(vertices.end(), {at.x(), at.y(), at.z()});
    }
  }
  std::vector<double> corners;  // three indices per triangle, outside to the left
  const auto add = [&corners](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t i : {a, b, c}) corners.push_back(static_cast<double>(i));
  };
  const auto index = [&outline](const Vec2& p) {
    return static_cast<std::size_t>(std::find(outline.begin(), outline.end(), p) -
                                    outline.begin());
  };
  for (const Triangle& triangle : triangulate(outline)) {
    const std::size_t a = index(triangle.vertices[0]);
    const std::size_t b = index(triangle.vertices[1]);
    const std::size_t c = index(triangle.vertices[2]);
    add(a, c, b);
    add(n + a, n + b, n + c);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    add(i, j, n + j);
    add(i, n + j, n + i);
  }
  XMLElement* mesh = child(asset, "mesh");
  set(mesh, "name", name);
  set(mesh, "vertex", text(vertices));
  set(mesh, "face", text(corners));
}

double reach_of(const Model& model) {
  double reach = 0.0;
  for (const Vec2& p : model.outline) reach = std::max(reach, p.norm());
  return reach;
}

}  // namespace prehensile::mjcf
