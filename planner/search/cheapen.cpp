#include "planner/search/cheapen.h"

#include <cstdint>
#include <utility>

#include "planner/chains/chain_search.h"
#include "planner/chains/shorten.h"
#include "planner/steering/roll_step.h"
#include "planner/walks/walk_search.h"

namespace prehensile {
namespace {

/// Of what is left of the budget.
constexpr double kShareOfPairs = 0.6;
constexpr double kShareOfWalk = 0.3;
constexpr double kShareOfContacts = 0.5;

/// With a margin, plans end at the goal if they can: an end at the border of the
/// tolerances is one that little of the box reaches.
bool is_worth_a_look(const SearchModel& search, const GoalPlaces& beside) {
  return beside.count > 0 && search.margin.is_none();
}

void enter(const char* stage, double cost, Work& work) {
  if (!work.meter) return;
  work.meter->enter(stage);
  work.meter->found(cost);
}

}  // namespace

std::vector<Move> cheaper_by_pairs(const SearchModel& search, std::vector<Move> moves,
                                   const Limits& limits, Work& work) {
  const double cost = cost_of(search, moves);
  if (cost < kDear) return moves;
  enter("cheaper pushes", cost, work);
  moves = within_budget(work, share_of_left(work, kShareOfPairs), [&] {
    return shortened_over_lattice(search, moves, limits, work);
  });
  if (work.meter) work.meter->found(cost_of(search, moves));
  return moves;
}

void cheaper_with_real_pads(const FlatState& start, const GoalPlaces& goals,
                            const GoalPlaces& beside, const Limits& limits, Work& work,
                            BestMoves& best) {
  const SearchModel& search = best.search();
  if (can_roll(search.model->scene.object) || search.model->has_soft_points()) return;
  const PadEnvelope pads(*search.model, search.margin);
  for (const GoalPlaces* places : {&goals, &beside}) {
    if (places == &beside && !is_worth_a_look(search, beside)) continue;
    const double worth = places == &goals ? 1.0 : kWorthTolerance;
    const auto found = search_chains_of_real_pads(search, start, *places, &pads,
                                                  worth * best.cost(), limits, work);
    if (found) best.offer(moves_of(search, start, found->chain), worth);
  }
  if (work.meter) work.meter->found(best.cost());
}

void cheaper_by_one_contact(const FlatState& start, const GoalPlaces& goals,
                            const GoalPlaces& beside, const Limits& limits, Work& work,
                            BestMoves& best) {
  const SearchModel& search = best.search();
  enter("walks by one contact", best.cost(), work);
  const std::int64_t share =
      share_of_left(work, kShareOfContacts / static_cast<double>(search.contacts.size()));
  for (int i = 0; i < static_cast<int>(search.contacts.size()); ++i) {
    SearchModel one = search;  // there are no walks among obstacles, which know contacts
    one.contacts = {search.contacts[i]};
    WalkLattices lattices;
    within_budget(work, share, [&] {
      for (const GoalPlaces* places : {&goals, &beside}) {
        if (places == &beside && !is_worth_a_look(search, beside)) continue;
        const double worth = places == &goals ? 1.0 : kWorthTolerance;
        auto moves = search_walks(one, start, *places, worth * best.cost(), lattices,
                                  limits, work);
        if (!moves) continue;
        for (Move& move : *moves) move.contact = i;
        best.offer(std::move(*moves), worth);
      }
      return true;
    });
  }
  if (work.meter) work.meter->found(best.cost());
}

std::vector<Move> cheaper_by_walk(const SearchModel& search, const FlatState& start,
                                  const GoalPlaces& goals, std::vector<Move> moves,
                                  double worth, WalkLattices& lattices,
                                  const Limits& limits, Work& work) {
  const double cost = cost_of(search, moves);
  if (cost < worth) return moves;
  enter("cheaper walk", cost, work);
  auto walk = within_budget(work, share_of_left(work, kShareOfWalk), [&] {
    return search_walks(search, start, goals, cost, lattices, limits, work);
  });
  if (walk && cost_of(search, *walk) < cost) moves = std::move(*walk);
  if (work.meter) work.meter->found(cost_of(search, moves));
  return moves;
}

}  // namespace prehensile
