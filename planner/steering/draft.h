/// A plan while a search writes it: begun without pushes, pushes appended, and the search
/// concluded. Internal to the planner.
#pragma once

#include "planner/steering/chain.h"
#include "planner/steering/limits.h"

namespace prehensile {

/// A plan without pushes for this question: names, margin, seed, start.
Plan blank_plan(const SearchModel& search, const Grasp& start,
                const PlanOptions& options);

/// Appends the push of a move, from where the plan has come.
void append_move(const SearchModel& search, const Move& move, Plan& plan);

/// Appends the pushes of a solved chain.
void append_chain(const SearchModel& search, const FlatState& start, const Chain& chain,
                  Plan& plan);

/// Ends a search in the pad plane: adds the roll that the goal wants and sets the status,
/// with the limit that ended it where it found nothing.
void conclude_search(const SearchModel& search, const Goal& goal,
                     const PlanOptions& options, bool found, const Limits& limits,
                     Plan& plan);

/// No plan, for want of a roll; `where` none was found, for the message.
void say_no_roll(const char* where, Plan& plan);

}  // namespace prehensile
