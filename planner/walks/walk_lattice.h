/// A fine lattice of places of the finger axis, and what short pushes between them may
/// turn. Internal to the planner.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/geometry/free_directions.h"
#include "planner/geometry/level_set.h"
#include "planner/steering/goal.h"
#include "planner/walks/place_law.h"

namespace prehensile {

/// A short straight push between two nodes.
struct WalkEdge {
  int to = -1, contact = -1;
  double lo = 0.0, hi = 0.0;  ///< c dtheta that it can produce [m]; lo > hi: not any more
  double cost = 0.0;          ///< least path length in the flat space, over L
};

/// How fine a lattice is.
struct Fineness {
  int per_side;    ///< nodes over the longer side of the object
  int stride = 3;  ///< rows and columns that a push goes, at most: the more, the finer
                   ///< are its headings
  bool operator<(const Fineness& other) const {
    return std::tie(per_side, stride) < std::tie(other.per_side, other.stride);
  }
};

/// Nodes in rows that are closer to each other than the nodes in them, so that the
/// headings of pushes along the rows differ little.
struct Rows {
  double heading = 0.0;  ///< [rad] in O
  double closer = 1.0;   ///< so many times

  Vec2 coordinates(const Vec2& p_OF) const {
    const Vec2 along = rotated(-heading, p_OF);
    return {along.x(), closer * along.y()};
  }
  Vec2 place(const Vec2& coordinates) const {
    return rotated(heading, {coordinates.x(), coordinates.y() / closer});
  }
};

class WalkLattice {
 public:
  /// Over the object, the start, and the places of the goals. `search` must outlive the
  /// lattice.
  WalkLattice(const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
              const Fineness& fineness, Steepness steepness, const Rows& rows = {});
  WalkLattice(const WalkLattice&) = delete;
  WalkLattice& operator=(const WalkLattice&) = delete;

  /// Another start and other goals; no edge is narrowed any more.
  void set_ends(const FlatState& start, const GoalPlaces& goals);

  int nodes() const { return static_cast<int>(nodes_.size()); }
  int start() const { return start_; }
  /// Steps from its nodes by all contacts: what they allow takes most of the memory.
  int slopes() const { return start_ * static_cast<int>(steps_.size()) * contacts_; }

  double spacing() const { return grid_.spacing; }  ///< [m] in the rows
  const Vec2& place(int node) const { return nodes_[node].p_OF; }

  /// The index of the goal that a node is the place of, or negative.
  int goal_at(int node) const { return node - start_ - 1; }

  /// The pushes from a node, from when they are first asked for.
  const std::vector<WalkEdge>& edges_from(int node, Work& work);

  /// Headings of the finger axis that some contact sticks along at a place, at some rate
  /// of turn.
  FreeDirections headings_at(const Vec2& p_OF, Work& work) const;

  /// What one of them is found to produce, until other ends are set.
  void narrow(int node, int edge, double lo, double hi);

 private:
  /// In less room, rounded inwards.
  class KeptRanges {
   public:
    KeptRanges() = default;
    explicit KeptRanges(const KappaRanges& ranges);
    KappaRanges ranges() const;

   private:
    std::array<float, 2> lo_ = {1.0F, 1.0F}, hi_ = {0.0F, 0.0F};  // lo > hi: none
  };
  struct Node {
    Vec2 p_OF;
    std::vector<char> held = {};          // by contact; empty: not known yet
    std::vector<KeptRanges> slopes = {};  // by step and contact
    bool knows_steps = false, knows_goals = false;
    std::size_t steps = 0;  // of the edges; the others lead to goals
    std::vector<WalkEdge> edges = {};
  };
  struct Narrowed {
    int node, edge;
    double lo, hi;  // before
  };
  struct Step {
    int i, j;
    double length;  // [m]
    Vec2 e;         // motion of the object
  };

  Vec2 place_on_grid(int index) const { return rows_.place(grid_.place(index)); }
  void add_nodes();
  void add_steps(int stride);
  void find_held(Node& node, Work& work) const;
  void find_slopes(Node& node, Work& work);
  void find_slopes_of_whole_pads(Node& node);
  KappaRanges slopes_along(const Node& node, int contact, DirectedDrag& drag) const;
  using OfContacts = std::vector<KappaRanges>;
  OfContacts slopes_of_step(std::size_t step, const Node& from, const Node& to) const;
  void look_between(int from, int to, std::size_t step, OfContacts& slopes, Work& work);
  const PadsAtPlace& whole_pads_at(const Vec2& p_OF);
  const PadsAtPlace& kept_pads_at(int node);
  const PadsAtPlace& pads_between(int from, const Step& step, const Vec2& middle);
  void add_edges(const KappaRanges& slopes, int contact, int to, double length,
                 std::vector<WalkEdge>& edges) const;
  void add_steps_from(int index, Work& work, std::vector<WalkEdge>& edges);
  void add_given(int from, int to, Work& work, std::vector<WalkEdge>& edges);

  const SearchModel& search_;
  const Model& model_;
  const int contacts_;
  const Steepness steepness_;
  std::vector<StickContact> weak_;  // by contact
  const Rows rows_;
  PlaceGrid grid_;  // of coordinates in the rows
  std::vector<Step> steps_;
  std::vector<Node> nodes_;   // of the grid, the start, the goals
  std::vector<int> on_grid_;  // of nodes
  std::vector<int> at_grid_;  // the node there, or -1
  int start_ = 0;
  std::optional<PadsAtPlace> whole_pads_;
  std::vector<DirectedDrag> whole_drags_;  // by step
  std::vector<char> are_in_cone_;          // whole pads, by step and contact
  std::vector<std::optional<PadsAtPlace>> pads_of_ends_;  // the start, the goals
  std::pair<int, std::optional<PadsAtPlace>> pads_of_node_ = {-1, std::nullopt};
  std::unordered_map<std::size_t, OfContacts> backwards_;  // of steps not yet asked for
  std::unordered_map<int, PadsAtPlace> between_;           // by half rows and columns
  std::vector<Narrowed> narrowed_;
};

/// Lattices that one walk search leaves to the next: what sticks between their nodes
/// takes most of the time.
class WalkLattices {
 public:
  /// Of the search that was asked for last, and of one steepness, to save memory.
  /// `search` must outlive them.
  WalkLattice& between(const SearchModel& search, const FlatState& start,
                       const GoalPlaces& goals, const Fineness& fineness,
                       Steepness steepness);

 private:
  const SearchModel* search_ = nullptr;
  Steepness steepness_ = Steepness::kUsual;
  std::map<Fineness, WalkLattice> by_fineness_;
};

}  // namespace prehensile
