/// What a walk has still to cost. Internal to the own planner.
#pragma once

#include <vector>

#include "planner/limits.h"
#include "planner/walk_lattice.h"

namespace prehensile {

/// The least J from each node of a lattice to a place of the goal, whatever the object
/// turns by on the way: the walks that a search need not look at are those from which no
/// way leads there, or a dear one only. Of the edges that the lattice has now: it stays a
/// bound when some are cut.
class WalkRest {
 public:
  /// Asks the lattice for the edges of every node that a way from the start leads to.
  /// Infinite everywhere if a limit is reached before.
  WalkRest(WalkLattice& lattice, int contacts, const Limits& limits, Work& work);

  /// Of what has come to a node by a push of this contact; negative: by none.
  double after(int node, int contact) const {
    return contact < 0 ? of_start_ : rest_[state(node, contact)];
  }

 private:
  struct EdgeTo {
    int from, contact;
    double cost;
  };
  using EdgesTo = std::vector<std::vector<EdgeTo>>;  // by node

  std::size_t state(int node, int contact) const {
    return static_cast<std::size_t>(node) * static_cast<std::size_t>(contacts_) +
           static_cast<std::size_t>(contact);
  }
  void settle(const WalkLattice& lattice, const EdgesTo& edges);

  int contacts_;
  std::vector<double> rest_;  // by node and contact
  double of_start_;
};

}  // namespace prehensile
