/// Barriers: regions of places of the finger axis that hold the start and not the goal,
/// and that no push leaves. Internal to the planner.
///
/// Where the finger axis can go, and by how much the object turns on the way, depends on
/// its place in the object alone, so that a region of places that cannot be
/// left is a proof for every angle and every number of turns.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planner/plan.h"

namespace prehensile {

/// A region that `verify_barrier` accepts, or none. Looked for among the regions whose
/// border is cheap to reach: a field says by how much a way from the start has to leave
/// what the laws allow (the part of it across the allowed directions [m]), and its levels
/// are tried. Only for pads with a law at every place (local_law.h, clipped_law.h), and
/// goals that fix the place. None when `stopped` says so in between. The work is limited.
Loops find_barrier(const Model& model, const std::function<bool()>& stopped = {});

/// Whether the region holds the start and not the goal, and no push leaves it: `why`
/// (nullptr: not wanted) says what fails. Each piece of its border on the object is
/// looked at with every contact and every direction outwards, and cut until the laws
/// exclude them, or the pads would let go of the object there in that contact's attitude.
/// `weak`: a place near which the border is looked at first, if there is one; receives
/// where a push may cross it.
bool verify_barrier(const Model& model, const Loops& region, std::string* why,
                    std::optional<Vec2>* weak = nullptr);

/// Whether the region has a border that no push crosses outwards, whatever it holds.
bool is_never_left(const Model& model, const Loops& region, std::string* why = nullptr);

/// Distance of a place from the border of a region, negative outside [m].
double depth_in_region(const Loops& region, const Vec2& p_OF);

/// Whether every place of a goal set that fixes the place is outside a region.
bool goal_is_outside(const Loops& region, const Goal& goal);

}  // namespace prehensile
