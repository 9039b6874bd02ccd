/// One straight push to a goal: the first stage of the own planner. Internal to the
/// planner.
#pragma once

#include <optional>

#include "planner/steering/goal.h"

namespace prehensile {

/// The shortest single push to a place of the goal set, by the contact with the most
/// slack. No heap.
std::optional<Move> direct_push(const SearchModel& search, const FlatState& start,
                                const GoalPlaces& goals, Work& work) noexcept;

}  // namespace prehensile
