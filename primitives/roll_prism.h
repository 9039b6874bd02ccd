/// Rolling a prism over its edges (paper section VII-C): a support under a prism that
/// lies between the jaws moves along the closing direction, and the section tips about
/// the edge that stands on it, while the jaws open and close with the width of the
/// section.
///
/// While the support sticks and both jaws touch, the motion is geometry: the support has
/// travelled as far as the edge on it has moved against the jaws, which closed form holds
/// at every attitude. So the attitude is the variable, there is nothing to integrate, and
/// instants (mechanics/prism_section.h) are asked whether the object rolls: at every edge
/// and flat, just before, and at most a degree apart in between. What ends a roll is
/// located by bisection.
///
/// The finger axis keeps its height above the support, so O rises and sinks in the hand
/// (X_HO) as the section stands on an edge or lies on a side.
#pragma once

#include <vector>

#include "primitives/transition.h"

namespace prehensile {

/// Applies a roll to Model::prism. Sign of psi as in primitives/roll.h.
///
/// kCompleted; kLeftGuard where the support slides under the object (a partial roll: the
/// object has turned as far as `end` says) or drags it along; kAmbiguous where "the
/// fingers carry it" is a second motion; kFalls where weight and grip tip it on by
/// themselves; kJammed where both jaws stand still and the section gets wider, or where
/// the support wedges it; kPadLost where a pad has nothing to touch any more; kRefused:
/// pads that are not rectangles square to the object, independent jaws, a support that is
/// a point or not on a long side, gravity along the axis or the closing direction, pads
/// and support too short to keep the object from tilting or yawing.
Transition apply_prism_roll(const Model& model, const Grasp& start, const Roll& roll,
                            const TransitionOptions& options,
                            std::vector<Sample>* trace) noexcept;

}  // namespace prehensile
