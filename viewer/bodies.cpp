#include "viewer/bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prehensile::viewer {
namespace {

constexpr int kCircle = 48;        // vertices of a round pad
constexpr double kEndless = 2.5;   // drawn length over the size of the object
constexpr double kThinPad = 0.02;  // width of a line or point, over the object's

std::vector<Vec2> circle(double radius) {
  std::vector<Vec2> outline;
  outline.reserve(kCircle);
  for (int i = 0; i < kCircle; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircle;
    outline.push_back(rotated(angle, Vec2(radius, 0.0)));
  }
  return outline;
}

std::vector<Vec2> rectangle(double x, double y, double angle = 0.0) {
  std::vector<Vec2> outline{
      {-0.5 * x, -0.5 * y}, {0.5 * x, -0.5 * y}, {0.5 * x, 0.5 * y}, {-0.5 * x, 0.5 * y}};
  for (Vec2& p : outline) p = rotated(angle, p);
  return outline;
}

struct BodyOf {
  const Model& model;

  ObjectBody operator()(const BoxShape& box) const {
    return {.prisms = {{rectangle(box.size.x(), box.size.y()), -0.5 * box.size.z(),
                        0.5 * box.size.z(), Axis::kZ}}};
  }
  ObjectBody operator()(const CylinderShape& cylinder) const {
    return {.cylinders = {{cylinder.radius, cylinder.length, cylinder.axis}}};
  }
  ObjectBody operator()(const PrismShape& prism) const {
    return {.prisms = {{prism.outline, -0.5 * prism.thickness, 0.5 * prism.thickness,
                        prism.axis}}};
  }
  ObjectBody operator()(const SolidShape& solid) const {
    return {.prisms = {{solid.pad_face, -0.5 * solid.thickness, 0.5 * solid.thickness,
                        Axis::kZ}},
            .sides = model.faces};
  }
  ObjectBody operator()(const MeshShape&) const { return {}; }  // `check` refuses it
};

struct PadShape {
  double thin;  // [m] width of what has none

  PadBody operator()(const DiscPad& disc) const { return {circle(disc.radius), true}; }
  PadBody operator()(const RectanglePad& pad) const {
    return {rectangle(pad.size.x(), pad.size.y()), false};
  }
  PadBody operator()(const LinePad& line) const {
    return {rectangle(line.length, thin, line.angle), false};
  }
  PadBody operator()(const PolygonPad& polygon) const { return {polygon.outline, false}; }
  PadBody operator()(const PointPad&) const { return {circle(0.5 * thin), true}; }
};

}  // namespace

ObjectBody object_body(const Model& model) {
  return std::visit(BodyOf{model}, model.scene.object.shape);
}

PadBody pad_body(const Model& model) {
  return std::visit(PadShape{kThinPad * model.L}, model.scene.gripper.pad);
}

PusherBody pusher_body(const Model& model, const Pusher& pusher) {
  using Kind = PusherBody::Kind;
  const double endless = kEndless * 2.0 * reach_of(model);
  PusherBody body;
  body.kind = static_cast<Kind>(pusher.feature.index());
  static_assert(
      std::is_same_v<std::variant_alternative_t<1, PusherFeature>, LineFeature>);
  static_assert(
      std::is_same_v<std::variant_alternative_t<3, PusherFeature>, PlaneFeature>);
  const double length = length_in_plane(pusher.feature).value_or(0.0);
  const double width = width_across_plane(pusher.feature);
  body.goes_on_along = std::isinf(length);
  body.goes_on_across = std::isinf(width);
  body.length = body.goes_on_along ? endless : length;
  body.width = body.goes_on_across ? 2.0 * reach_of(model) : width;
  return body;
}

std::string_view name(PusherBody::Kind kind) {
  switch (kind) {
    case PusherBody::Kind::kPoint:
      return "point";
    case PusherBody::Kind::kLine:
      return "line";
    case PusherBody::Kind::kUpright:
      return "upright";
    case PusherBody::Kind::kPlane:
      return "plane";
  }
  return "unknown";
}

double reach_of(const Model& model) {
  double reach = reach_along_z(model.scene.object.shape);
  for (const Vec2& p : model.outline) reach = std::max(reach, p.norm());
  return reach;
}

}  // namespace prehensile::viewer
