#include "planner/chains/scattered_push.h"

#include "planner/chains/direct_push.h"

namespace prehensile {
namespace {

constexpr int kRounds = 8;        // over all of the set
constexpr int kCloser = 4;        // rounds around the best member
constexpr double kNearer = 0.15;  // width of a round over that of the one before

}  // namespace

std::optional<Move> scattered_push(const SearchModel& search, const FlatState& start,
                                   const Goal& goal, double to_beat,
                                   Work& work) noexcept {
  std::optional<Move> best;
  if (goal.x && goal.y && goal.theta) return best;
  const auto look = [&](const Scatter& scatter) {
    const GoalPlaces places =
        scattered_places(*search.model, goal, start, scatter, search.margin);
    const auto move = direct_push(search, start, places, work);
    if (!move) return;
    const double distance = flat_distance(*search.model, move->from, move->to);
    if (!(distance < to_beat)) return;
    to_beat = distance;
    best = move;
  };
  for (int round = 0; round < kRounds; ++round) look({start, 1.0, round});
  double width = kNearer;
  for (int round = 0; best && round < kCloser; ++round) {
    look({best->to, width, round});
    width *= kNearer;
  }
  return best;
}

}  // namespace prehensile
