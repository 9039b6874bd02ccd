/// One straight push to a goal that leaves a coordinate free. Internal to the planner.
#pragma once

#include <optional>

#include "planner/steering/goal.h"

namespace prehensile {

/// A short push to a goal set that goal_places knows in coarse steps only: by members
/// scattered over all of it, then closer and closer around the nearest that a push leads
/// to. Nothing where the goal fixes all, or none is nearer than `to_beat` [m]. About a
/// thousand members. No heap.
std::optional<Move> scattered_push(const SearchModel& search, const FlatState& start,
                                   const Goal& goal, double to_beat, Work& work) noexcept;

}  // namespace prehensile
