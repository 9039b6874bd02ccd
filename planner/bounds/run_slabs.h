/// What a run by one contact costs at least where the convex program of run_bound.h says
/// little: that sums each inequality of a sticking instant for itself, while gravity
/// helps with one only in motions that another denies. Internal to the planner.
///
/// A run no longer than `cap` stays in the ellipse around its ends that such ways reach.
/// For any direction u ahead and any share in (-1, 1), it advances all of the way along u
/// and pays the least that the contact asks for that, all inequalities together, in each
/// of some slabs across u:
///     T >= share c dtheta + sum over slabs of width x least (dT - share c dtheta) / u.dp
#pragma once

#include "planner/bounds/run_bound.h"
#include "planner/pads/local_law.h"

namespace prehensile {

/// A bound on the travel of every run from the start to the goal [m], at most `cap`; 0
/// where the law is not known. `run`: its laws are not asked. `known` [m]: a bound that
/// there is already; less is not looked for, and looks follow those before them, so that
/// now and then up to a tenth is missed that would be more. Some milliseconds, up to 15.
/// Allocates.
double travel_across_slabs(const LocalLaw& law, const RunQuestion& run,
                           double known = 0.0);

}  // namespace prehensile
