/// Shorter plans from long ones. Internal to the planner.
#pragma once

#include <vector>

#include "planner/steering/limits.h"

namespace prehensile {

/// Consecutive moves that are one straight move are joined.
std::vector<Move> joined_moves(const SearchModel& search, const std::vector<Move>& moves);

/// The cheapest way through the states of a sequence of moves that joins them by single
/// pushes, and then, over and over, by two pushes through a crossing of cone lines; J
/// never rises. Every push sticks with the real pad over the margin box. `moves` is not
/// empty.
std::vector<Move> shortened(const SearchModel& search, const std::vector<Move>& moves,
                            const Limits& limits, Work& work);

/// The same by two pushes through a node of a lattice: more is found, for some hundred
/// times the work.
std::vector<Move> shortened_over_lattice(const SearchModel& search,
                                         const std::vector<Move>& moves,
                                         const Limits& limits, Work& work);

/// J of a sequence of moves.
double cost_of(const SearchModel& search, const std::vector<Move>& moves);

}  // namespace prehensile
