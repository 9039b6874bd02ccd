/// How hard to grip: the range of grip forces with which a slide does what it should, and
/// what its phases need along the way.
#include <cstdio>
#include <exception>
#include <string>

#include "mechanics/model.h"
#include "primitives/grip_range.h"

using namespace prehensile;

int main() try {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.04, 0.025}};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{.radius = 0.010};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "edge", .feature = LineFeature{0.03}, .friction = 0.5}};
  scene.start.X_HO.x = -0.015;
  const Model model = prepare(scene);

  const Slide slide{.contact = 0, .e = {1.0, 0.0}, .travel = 0.030};
  const GripRange range = grip_range(model, scene.start, slide, {.samples = 3});
  if (!range.found) {
    std::printf("no grip force will do: %s\n", std::string(range.reason).c_str());
    return 1;
  }
  std::printf("from %.3f N", range.low.force);
  std::printf(range.high.is_open ? " up\n" : " to %.3f N\n", range.high.force);
  std::printf("below: %s, %.3f mm from where it should end\n",
              std::string(name(range.low.outside.status)).c_str(),
              1e3 * range.low.strayed);
  std::printf("the grasp alone holds from %.3f N before and %.3f N after\n",
              range.hold_start, range.hold_end);
  for (const GripSample& at : range.profile) {
    std::printf("%3.0f %%: hold %.3f N, the edge sticks from %.3f N\n", 100.0 * at.s,
                at.hold, at.stick_low);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
