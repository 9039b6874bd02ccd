/// Regrasps among the published walls with limits on the angle, or with obstacles around.
/// Deterministic.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace prehensile {

/// The scene with limits on theta: those of start and goal (by the nearest whole turn)
/// and `window` [rad] beyond either. Needs a goal with an angle.
Scene with_theta_window(Scene scene, double window);

/// The scene with bodies, among the published walls: two fingers and a palm towards +x of
/// H, a plate of 10 mm behind each wall, which stand 0.3 m off the origin of W, and
/// `posts` upright round posts of 5 to 10 mm radius at random places that the object does
/// not come to. What is drawn follows from (seed, index).
Scene with_obstacles(Scene scene, int posts, std::uint64_t seed, std::uint64_t index);

}  // namespace prehensile
