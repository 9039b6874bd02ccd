#include "scene/scene.h"

namespace prehensile {
namespace {

struct Resize {
  double factor;
  void operator()(DiscPad& disc) const { disc.radius *= factor; }
  void operator()(RectanglePad& rectangle) const { rectangle.size *= factor; }
  void operator()(LinePad& line) const { line.length *= factor; }
  void operator()(PolygonPad& polygon) const {
    for (Vec2& v : polygon.outline) v *= factor;
  }
  void operator()(PointPad& point) const {
    if (point.spin_radius) *point.spin_radius *= factor;
  }
};

}  // namespace

Pad resized(const Pad& pad, double factor) {
  Pad out = pad;
  std::visit(Resize{factor}, out);
  return out;
}

}  // namespace prehensile
