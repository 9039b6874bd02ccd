/// Whether the pads alone hold gravity, as the exact mechanics asks, but cheap in the
/// cases that a search meets most. Internal to the planner.
#pragma once

#include "planner/steering/steering.h"

namespace prehensile {

/// At one pose, for gravity g_O [m/s^2] in O. What cannot be told cheaply counts as work.
/// No heap.
bool pads_hold_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                       Work& work) noexcept;

/// The same all over a margin: with the most weight over grip, the least torque radius,
/// and the centre of mass, the place in the hand and the tilt that load the pads most.
/// Pads that the face clips are clipped as without. No heap.
bool pads_hold_gravity(const Model& model, const PlanarPose& X_HO, const Vec2& g_O,
                       const Margin& margin, Work& work) noexcept;

/// At a few places along a move, with gravity of its contact; the exact check of a plan
/// looks at every instant. At its ends over the margin of the search, unless start or
/// goal have the object there (holding_check.h). No heap.
bool pads_hold_gravity(const SearchModel& search, const Move& move, Work& work) noexcept;

}  // namespace prehensile
