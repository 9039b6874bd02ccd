/// The cheapest ways to nodes of a lattice, by what they turn the object. Internal to the
/// own planner.
///
/// The state of a search is (node, contact, turn), its turn cut into buckets. A label is
/// a way to a node that may turn the object by any angle of an interval; it is kept if it
/// is cheaper for some bucket than those before, and dies when others are for all of its
/// buckets.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "planner/chains/turn_cost.h"

namespace prehensile {

class TurnBuckets {
 public:
  /// `states`: pairs of node and contact; c, L [m].
  TurnBuckets(int states, double c, double L);

  /// Keeps a label if it is cheaper in one of its buckets than those before, by
  /// `least_gain` of J, and gives these buckets to it; false if it is not. `placements`:
  /// what it costs besides its travel.
  bool offer(int state, const TurnCost& paid, int placements, float least_gain,
             int label);

  /// Whether a label that was kept has one of its buckets still.
  bool holds(int state, const TurnCost& paid, int label) const;

 private:
  static constexpr int kBuckets = 100;
  static constexpr double kMostTurn = 15.0;  // [rad] to either side that they tell apart

  float bucket_at(float turn) const;  // the middle of the first one is at 0
  std::pair<int, int> range(const TurnCost& paid) const;
  void find_costs(const TurnCost& paid, int placements, int low, int high);
  int first_improved(const float* costs, int low, int high) const;

  float buckets_per_metre_;                // of c dtheta
  float cost_per_metre_;                   // of travel
  std::vector<int> labels_;                // by state and bucket; negative: none
  std::vector<float> costs_;               // J of these labels
  std::array<float, kBuckets> offered_{};  // J of the label at hand
};

}  // namespace prehensile
