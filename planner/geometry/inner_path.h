/// Shortest paths of the finger axis inside the face that the pads touch. Internal to the
/// planner.
#pragma once

#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// Way-points of a short path from p to q inside the closed polygon, both included: the
/// straight segment, or one that turns near reflex corners. Empty if none is found (p or
/// q outside).
std::vector<Vec2> inner_path(const std::vector<Vec2>& outline, const Vec2& p,
                             const Vec2& q);

double path_length(const std::vector<Vec2>& path);

/// Points along the path: its corners, and between them equal steps of about 1 / `pieces`
/// of its length.
std::vector<Vec2> cut_path(const std::vector<Vec2>& path, int pieces);

}  // namespace prehensile
