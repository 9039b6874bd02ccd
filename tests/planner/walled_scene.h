/// Scenes of the published regrasps with other pads and pushers, and random moves there.
#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "planner/steering/steering.h"
#include "tests/planner/no_budget.h"
#include "tests/support/random.h"

namespace prehensile::testing {

/// A square or a T among three walls, as in the published regrasps.
inline Scene scene_with(const Pad& pad, const PusherFeature& feature, bool tee = false) {
  Scene scene;
  if (tee) {
    const std::vector<Vec2> outline = {{-0.05, -0.05}, {-0.02, -0.05}, {-0.02, -0.015},
                                       {0.05, -0.015}, {0.05, 0.015},  {-0.02, 0.015},
                                       {-0.02, 0.05},  {-0.05, 0.05}};
    scene.object.shape = PrismShape{outline, 0.03};
  } else {
    scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  }
  scene.object.mass = 0.5;
  scene.gripper.pad = pad;
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 25.0;
  scene.overhang = Overhang::kIgnore;
  scene.start.X_HO = pose_from_finger({-0.03, 0.0}, 0.0);
  for (const double angle : {0.0, 0.5 * std::numbers::pi, -0.5 * std::numbers::pi}) {
    Pusher wall;
    wall.name = "wall" + std::to_string(scene.pushers.size());
    wall.feature = feature;
    wall.friction = 0.9;
    wall.normal_angle = angle;
    scene.pushers.push_back(wall);
  }
  return scene;
}

inline FlatState random_state(Random& random) {
  return {random.in_box(0.05, 0.05), random.in(-3.0, 3.0)};
}

/// A goal near the start: moves of a few millimetres, small and large turns.
inline FlatState near(const FlatState& from, Random& random) {
  const double turn = (random.chance(0.5) ? 1.0 : -1.0) * random.log_in(1e-3, 3.0);
  return {from.p_OF + random.in_disc(0.03), from.theta + turn};
}

/// Random moves of a scene that stick, at most `wanted`.
inline std::vector<Move> sticking_moves(const SearchModel& search, int wanted,
                                        std::uint64_t seed) {
  Random random(seed);
  Work work{.budget = kNoBudget};
  std::vector<Move> moves;
  for (int i = 0; i < 200'000 && static_cast<int>(moves.size()) < wanted; ++i) {
    const FlatState from = random_state(random);
    const FlatState to = near(from, random);
    if (const auto move = direct_move(search, from, to, work)) moves.push_back(*move);
  }
  return moves;
}

}  // namespace prehensile::testing
