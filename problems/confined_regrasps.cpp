#include "problems/confined_regrasps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "problems/random_stream.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kWallDistance = 0.3;     // [m] of a wall from the origin of W
constexpr double kPlateThickness = 0.01;  // [m]
constexpr double kPlateSize = 0.3;        // [m] along the wall
constexpr double kHeight = 0.2;           // [m] of plates and posts, across the pad plane
constexpr double kFingerSide = 0.012;     // [m] of its section, and how far past the pads
constexpr double kFingerLength = 0.12;    // [m]
constexpr double kPalm = 0.03;            // [m] of its thickness
constexpr double kRoom = 0.002;           // [m] of a post from the object's way
constexpr int kMostDraws = 1000;

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

std::vector<ConvexBody> hand_around(double half_thickness) {
  std::vector<ConvexBody> hand;
  const double middle = 0.5 * (kFingerLength - kFingerSide);
  for (const double side : {-1.0, 1.0}) {
    const double z = side * (half_thickness + 0.5 * kFingerSide);
    hand.push_back({.name = side < 0.0 ? "finger 1" : "finger 2",
                    .shape = BoxShape{{kFingerLength, kFingerSide, kFingerSide}},
                    .position = {middle, 0.0, z}});
  }
  const double end = middle + 0.5 * kFingerLength;
  hand.push_back({.name = "palm",
                  .shape = BoxShape{{kPalm, 0.04, 2.0 * half_thickness + 0.04}},
                  .position = {end + 0.5 * kPalm, 0.0, 0.0}});
  return hand;
}

/// Whether a round post keeps out of the object's way to this wall: a strip as wide as
/// the object's reach, from the wall to the end of the approach.
bool keeps_out(const Pusher& wall, double reach, double approach, const Vec2& p,
               double radius) {
  const Vec2 n = direction(wall.normal_angle);
  const Vec2 d = p - wall.p_WP;
  return std::abs(d.dot(perp(n))) > reach + radius + kRoom ||
         d.dot(n) > 2.0 * reach + approach + radius + kRoom;
}

}  // namespace

Scene with_theta_window(Scene scene, double window) {
  const double start = scene.start.X_HO.theta;
  const double goal = start + wrapped(*scene.goal->theta - start);
  GraspLimits& limits = scene.limits.emplace();
  limits.theta_low = std::min(start, goal) - window;
  limits.theta_high = std::max(start, goal) + window;
  return scene;
}

Scene with_obstacles(Scene scene, int posts, std::uint64_t seed, std::uint64_t index) {
  Obstacles& obstacles = scene.obstacles.emplace();
  obstacles.hand = hand_around(half_thickness(scene.object.shape));
  double reach = 0.0;
  for (const Vec2& v : outline_of(scene.object.shape)) {
    reach = std::max(reach, v.cwiseAbs().maxCoeff());
  }
  for (Pusher& wall : scene.pushers) {
    const Vec2 n = direction(wall.normal_angle);
    wall.p_WP = -kWallDistance * n;
    wall.feature = LineFeature{.length = kPlateSize};
    const Vec2 middle = wall.p_WP - 0.5 * kPlateThickness * n;
    obstacles.fixture.push_back(
        {.name = wall.name,
         .shape = BoxShape{{kPlateThickness, kPlateSize, kHeight}},
         .position = {middle.x(), middle.y(), 0.0},
         .turn = wall.normal_angle});
  }
  RandomStream random(RandomStream(seed).bits() ^ (1000003 * index));
  for (int i = 0, draws = 0; i < posts && draws < kMostDraws; ++draws) {
    const Pusher& by = scene.pushers[static_cast<std::size_t>(i) % scene.pushers.size()];
    const Vec2 n = direction(by.normal_angle);
    const double radius = random.in(0.005, 0.010);
    const double along = random.in(-0.2, 0.2);
    const Vec2 p = by.p_WP + random.in(0.0, 0.3) * n + along * perp(n);
    const bool free =
        std::all_of(scene.pushers.begin(), scene.pushers.end(), [&](const Pusher& wall) {
          return keeps_out(wall, reach, obstacles.approach, p, radius);
        });
    if (!free) continue;
    obstacles.fixture.push_back(
        {.name = "post " + std::to_string(++i),
         .shape = CylinderShape{.radius = radius, .length = kHeight, .axis = Axis::kZ},
         .position = {p.x(), p.y(), 0.0}});
  }
  return scene;
}

}  // namespace prehensile
