/// Best-first search over lattice nodes for plans of three and more pushes.
///
/// The state is (node, last contact, rotation): rotation is additive along straight
/// pushes, so a label carries what the pushes so far cost for each rotation that they can
/// produce (turn_cost.h) instead of an angle. It is kept if it is the cheapest for some
/// bucket of the rotation (turn_buckets.h). What is still to be paid for the way and the
/// rotation that is missing comes from shortest ways back from the goal (turn_ahead.h).
#pragma once

#include <optional>
#include <vector>

#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "planner/steering/limits.h"

namespace prehensile {

/// A solved chain and the member of the goal set that it ends in.
struct FoundChain {
  Chain chain;
  int place = -1, angle = -1;
  double least = 0.0;  ///< J of what its search could find, from below; 0: not known

  /// Whether a search over more nodes, which knows what to beat and is short, may find
  /// something cheaper: where J is much more than that, it seldom does.
  bool is_near_least() const { return least == 0.0 || chain.cost <= 1.4 * least; }
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
