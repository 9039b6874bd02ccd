/// What happens at this instant? A line pusher against a box in the jaws: the least force
/// that breaks the grasp, and how the box then moves.
#include <cstdio>
#include <exception>
#include <string>

#include "mechanics/certificate.h"
#include "mechanics/model.h"
#include "mechanics/planar_instant.h"

using namespace prehensile;

namespace {

Scene box_in_jaws() {
  Scene scene;  // all inputs in SI units
  scene.object.shape = BoxShape{{0.10, 0.06, 0.03}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "wall", .feature = LineFeature{}, .friction = 0.4}};
  return scene;
}

}  // namespace

int main() try {
  const Model model = prepare(box_in_jaws());  // throws BadScene, which names every fault

  const PlanarPose X_HO{};  // the box is centred in the hand
  const PushContact& contact = model.contacts.front();
  const PlanarGrasp grasp = grasp_at(model, X_HO, contact.g_O);
  const PlanarDrive drive = drive_at(contact, 0.0, X_HO, {0.010, 0.0, 0.0});

  const PlanarInstant now = solve_planar(grasp, drive);  // noexcept, no allocation
  std::printf("%s at %.3f N\n", std::string(name(now.status)).c_str(), now.push_force);
  if (!usable(now.status)) return 1;

  std::printf("object twist in the hand: %.3f mm/s, %.3f mm/s, %.3f rad/s\n",
              1e3 * now.V_HO[0], 1e3 * now.V_HO[1], now.V_HO[2]);
  for (int i = 0; i < now.pusher_count; ++i) {
    const PusherPoint& point = now.pusher[i];
    std::printf("pusher point %d: %s, %.3f N normal\n", i,
                std::string(name(point.mode)).c_str(), point.normal_force);
  }
  const Certificate certificate = certify(grasp, drive, now);  // not by the solver
  std::printf("certificate %s\n", certificate.holds() ? "holds" : "fails");
  return certificate.holds() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
