/// One push, start to end: a point pusher off the middle of a box turns it, slips, and
/// the transition says when, why and with what force.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "mechanics/model.h"
#include "primitives/transition.h"

using namespace prehensile;

int main() try {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.06, 0.03}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "pin", .feature = PointFeature{}, .friction = 0.2}};
  const Model model = prepare(scene);

  const LinearPush push{.contact = 0, .place = 0.014, .e = {1.0, 0.0}, .travel = 0.020};
  std::vector<Sample> samples;
  const Transition transition = apply(model, scene.start, push, {}, &samples);

  std::printf("%s, end pose %.2f mm, %.2f mm, %.2f deg\n",
              std::string(name(transition.status)).c_str(), 1e3 * transition.end.X_HO.x,
              1e3 * transition.end.X_HO.y, 57.29577951308232 * transition.end.X_HO.theta);
  for (int i = 0; i < transition.event_count; ++i) {
    const Event& event = transition.events[i];
    std::printf("%s after %.2f mm\n", std::string(name(event.kind)).c_str(),
                20.0 * event.s);
  }
  std::printf("force %.2f N at the start, %.2f N at the end\n",
              samples.front().push_force, samples.back().push_force);
  return transition.completed() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
