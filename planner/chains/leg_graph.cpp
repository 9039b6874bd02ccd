#include "planner/chains/leg_graph.h"

#include <utility>

#include "planner/costs.h"

namespace prehensile {

LegGraph::LegGraph(const Steering& steering, const SearchModel& search,
                   std::vector<Vec2> nodes, const FlatState& start,
                   const GoalPlaces& goals, Work& work)
    : steering_(steering),
      search_(search),
      nodes_(std::move(nodes)),
      goals_(goals),
      work_(work),
      contacts_(static_cast<int>(search.contacts.size())) {
  nodes_.push_back(start.p_OF);
  rows_.resize(nodes_.size() * search.contacts.size());
  usable_.resize(rows_.size());
  last_legs_.resize(nodes_.size());
}

const std::vector<LegEdge>& LegGraph::edges(int node, int contact) {
  std::optional<std::vector<LegEdge>>& row = rows_[node * contacts_ + contact];
  if (row) return *row;
  row.emplace();
  if (!usable(node, contact)) return *row;
  Leg leg;
  for (int to = 0; to < start(); ++to) {
    if (to == node || !usable(to, contact)) continue;
    if (make_held_leg(steering_, contact, stop_at(node), stop_at(to), work_, leg)) {
      append_edges(leg, to, *row);
    }
  }
  return *row;
}

const std::vector<LastLeg>& LegGraph::last_legs(int node) {
  std::optional<std::vector<LastLeg>>& legs = last_legs_[node];
  if (legs) return *legs;
  legs.emplace();
  Leg leg;
  for (int place = 0; place < goals_.count; ++place) {
    const Stop goal_place{goals_.places[place].p_OF, true};
    for (int contact = 0; contact < contacts_; ++contact) {
      if (!usable(node, contact) || !make_leg_from_held(steering_, contact, stop_at(node),
                                                        goal_place, work_, leg)) {
        continue;
      }
      legs->push_back({place, leg, {}});
      append_edges(leg, goal(), legs->back().edges);
    }
  }
  return *legs;
}

bool LegGraph::make(int contact, int from, int to, Leg& leg) {
  if (!make_once(contact, from, to, leg)) return false;
  const auto known = kappas_.find({contact, from, to});
  if (known != kappas_.end()) leg.kappas = known->second;
  return !leg.kappas.empty();
}

/// What real pads allow takes long to measure: it is measured once, and counts as work
/// each time, so that it does not matter to what a search comes by its budget.
bool LegGraph::make_once(int contact, int from, int to, Leg& leg) {
  const auto make = [&] {
    return make_held_leg(steering_, contact, stop_at(from), stop_at(to), work_, leg);
  };
  if (!steering_.real_pads || steering_.envelope) return make();
  const auto known = measured_.find({contact, from, to});
  if (known != measured_.end()) {
    if (work_.interrupted()) return false;
    leg = known->second.leg;
    work_.stick_tests += known->second.stick_tests;
    return true;
  }
  const std::int64_t before = work_.stick_tests;
  if (!make()) return false;
  measured_[{contact, from, to}] = {leg, work_.stick_tests - before};
  return true;
}

void LegGraph::narrow(const Leg& leg, int from, int to) {
  kappas_[{leg.contact, from, to}] = leg.kappas;
  narrowed_.push_back({leg, from, to, -1});
}

void LegGraph::narrow_last(const Leg& leg, int from, int place) {
  narrowed_.push_back({leg, from, -1, place});
}

void LegGraph::renew() {
  for (const Narrowed& narrowed : narrowed_) renew_edges(narrowed);
  narrowed_.clear();
}

void LegGraph::renew_edges(const Narrowed& narrowed) {
  const Leg& leg = narrowed.leg;
  if (narrowed.place >= 0) {
    for (LastLeg& last : *last_legs_[narrowed.from]) {
      if (last.place != narrowed.place || last.leg.contact != leg.contact) continue;
      last.leg = leg;
      last.edges.clear();
      append_edges(leg, goal(), last.edges);
    }
    return;
  }
  std::vector<LegEdge>& row = *rows_[narrowed.from * contacts_ + leg.contact];
  std::erase_if(row, [&](const LegEdge& edge) { return edge.to == narrowed.to; });
  append_edges(leg, narrowed.to, row);
}

/// Whether a push by the contact may begin and end there.
bool LegGraph::usable(int node, int contact) {
  std::optional<bool>& known = usable_[node * contacts_ + contact];
  if (!known) known = is_usable(node, contact);
  return *known;
}

bool LegGraph::is_usable(int node, int contact) {
  if (!is_held(steering_.search, contact, stop_at(node))) {
    work_.stopped_by.add(PushConstraint::kGravity);
    return false;
  }
  return !search_.confines || !is_blocked(steering_.search, contact, nodes_[node], work_);
}

void LegGraph::append_edges(const Leg& leg, int to, std::vector<LegEdge>& edges) const {
  const double L = placement_length(*search_.model);
  for (int i = 0; i < leg.kappas.count; ++i) {
    const TurnCost paid = turn_cost(leg.length, leg.kappas.intervals[i]);
    edges.push_back({to, static_cast<float>(paid.travel[TurnCost::kFree] / L), paid});
  }
}

}  // namespace prehensile
