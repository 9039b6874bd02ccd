/// Rolls in plans. The roll angle is an additive coordinate: a roll changes nothing in
/// the pad plane, and a push there nothing of the roll angle. So prisms roll from side to
/// side, to where they look as before (LyingPrism::same_after). Internal to the planner.
#pragma once

#include "planner/plan.h"

namespace prehensile {

/// How robustly a roll is possible, over the margins of friction and force. >= 0: rolls,
/// and in one way only; -infinity: does not, at all.
///
/// Of a cylinder the lesser of friction of the support above the rolling threshold, and
/// of the share of the weight that the fingers cannot carry. Of a prism the friction of
/// the support above the steepest traction, of rolls that are followed to their ends at
/// the corners of the margin (16, and the roll itself): milliseconds, and allocates.
double roll_slack(const Model& model, const Grasp& start, const Roll& roll,
                  const Margin& margin);

/// False for a prism among obstacles: its way over its edges is not looked at.
bool is_room_to_roll(const Model& model);

/// Puts one roll by dpsi [rad] where the plan needs the fewest extra placements, with the
/// grip of the scene or the tightest of a few looser ones that rolls within the margin.
/// False if no contact can roll the object at any pose of the plan.
bool insert_roll(const Model& model, double dpsi, const Margin& margin,
                 const TransitionOptions& options, Plan& plan);

}  // namespace prehensile
