/// Proofs that no push can begin at the start of a scene, or end at its goal, because the
/// hand or the object would be in the way of obstacles there, or of each other. Internal
/// to the planner; shares no code with its search.
#pragma once

#include "mechanics/model.h"

namespace prehensile {

/// Whether at every contact, wherever along the face its pusher stands, a push that
/// begins at the start would have the hand nearer to the fixture than it may be, or the
/// object in it: while it pushes, or in the approach before. Or the object is nearer to a
/// body of the hand (`palm_bodies`) than it may be.
bool is_blocked_at_start(const Model& model);

/// The same of every push that ends at a pose of the goal, and the retreat after it.
/// False where the goal leaves a coordinate free, or the object can be rolled.
bool is_blocked_at_goal(const Model& model);

}  // namespace prehensile
