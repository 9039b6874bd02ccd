/// The barrier method for the convex program of run_bound.h (Boyd and Vandenberghe,
/// Convex Optimization, 2004, 11.3). Internal to the planner.
#pragma once

#include <array>

#include "planner/bordered_band.h"
#include "planner/run_program.h"

namespace prehensile {

/// x = (u, z, tau of each piece; depth, du, share of the goal's arc, dz, tau of the last;
/// v) [m, the share without unit], v being what every law may be violated by. No heap.
class RunBarrier {
 public:
  /// `program` must outlive it.
  explicit RunBarrier(const RunProgram& program) : p_(program) {}

  /// A place inside all laws, by some violation.
  void start();

  /// Steps of Newton's method for one weight [m]; false where rounding stops them.
  bool centre(double weight);

  double objective() const;  ///< [m] travel, and the cost of the violation

  const RunMultipliers& multipliers() const { return y_; }
  double violation() const { return x_[kV]; }  ///< [m]
  double share() const { return x_[kShare]; }  ///< of the goal's arc, at the end

  /// t.p from the start [m], after piece k and at the end.
  double lateral(int k) const { return x_[3 * k]; }
  double end_lateral() const { return lateral(kRunPieces - 1) + x_[kRestU]; }
  double end_depth() const { return p_.level[kRunPieces - 1] + x_[kRest]; }  ///< [m]

 private:
  static constexpr int kRest = 3 * kRunPieces;
  static constexpr int kRestU = kRest + 1;
  static constexpr int kShare = kRest + 2;
  static constexpr int kRestZ = kRest + 3;
  static constexpr int kRestTau = kRest + 4;
  static constexpr int kV = kRest + 5;
  static constexpr int kVariables = kV + 1;
  using Band = BorderedBand<kVariables, 5>;
  using Vector = Band::Vector;

  /// The variables that a constraint depends on, in their order, with its slopes.
  struct Gradient {
    std::array<int, 7> index;
    std::array<double, 7> value;
    int count = 0;
    void add(int i, double v) {
      if (v == 0.0) return;
      index[count] = i;
      value[count++] = v;
    }
  };

  template <typename Slope>
  bool take(double g, const Slope& slope, double* multiplier);
  void count_logarithms();
  void add_curvature_of_length(double y, const std::array<double, 3>& d,
                               const std::array<int, 3>& to,
                               const std::array<int, 3>& from, double length);
  void add_second(int i, int j, double value);
  bool take_piece(int k);
  bool take_rest();
  bool take_rest_end(int set, int e, const std::array<double, 3>& d, double& y);
  bool take_goal();
  bool take_all();
  double least_slack();
  bool assemble(double weight, double& value, bool derivatives);

  const RunProgram& p_;
  Vector x_, gradient_;
  Band hessian_;
  RunMultipliers y_;
  double weight_ = 0.0, value_ = 0.0, least_ = 0.0;
  double product_ = 1.0;  // of constraints whose logarithms are not in value_ yet
  bool derivatives_ = false, only_least_ = false;
};

}  // namespace prehensile
