/// Rolling: a support moves along the closing direction under a cylinder, and under a
/// square bar that tips over its edges while the jaws open and close.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "mechanics/model.h"
#include "primitives/transition.h"

using namespace prehensile;

namespace {

Scene on_a_sheet(const Shape& shape) {
  Scene scene;
  scene.object.shape = shape;
  scene.object.mass = 0.25;
  scene.gripper.pad = RectanglePad{{0.03, 0.002}};
  scene.gripper.friction = {0.05, 0.05};
  scene.gripper.grip_force = 1.0;  // loose: the sheet carries the object
  Pusher sheet{.name = "sheet", .feature = PlaneFeature{}, .friction = 1.2};
  sheet.normal_angle = 1.5707963267948966;  // it supports the lower side, -y
  scene.pushers = {sheet};
  return scene;
}

void roll(const char* what, const Scene& scene, double travel) {
  const Model model = prepare(scene);
  std::vector<Sample> samples;
  const Transition out = apply(model, scene.start, Roll{0, travel}, {}, &samples);
  std::printf("%s: %s", what, std::string(name(out.status)).c_str());
  if (!out.completed()) std::printf(" (%s)", std::string(out.reason).c_str());
  std::printf(", turned by %.2f deg\n", 57.29577951308232 * out.end.psi);
  double widest = 0.0;
  for (const Sample& sample : samples) widest = std::max(widest, sample.opening);
  if (widest > 0.0) std::printf("  jaws open to %.2f mm\n", 1e3 * widest);
  for (int i = 0; i < out.event_count; ++i) {
    std::printf("  %s after %.2f mm\n", std::string(name(out.events[i].kind)).c_str(),
                1e3 * travel * out.events[i].s);
  }
}

}  // namespace

int main() try {
  roll("cylinder", on_a_sheet(CylinderShape{0.015, 0.1, Axis::kX}), 0.060);

  // Vertices of the section: [y, z] for a prism along x.
  const double a = 0.015;
  Scene bar = on_a_sheet(PrismShape{{{-a, -a}, {a, -a}, {a, a}, {-a, a}}, 0.1, Axis::kX});
  bar.start.X_HO.y = -0.011;  // held above its middle
  roll("square bar", bar, 0.060);

  bar.pushers[0].friction = 0.3;
  roll("on a smooth sheet", bar, 0.060);
  bar.pushers[0].friction = 1.2;
  bar.gripper.jaw_mode = JawMode::kLocked;
  roll("jaws that stand still", bar, 0.060);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
