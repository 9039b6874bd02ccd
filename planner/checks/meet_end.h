/// Pushes by a point, corrected. An object turns freely about a point, so where a push
/// ends is what the real pads make of it, not what the search took for it: the push is
/// aimed again, by the exact mechanics, until it ends where the plan says.
#pragma once

#include "planner/plan.h"

namespace prehensile {

/// Whether a point does this push, so that the object is free to turn about it.
bool is_by_point(const Model& model, const Push& push);

/// Whether one does any push of the plan.
bool has_pushes_by_points(const Model& model, const Plan& plan);

/// Newton's method with secant updates (Broyden, Math. Comp. 19 (1965) 577-593) over
/// direction, travel and place of each push by a point that ends elsewhere. Three numbers
/// for the three of a pose. Where it finds no such push, nearby, the straight way of the
/// push is done in two, four or eight parts, each by a push with a place of its own; if
/// these do not meet their ends either, the push stays as it is, for `check_exactly` to
/// refuse. Each push then begins where the one before really ends, as a replay with half
/// the step finds it: what an end misses, up to 1e-6 m, may grow in the pushes after it.
/// Counts instants.
void meet_ends(const Model& model, const TransitionOptions& options, Plan& plan);

}  // namespace prehensile
