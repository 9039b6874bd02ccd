/// What is still to be paid from each node of a lattice for the way to the goal and the
/// turn that is still missing. Internal to the own planner.
///
/// A turn has a price (turn_cost.h): what the way to the goal costs at least, less the
/// worth of what it turns the object, is a shortest way over the lattice. Together with
/// the worth of the turn that is missing it bounds the rest from below, whatever the
/// price, and the best of a few prices comes near.
#pragma once

#include <array>
#include <vector>

#include "planner/chains/turn_cost.h"

namespace prehensile {

/// A push from a node, or into the goal.
struct TurningPush {
  int from = -1, contact = -1, to = -1;
  const TurnCost* cost = nullptr;
};

class TurnAhead {
 public:
  /// `nodes`: their number, of which `end` is all of the goal; L [m].
  TurnAhead(const std::vector<TurningPush>& pushes, int nodes, int contacts, int end,
            double L);

  /// J of the whole way from below, but for the placements before: after pushes that cost
  /// this and have led to a node by the contact (negative: none has), to have turned the
  /// object by something between `low` and `high` [m of c dtheta].
  double least_cost(const TurnCost& paid, int node, int contact, double low,
                    double high) const;

  /// What is still to be paid, whatever the turn.
  double after(int node, int contact) const { return rests(node, contact)[kPrices / 2]; }

 private:
  static constexpr int kPrices = TurnCost::kCount - 2;  // all but the last ones
  using Rests = std::array<float, kPrices>;

  const Rests& rests(int node, int contact) const {
    return rests_[static_cast<std::size_t>(node) * (contacts_ + 1) + contact + 1];
  }

  int contacts_;
  double L_;
  std::vector<Rests> rests_;  // by node and contact, none first
};

}  // namespace prehensile
