/// Feasible rotations of a straight push, measured with the real pads instead of the
/// closed form over the ellipsoid. Internal to the planner.
#pragma once

#include "planner/steering/steering.h"

namespace prehensile {

/// The kappas of a set of trial values, with refined ends, at which the contact sticks
/// with the real pads over the margin box at points along from -> to, whatever the angle
/// of the object in the hand: the worst of a few orientations of the pads is taken unless
/// they are discs, which a can touches along a line that is the same at all angles. For
/// cans; PadEnvelope does flat faces. Gravity need not be held. A proposal: the push
/// itself is to be checked. About a thousand times slower than the closed form. No heap.
KappaSet measured_kappas(const SearchModel& search, int contact, const Vec2& from,
                         const Vec2& to, Work& work) noexcept;

}  // namespace prehensile
