/// Rows of places for walks through narrow ways. Internal to the own planner.
///
/// Where some contacts push one way and others push back, and their headings leave out
/// little less than half a turn, tacking between the two leads everywhere: along headings
/// of which no lattice of equal spacings has two.
#pragma once

#include <span>
#include <vector>

#include "planner/walks/walk_gap.h"

namespace prehensile {

/// Rows along such headings at some places across gaps that a lattice leaves, those whose
/// way is widest first: lattices with these rows have some headings within it. None where
/// walks leave no gap or no way is narrow.
std::vector<Rows> rows_across(const WalkLattice& lattice, std::span<const WalkGap> gaps,
                              Work& work);

}  // namespace prehensile
