#include "planner/chains/direct_push.h"

#include <limits>

#include "planner/steering/chain.h"
#include "planner/steering/confines.h"
#include "planner/steering/holding.h"

namespace prehensile {
namespace {

/// The contact with the most slack for one straight move, by the real pad alone.
std::optional<Move> best_contact(const SearchModel& search, const FlatState& from,
                                 const FlatState& to, Work& work) noexcept {
  std::optional<Move> best;
  double best_slack = -kStickTolerance;
  for (std::size_t i = 0; i < search.contacts.size(); ++i) {
    const Move move{static_cast<int>(i), from, to};
    const double slack = exact_slack(search, move, work);
    if (!(slack >= -kStickTolerance)) {
      work.stopped_by.add(constraint_of(search.contacts[i], from.p_OF, to.p_OF));
    }
    if (!(slack > best_slack) || !pads_hold_gravity(search, move, work) ||
        !is_confined(search, move, work)) {
      continue;
    }
    best_slack = slack;
    best = move;
  }
  return best;
}

}  // namespace

std::optional<Move> direct_push(const SearchModel& search, const FlatState& start,
                                const GoalPlaces& goals, Work& work) noexcept {
  std::optional<Move> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < goals.count; ++i) {
    const GoalPlace& place = goals.places[i];
    bool on_object = false;
    for (int j = 0; j < place.count; ++j) {
      const FlatState end{place.p_OF, place.theta[j]};
      const double distance = flat_distance(*search.model, start, end);
      if (distance >= best_distance) continue;
      on_object = on_object || path_on_object(*search.model, {start.p_OF, true},
                                              {place.p_OF, true}, search.margin);
      if (!on_object) break;
      if (const auto move = best_contact(search, start, end, work)) {
        best = move;
        best_distance = distance;
      }
    }
  }
  return best;
}

}  // namespace prehensile
