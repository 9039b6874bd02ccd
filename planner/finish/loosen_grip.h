/// Relax, push, tighten: pushes with the least grip force that they survive.
#pragma once

#include "planner/steering/steering.h"

namespace prehensile {

/// Where the scene has a grip_range: each placement of a pusher gets one of the grip
/// forces with which its pushes stick within the margin and the grasp alone holds the
/// object before and after them: those that cost least (costs.h), of equal ones the
/// weakest.
/// The motion stays the same; forces fall with the grip. Rolls choose theirs themselves,
/// and about a point pusher an object would turn by another angle. Whether anything
/// changed.
bool loosen_grip(const SearchModel& search, Work& work, Plan& plan);

}  // namespace prehensile
