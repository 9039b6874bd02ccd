/// The convex program of run_bound.h in numbers, and its dual. Internal to the planner.
#pragma once

#include <array>

#include "planner/run_bound.h"

namespace prehensile {

using Pair = std::array<double, 2>;
using Pairs = std::array<Pair, RunLaw::kSets>;  // of each set of laws of the ends

/// Multipliers of a piece: both edges, both ends, both borders of the outline. That of
/// its length follows.
struct PieceMultipliers {
  Pair edge{}, border{};
  Pairs end{};
};

/// All multipliers; the last piece is the rest of the way, into the goal's box.
struct RunMultipliers {
  std::array<PieceMultipliers, kRunPieces + 1> piece;
  Pair goal_u{}, goal_z{};
};

/// Numbers of the program: u and z = c theta counted from 0 at the start.
struct RunProgram {
  explicit RunProgram(const RunQuestion& question);

  bool is_ahead = false;
  double mu = 0.0;
  double area = 1.0;  // 1: paths may leave the chord, 0: they are the chords
  double D = 0.0;     // [m] depth of a piece
  double rest = 0.0;  // [m] greatest depth of the last
  Pair back{};
  std::array<double, RunLaw::kSets> ratio{};  // C / c
  Pairs end{};                                // u_low, u_high
  Pairs slack{}, rest_slack{};                // of the ends, per tau
  Pairs per_path{};                      // and per length of the path of the finger axis
  std::array<double, kRunPieces + 1> h;  // the last: at its begin
  std::array<double, kRunPieces> border_low, border_high;  // of u after each piece
  Pair rest_u{};  // least and greatest u where the last piece begins
  Pair goal_u{}, goal_z{};
  double widest_step = 0.0;  // [m] of u in a piece

  /// Coefficient of the depth of the last piece in a law of end k.
  double rest_lever(int set, int k) const {
    return (k == 0 ? end[set][0] - rest_u[0] : rest_u[1] - end[set][1]) +
           0.5 * area * mu * rest;
  }
};

/// A bound on the least travel from these multipliers, whatever they are; -infinity where
/// they, and some shares of them, lie outside the domain of the dual.
double dual_bound(const RunProgram& program, const RunMultipliers& y);

}  // namespace prehensile
