/// Lines that part an outline at its notches. Internal to the planner.
#pragma once

#include "planner/bounds/word_node.h"

namespace prehensile {

/// Of each notch the shortest diagonal that parts the outline into the two sides of its
/// line, if there is one.
std::vector<Portal> portals_of(const std::vector<Vec2>& outline);

}  // namespace prehensile
