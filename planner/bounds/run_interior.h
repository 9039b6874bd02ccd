/// The interior-point method for the convex program of run_bound.h: Newton's steps in
/// places and multipliers at once, predicted and corrected (Nocedal and Wright, Numerical
/// Optimization, 2006, 14.2 and 19.2). Internal to the planner.
#pragma once

#include "planner/bounds/run_slopes.h"

namespace prehensile {

/// No heap.
class RunInterior {
 public:
  /// At a place inside all laws, by some violation. `program` must outlive it.
  explicit RunInterior(const RunProgram& program);

  /// One step, towards this weight [m] or a greater one; false where rounding ends them.
  bool step(double least_weight);

  double weight() const;                 ///< [m] mean of slack times multiplier
  bool is_central(double weight) const;  ///< all of them within half of it
  double objective() const;              ///< [m] travel, and the cost of the violation

  RunMultipliers multipliers() const { return multipliers_of(y_); }
  double violation() const { return x_[RunIndex::kV]; }  ///< [m]
  /// Of the goal's arc, at the end.
  double share() const { return x_[RunIndex::kShare]; }

  /// t.p from the start [m], after piece k and at the end.
  double lateral(int k) const { return x_[3 * k]; }
  double end_lateral() const { return lateral(kRunPieces - 1) + x_[RunIndex::kRestU]; }
  double end_depth() const {  ///< [m]
    return p_.level[kRunPieces - 1] + x_[RunIndex::kRest];
  }

 private:
  struct Direction {
    RunVector x;
    RunNumbers slack, y;
  };

  struct Shares {
    double slack, y;
  };

  void start();
  bool factor();
  Direction direction(const RunNumbers& products) const;
  Shares shares_of(const Direction& direction) const;
  double weight_after(const Direction& direction, const Shares& shares) const;
  bool move(const Direction& direction);

  const RunProgram& p_;
  RunSlopes laws_;
  RunVector x_;
  RunNumbers slack_, y_;
  double count_ = 0.0;       // of laws
  RunHessian hessian_;       // its factors
  double last_share_ = 1.0;  // of the step before
};

}  // namespace prehensile
