/// Rolls in plans. The roll angle is an additive coordinate: a roll changes nothing in
/// the pad plane, and a push there nothing of the roll angle. So prisms roll from side to
/// side, to where they look as before (LyingPrism::same_after). Internal to the planner.
#pragma once

#include "planner/plan.h"

namespace prehensile {

/// How robustly a roll is possible: the least over the corners of the margin, at which
/// the roll is done as well. They are the friction of the support, weight over friction
/// of the fingers, half of which their grip is off and half their friction, the size of
/// the pads and the place of the finger axis. >= 0: rolls, and in one way only;
/// -infinity: does not, at all. A sample, as for pushes in space: no law tells where
/// between the corners a roll ends. Allocates.
///
/// Of a cylinder it is the lesser of friction of the support above the rolling threshold,
/// and of the share of the weight that the fingers cannot carry. Of a prism the friction
/// of the support above the steepest traction of the roll: a millisecond for each corner.
double roll_slack(const Model& model, const Grasp& start, const Roll& roll,
                  const Margin& margin);

/// Puts one roll by dpsi [rad] where the plan needs the fewest extra placements, with the
/// grip of the scene or the tightest of a few looser ones that rolls within the margin,
/// within the scene's limits and clear of its obstacles.
/// False if no contact can roll the object at any pose of the plan.
bool insert_roll(const Model& model, double dpsi, const Margin& margin,
                 const TransitionOptions& options, Plan& plan);

}  // namespace prehensile
