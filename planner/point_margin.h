/// The margin of plans whose object turns about points: no closed form knows the way that
/// it takes elsewhere in the box, so the whole plan is done by members of the box.
#pragma once

#include <string>

#include "planner/plan.h"

namespace prehensile {

/// Why a plan with pushes by points does not survive its margin, or an empty text; empty
/// also for other plans and for no margin.
///
/// 32 corners of the box, the same for every plan, with the least friction of the
/// pushers: in each the object is followed from push to push, from wherever the one
/// before left it, and every push has to be done to its end without slip. Where the
/// fingers do not hold the object at its start or at its goal, which are given, it is the
/// corner with the least mass instead, or none. A sample, and no proof: the slack of each
/// push along its nominal way is looked at as well. Allocates.
std::string point_margin_fault(const Model& model, const Plan& plan,
                               const TransitionOptions& options);

/// Whether in any of these corners the fingers alone do not hold the object where such a
/// plan begins, or where it ends; false of other plans. Allocates.
bool point_plan_may_fall(const Model& model, const Plan& plan);

}  // namespace prehensile
