#include "problems/pad_shapes.h"

#include <cmath>
#include <numbers>

#include "mechanics/model.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

PolygonPad half_disc() {
  constexpr int kSides = 24;
  PolygonPad pad;
  for (int i = 0; i <= kSides; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / kSides - 0.5);
    pad.outline.push_back({std::cos(angle), std::sin(angle)});
  }
  const Vec2 centroid = properties_of(pad.outline).centroid;
  for (Vec2& v : pad.outline) v -= centroid;
  return pad;
}

}  // namespace

std::optional<Pad> pad_of_shape(std::string_view name) {
  if (name == "1:1") return RectanglePad{{1.0, 1.0}};
  if (name == "1:2") return RectanglePad{{0.5, 1.0}};
  if (name == "1:4") return RectanglePad{{0.25, 1.0}};
  if (name == "line") return LinePad{1.0, 0.5 * std::numbers::pi};
  if (name == "half_disc") return half_disc();
  return std::nullopt;
}

Scene with_pads(Scene scene, const Pad& shape) {
  const double torque_radius = prepare(scene).c;
  // Near the size in question, for scenes bound the size of pads.
  scene.gripper.pad = resized(shape, 2.0 * torque_radius);
  scene.gripper.pad = resized(scene.gripper.pad, torque_radius / prepare(scene).c);
  return scene;
}

}  // namespace prehensile
