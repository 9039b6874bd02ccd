#include "problems/random_regrasps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "problems/push_chain.h"
#include "problems/tee_prism.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

PrismShape random_tee(RandomStream& random) {
  const double width = random.in(0.06, 0.14);
  const double bar = random.in(0.25, 0.4) * width;
  const double length = random.in(0.7, 1.2) * width;
  const double stem = 0.5 * random.in(0.25, 0.45) * width;
  return tee_prism(length, width, bar, stem);
}

Shape random_shape(RegraspFamily family, RandomStream& random) {
  switch (family) {
    case RegraspFamily::kBox:
      return BoxShape{{random.in(0.04, 0.15), random.in(0.04, 0.15), 0.03}};
    case RegraspFamily::kTee:
      return random_tee(random);
    case RegraspFamily::kCylinder:
      break;
  }
  return CylinderShape{.radius = random.in(0.02, 0.045),
                       .length = random.in(0.06, 0.15),
                       .axis = random.chance(0.5) ? Axis::kX : Axis::kY};
}

/// Angles of the pushers' normals in W: 2 to 4 of the four sides, a can with a long one.
std::vector<double> random_normals(const Shape& shape, RandomStream& random) {
  std::array<double, 4> sides = {0.0, 0.5 * kPi, -0.5 * kPi, kPi};
  for (int i = 3; i > 0; --i) std::swap(sides[i], sides[random.below(i + 1)]);
  const auto* can = std::get_if<CylinderShape>(&shape);
  const double support = can && can->axis == Axis::kY ? 0.0 : 0.5 * kPi;
  if (can) std::swap(sides[0], *std::find(sides.begin(), sides.end(), support));
  return {sides.begin(), sides.begin() + 2 + random.below(3)};
}

Vec2 random_gravity(const Scene& scene, RandomStream& random) {
  const bool can = can_roll(scene.object);
  if (can) return rotated(scene.pushers[0].normal_angle, {-9.81, 0.0});
  if (random.chance(0.1)) return Vec2::Zero();
  return rotated(random.in(-kPi, kPi), {9.81, 0.0});
}

Scene random_scene(RegraspFamily family, RandomStream& random) {
  Scene scene;
  scene.origin = "random pushes, feasible by construction";
  scene.object.shape = random_shape(family, random);
  scene.object.mass = random.log_in(0.05, 0.6);
  const double radius = random.in(0.005, 0.012);
  scene.gripper.pad = DiscPad{radius};
  if (family == RegraspFamily::kCylinder && random.chance(0.5)) {
    scene.gripper.pad = RectanglePad{{2.0 * radius, 2.0 * radius}};
  }
  const double friction = random.in(0.3, 1.0);
  scene.gripper.friction = {friction, friction};
  const double weight = 9.81 * scene.object.mass;
  scene.gripper.grip_force = random.log_in(1.5, 10.0) * weight / (2.0 * friction);
  if (random.chance(0.5)) scene.overhang = Overhang::kIgnore;
  const double pusher_friction = random.in(0.3, 1.0);
  for (const double angle : random_normals(scene.object.shape, random)) {
    scene.pushers.push_back({.name = "wall" + std::to_string(scene.pushers.size()),
                             .feature = LineFeature{},
                             .friction = pusher_friction,
                             .normal_angle = angle});
  }
  scene.g_W = random_gravity(scene, random);
  return scene;
}

/// A place on the object that every contact leaves held.
bool find_start(const std::vector<Vec2>& outline, const Model& model,
                RandomStream& random, PlanarPose& start) {
  for (int i = 0; i < 200; ++i) {
    const Vec2 p_OF{random.in(-0.1, 0.1), random.in(-0.1, 0.1)};
    const bool good = depth_inside(outline, p_OF) > 2e-3 && held_by_all(model, p_OF);
    start = pose_from_finger(p_OF, random.in(-kPi, kPi));
    if (good) return true;
  }
  return false;
}

}  // namespace

RandomRegrasp random_regrasp(RegraspFamily family, std::uint64_t seed,
                             std::uint64_t index) {
  RandomStream random(RandomStream(seed).bits() ^ (1000003 * index) ^
                      (static_cast<std::uint64_t>(family) << 56));
  const bool two_pushers = index % 2 == 0;
  const bool rolls = family == RegraspFamily::kCylinder && index % 3 != 0;
  for (;;) {
    RandomRegrasp problem;
    problem.scene = random_scene(family, random);
    problem.scene.name = "random regrasp " + std::to_string(index);
    PlanarPose& start = problem.scene.start.X_HO;
    if (!find_start(outline_of(problem.scene.object.shape), prepare(problem.scene),
                    random, start)) {
      continue;
    }
    if (!check(problem.scene).empty()) continue;
    const Model model = prepare(problem.scene);
    const ChainRange range{
        .least = two_pushers ? 2 : 1, .two_pushers = two_pushers, .rolls = rolls};
    if (append_chain(model, range, random, problem)) return problem;
  }
}

}  // namespace prehensile
