/// The exact stages of the own planner, in order of effort. Internal to the own planner.
#pragma once

#include <optional>
#include <vector>

#include "planner/steering/goal.h"
#include "planner/steering/limits.h"

namespace prehensile {

class WalkLattices;

/// Pushes from the start to the goal in the pad plane: a single one; two, by way-points
/// from closed forms or of a lattice, over the ellipsoid and with what the pads
/// themselves allow; more, many short ones, loops and walks. Each sticks with the real
/// pads over the margin box. Unless SearchModel::looks_for_cheaper is false, a first plan
/// that is far from its guide bound is compared with others (cheapen.h), and one that
/// takes its place is counted in Work::found_cheaper. None where every stage ends
/// without, or a limit is reached. `lattices`: kept for other searches of the same
/// question.
std::optional<std::vector<Move>> search_plane(const SearchModel& search,
                                              const Grasp& start, const Goal& goal,
                                              WalkLattices& lattices,
                                              const Limits& limits, Work& work);

/// The stages of more than two pushes once more, to places that are off the goal by up to
/// its tolerances.
std::optional<std::vector<Move>> search_beside_goal(const SearchModel& search,
                                                    const Grasp& start, const Goal& goal,
                                                    WalkLattices& lattices,
                                                    const Limits& limits, Work& work);

}  // namespace prehensile
