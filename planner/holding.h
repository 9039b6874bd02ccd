/// Whether the pads alone hold gravity, as the exact mechanics asks, but cheap in the
/// cases that a search meets most. Internal to the planner.
#pragma once

#include "planner/steering.h"

namespace prehensile {

/// At one pose, for gravity g_O [m/s^2] in O. What cannot be told cheaply counts as work.
/// No heap.
bool pads_hold_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                       Work& work) noexcept;

/// At a few places along a move, with gravity of its contact; the exact check of a plan
/// looks at every instant. No heap.
bool pads_hold_gravity(const SearchModel& search, const Move& move, Work& work) noexcept;

}  // namespace prehensile
