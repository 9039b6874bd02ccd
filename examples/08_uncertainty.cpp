/// How far a push can be trusted: the same push under frictions, pressures and placements
/// that are not known exactly, for a point and for a line pusher.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include "mechanics/model.h"
#include "primitives/transition.h"
#include "primitives/uncertainty.h"

using namespace prehensile;

namespace {

constexpr int kMembers = 200;

void spread_of(const char* what, const Scene& scene, const UncertaintyBox& box) {
  const Push push = LinearPush{.contact = 0, .place = 0.004, .travel = 0.015};
  const Grasp nominal = apply(prepare(scene), scene.start, push).end;
  std::vector<double> distance, angle;
  for (std::uint64_t i = 0; i < kMembers; ++i) {
    const UncertainPush member = vary(scene, scene.start, push, box, random_point(1, i));
    if (!check(member.scene).empty()) continue;  // beyond what a scene can be
    const Grasp end = apply(prepare(member.scene), member.start, member.push).end;
    distance.push_back(
        std::hypot(end.X_HO.x - nominal.X_HO.x, end.X_HO.y - nominal.X_HO.y));
    angle.push_back(std::abs(end.X_HO.theta - nominal.X_HO.theta));
  }
  std::sort(distance.begin(), distance.end());
  std::sort(angle.begin(), angle.end());
  const std::size_t most = distance.size() * 9 / 10;
  std::printf("%s: 90 %% of %zu members end within %.2f mm and %.2f deg\n", what,
              distance.size(), 1e3 * distance[most], 57.29577951308232 * angle[most]);
}

}  // namespace

int main() try {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.06, 0.03}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "pin", .feature = PointFeature{}, .friction = 0.3}};

  UncertaintyBox box;  // half widths
  box[Unknown::kFriction] = 0.2;
  box[Unknown::kFingerFriction] = 0.2;
  box[Unknown::kTorqueRadius] = 0.2;
  box[Unknown::kPlace] = 1e-3;
  spread_of("point", scene, box);
  scene.pushers[0].feature = LineFeature{};
  spread_of("line", scene, box);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
