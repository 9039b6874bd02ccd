/// Legs between the nodes of a lattice, and into the goal. Internal to the own planner.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "planner/chains/turn_cost.h"
#include "planner/steering/chain.h"
#include "planner/steering/goal.h"

namespace prehensile {

/// One interval of a leg between two nodes, or into the goal.
struct LegEdge {
  int to = -1;
  float cost = 0.0F;  ///< least path length in the flat space, over L
  TurnCost paid;
};

/// A leg from a node to a place of the goal.
struct LastLeg {
  int place = -1;
  Leg leg;
  std::vector<LegEdge> edges;
};

/// Nodes are counted with the start as the last but one, and all places of the goal as
/// the last. What is not asked for is not looked at.
class LegGraph {
 public:
  /// `steering`, `search` and `goals` must outlive the graph.
  LegGraph(const Steering& steering, const SearchModel& search, std::vector<Vec2> nodes,
           const FlatState& start, const GoalPlaces& goals, Work& work);

  int start() const { return static_cast<int>(nodes_.size()) - 1; }
  int goal() const { return static_cast<int>(nodes_.size()); }
  int contacts() const { return contacts_; }
  const Vec2& place(int node) const { return nodes_[node]; }

  /// By a contact; none lead to the start.
  const std::vector<LegEdge>& edges(int node, int contact);
  const std::vector<LastLeg>& last_legs(int node);

  /// The leg of an edge between two nodes; false if nothing is left of it.
  bool make(int contact, int from, int to, Leg& leg);

  /// A leg between these nodes (of a last one: into this place of the goal) that is found
  /// to stick for fewer kappas. Edges know it from the next `renew` on, which makes
  /// references to them invalid.
  void narrow(const Leg& leg, int from, int to);
  void narrow_last(const Leg& leg, int from, int place);
  void renew();

 private:
  struct Narrowed {
    Leg leg;
    int from, to, place;  // one of the last two is negative
  };

  struct Measured {
    Leg leg;
    std::int64_t stick_tests = 0;  // that it took
  };
  using LegName = std::array<int, 3>;  // contact and nodes

  /// Where a push begins or ends.
  Stop stop_at(int node) const { return {nodes_[node], node == start()}; }
  bool usable(int node, int contact);
  bool is_usable(int node, int contact);
  bool make_once(int contact, int from, int to, Leg& leg);
  void append_edges(const Leg& leg, int to, std::vector<LegEdge>& edges) const;
  void renew_edges(const Narrowed& narrowed);

  const Steering& steering_;
  const SearchModel& search_;
  std::vector<Vec2> nodes_;
  const GoalPlaces& goals_;
  Work& work_;
  int contacts_;
  std::vector<std::optional<std::vector<LegEdge>>> rows_;       // by node and contact
  std::vector<std::optional<bool>> usable_;                     // likewise
  std::vector<std::optional<std::vector<LastLeg>>> last_legs_;  // by node
  std::map<LegName, KappaSet> kappas_;                          // of narrowed legs
  std::map<LegName, Measured> measured_;                        // of chains, by real pads
  std::vector<Narrowed> narrowed_;                              // not in edges yet
};

}  // namespace prehensile
