/// Rolls in plans. The roll angle is an additive coordinate: a roll changes nothing in
/// the pad plane, and a push there nothing of the roll angle. Internal to the planner.
#pragma once

#include "planner/plan.h"

namespace prehensile {

/// How robustly a roll is possible: the lesser of friction of the support above the
/// rolling threshold, and of the share of the weight that the fingers cannot carry, over
/// the margins of friction and force. >= 0: rolls, and in one way only. -infinity: not a
/// support.
double roll_slack(const Model& model, const Roll& roll, const Margin& margin);

/// Puts one roll by dpsi [rad] where the plan needs the fewest extra placements, with the
/// grip of the scene or the tightest of a few looser ones that rolls within the margin.
/// False if no contact can roll the object at any pose of the plan.
bool insert_roll(const Model& model, double dpsi, const Margin& margin,
                 const TransitionOptions& options, Plan& plan);

}  // namespace prehensile
