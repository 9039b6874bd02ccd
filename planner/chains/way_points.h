/// Plans of two pushes through one way-point, from closed forms (no lattice): the
/// way-point is where a line through the start crosses one through the goal; the lines
/// are the edges and the middle of each contact's friction cone and the lines to the ends
/// of its face, where optimal way-points lie.
#pragma once

#include <array>
#include <limits>

#include "planner/steering/chain.h"
#include "planner/steering/goal.h"

namespace prehensile {

/// start -> p_OF by contact `first`, p_OF -> goal by contact `second`.
struct WayPoint {
  double cost = kNan;  ///< J
  int first = -1, second = -1;
  Vec2 p_OF = Vec2::Zero();
  int place = 0, angle = 0;  ///< index in GoalPlaces and in GoalPlace::theta
};

/// The cheapest way-points seen so far, cheapest first; ties keep the earlier one.
class BestWayPoints {
 public:
  static constexpr int kCapacity = 48;

  /// Of those cheaper than `to_beat`.
  explicit BestWayPoints(double to_beat = std::numeric_limits<double>::infinity())
      : to_beat_(to_beat) {}

  int count() const { return count_; }
  const WayPoint& operator[](int i) const { return points_[i]; }

  /// Cost that a way-point must beat to be kept.
  double worst_cost() const;
  void add(const WayPoint& point) noexcept;

 private:
  double to_beat_;
  int count_ = 0;
  std::array<WayPoint, kCapacity> points_;
};

/// Adds the way-point with all windings of its goal place, if the two legs (already made)
/// reach it. `chain` is scratch space. No heap.
void add_way_point(const Steering& steering, double theta_start, const GoalPlaces& goals,
                   int place, const Leg& first, const Leg& second, Chain& chain,
                   BestWayPoints& best) noexcept;

/// Adds all crossings for one goal place. No heap.
void add_crossings(const Steering& steering, const FlatState& start,
                   const GoalPlaces& goals, int place, Work& work,
                   BestWayPoints& best) noexcept;

}  // namespace prehensile
