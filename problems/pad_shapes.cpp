#include "problems/pad_shapes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "mechanics/model.h"

namespace prehensile {
namespace {

/// Of radius 1, open towards -x.
PolygonPad half_disc() {
  constexpr int kSides = 24;
  // Of a fan of isosceles triangles: twice the area and the first moment of each.
  constexpr double kStep = std::numbers::pi / kSides;
  const double cosine = std::cos(0.5 * kStep);
  double area = 0.0, moment = 0.0;
  PolygonPad pad;
  for (int i = 0; i <= kSides; ++i) {
    const double angle = -0.5 * std::numbers::pi + i * kStep;
    pad.outline.push_back({std::cos(angle), std::sin(angle)});
    if (i == kSides) break;
    area += std::sin(kStep);
    moment += std::sin(kStep) * 2.0 / 3.0 * cosine * std::cos(angle + 0.5 * kStep);
  }
  for (Vec2& v : pad.outline) v.x() -= moment / area;
  return pad;
}

Pad of_size_one(std::string_view shape) {
  if (shape == "1:1") return RectanglePad{{1.0, 1.0}};
  if (shape == "1:2") return RectanglePad{{0.5, 1.0}};
  if (shape == "1:4") return RectanglePad{{0.25, 1.0}};
  if (shape == "line") return LinePad{1.0, 0.5 * std::numbers::pi};
  return half_disc();
}

}  // namespace

bool is_pad_shape(std::string_view shape) {
  return std::find(std::begin(kPadShapes), std::end(kPadShapes), shape) !=
         std::end(kPadShapes);
}

Scene with_pads(Scene scene, std::string_view shape) {
  const double torque_radius = prepare(scene).c;
  // Near the size in question, for scenes bound the size of pads.
  scene.gripper.pad = resized(of_size_one(shape), 2.0 * torque_radius);
  const double factor = torque_radius / prepare(scene).c;
  scene.gripper.pad = resized(scene.gripper.pad, factor);
  return scene;
}

}  // namespace prehensile
