/// Best-first search over lattice nodes for plans of three and more pushes.
///
/// The state is (node, last contact, interval of rotation that the pushes so far can
/// produce): rotation is additive along straight pushes, so a label carries an interval
/// instead of an angle. A label is kept if it is the cheapest for some bucket of the
/// rotation; it dies when others are cheaper for all of its buckets.
#pragma once

#include <optional>
#include <vector>

#include "planner/chain.h"
#include "planner/goal.h"
#include "planner/limits.h"

namespace prehensile {

/// A solved chain and the member of the goal set that it ends in.
struct FoundChain {
  Chain chain;
  int place = -1, angle = -1;
};

/// The cheapest chain found that `steering` proposes, whose pushes stick with the real
/// pad over the margin of `search`, and which is cheaper than `to_beat` (infinity: there
/// is no plan yet, and the search goes on for longer); none if the search runs dry or a
/// limit is reached before. Both are of the same model.
std::optional<FoundChain> search_labels(const Steering& steering,
                                        const SearchModel& search,
                                        const std::vector<Vec2>& nodes,
                                        const FlatState& start, const GoalPlaces& goals,
                                        double to_beat, const Limits& limits, Work& work);

}  // namespace prehensile
