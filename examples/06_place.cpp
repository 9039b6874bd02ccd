/// Which push? First the motions that an edge can make without slipping (its motion
/// cone), then the place and grip force for a wanted pose, and the proof where there is
/// none.
#include <cstdio>
#include <exception>
#include <string>

#include "mechanics/model.h"
#include "primitives/motion_cone.h"
#include "primitives/place.h"

using namespace prehensile;

namespace {

constexpr double kDeg = 57.29577951308232;

void ask(const Model& model, const PlanarPose& to) {
  const PlaceAnswer answer =
      find_place(model, motion_between(model.scene.start.X_HO, to),
                 {.grip_low = 5, .grip_high = 40, .least_force = true});
  std::printf("to %.0f mm, %.0f mm, %.0f deg: %s\n", 1e3 * to.x, 1e3 * to.y,
              kDeg * to.theta, std::string(name(answer.status)).c_str());
  if (answer.best.found) {
    std::printf("  push force %.1f N at a grip of %.1f N\n", answer.best.push_force,
                answer.best.grip_force);
  }
  for (const ContactVerdict& verdict : answer.verdicts) {
    if (verdict.possible) continue;
    std::printf("  contact %d cannot: %s\n", verdict.contact,
                std::string(verdict.reason).c_str());
  }
}

}  // namespace

int main() try {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.04, 0.025}};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{.radius = 0.010};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "edge", .feature = LineFeature{0.03}, .friction = 0.5}};
  const Model model = prepare(scene);

  const ConeMember edge = cone_member(model, 0, 0.0, scene.start.X_HO);
  const MotionCone cone = motion_cone(edge, {});
  for (const DirectionRange& range : cone.nominal) {
    std::printf("the edge sticks from %.2f to %.2f deg from its normal\n",
                kDeg * range.lo, kDeg * range.hi);
  }
  ask(model, {0.010, 0.002, 0.0});
  ask(model, {-0.010, 0.0, 0.0});  // an edge cannot pull
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
