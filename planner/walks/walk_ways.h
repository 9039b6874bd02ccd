/// The cheapest ways over a lattice of walks, from the start and to the goals. Internal
/// to the own planner.
#pragma once

#include <utility>
#include <vector>

#include "planner/chains/least_rest.h"
#include "planner/walks/walk_lattice.h"

namespace prehensile {

/// An edge of a lattice.
struct WalkStep {
  int node = -1, edge = -1;
};

/// A node of a lattice and the contact whose push came there; the next push by another
/// one is one placement more.
class WalkStates {
 public:
  WalkStates(const WalkLattice& lattice, int contacts)
      : contacts_(contacts), count_(lattice.nodes() * contacts) {}

  int count() const { return count_; }
  int contacts() const { return contacts_; }
  int of(int node, int contact) const { return node * contacts_ + contact; }
  int after(const WalkEdge& edge) const { return of(edge.to, edge.contact); }
  int node(int state) const { return state / contacts_; }
  int contact(int state) const { return state % contacts_; }

 private:
  int contacts_, count_;
};

/// Of the edges that the lattice has now, as the rest is. The three must outlive it.
class WalkWays {
 public:
  WalkWays(WalkLattice& lattice, const WalkStates& states, const LeastRest& rest,
           Work& work);

  /// J of the cheapest way from the start over a state to a goal; infinite if there is
  /// none.
  double cost_over(int state) const;

  std::vector<WalkStep> way_to(int state) const;

  /// The cheapest one to a goal, and the state there. `state`: from which there is one;
  /// negative: the start.
  std::pair<std::vector<WalkStep>, int> way_on_from(int state) const;

 private:
  void expand(int node, int contact, int state, double cost);

  WalkLattice& lattice_;
  const WalkStates& states_;
  const LeastRest& rest_;
  Work& work_;
  std::vector<double> costs_;    // by state
  std::vector<WalkStep> steps_;  // that come there last
  std::vector<int> before_;      // the states before them; negative: the start
  std::vector<std::pair<double, int>> open_;  // a heap of costs and states
};

}  // namespace prehensile
