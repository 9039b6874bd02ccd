/// The convex program of run_bound.h in numbers, and its dual. Internal to the planner.
#pragma once

#include <array>
#include <numbers>

#include "planner/bounds/run_bound.h"

namespace prehensile {

using Pair = std::array<double, 2>;
using Pairs = std::array<Pair, RunLaw::kSets>;  // of each set of laws of the ends

/// Multipliers of a piece: both edges, both ends, both borders of the outline, both turns
/// of a face beside the way. That of its length follows.
struct PieceMultipliers {
  Pair edge{}, border{}, turn{};
  Pairs end{};
};

/// Directions (u, depth) in which a member of the goal is no farther from the line than
/// the slack.
inline constexpr int kGoalDirections = 8;
inline Vec2 goal_direction(int i) {
  constexpr double h = 0.5 * std::numbers::sqrt2;
  constexpr std::array<double, kGoalDirections> kCosine = {1.0,  h,  0.0, -h,
                                                           -1.0, -h, 0.0, h};
  return {kCosine[i], kCosine[(i + 6) % kGoalDirections]};
}

/// All multipliers; the last piece is the rest of the way, into the goal's box.
struct RunMultipliers {
  std::array<PieceMultipliers, kRunPieces + 1> piece;
  /// Of both slacks of the goal, in all directions; and of z.
  std::array<std::array<double, kGoalDirections>, 2> goal{};
  Pair goal_z{};
};

/// Numbers of the program: u and z = c theta counted from 0 at the start.
struct RunProgram {
  explicit RunProgram(const RunQuestion& question);

  bool is_ahead = false;
  double mu = 0.0;
  double area = 1.0;  // 1: paths may leave the chord, 0: they are the chords
  std::array<double, kRunPieces> level;  // [m] depth below the start after each piece
  std::array<double, kRunPieces> D;      // [m] depth of each piece
  double rest = 0.0;                     // [m] greatest depth of the last
  Pair back{};
  std::array<double, RunLaw::kSets> ratio{};    // C / c
  Pairs end{};                                  // u_low, u_high
  Pairs lift{};                                 // [m] of both over the face
  Pairs slack{};                                // of the ends, per tau; and because a
  std::array<double, kRunPieces + 1> run_back;  // piece may run back
  Pairs per_path{};                      // and per length of the path of the finger axis
  std::array<double, kRunPieces + 1> h;  // the last: at its begin
  std::array<double, kRunPieces> border_low, border_high;  // of u after each piece
  std::array<Pair, kRunPieces> beside{};  // the face, over c: limits turns to +, to -
  double retreat = 0.0;                   // [m] per tau
  Pair rest_u{};                     // least and greatest u where the last piece begins
  double widest_rest = 0.0;          // [m] of u in the last piece
  GoalArc goal;                      // its slacks a little wider
  double goal_u = 0.0, arc_u = 0.0;  // of its line
  double goal_depth = 0.0, arc_depth = 0.0;  // the same, from the last level
  Pair goal_z{};
  std::array<double, kRunPieces> widest_step;  // [m] of u in a piece

  /// Slack of end k per tau of a piece.
  double slack_of(int set, int k, int piece) const {
    return slack[set][k] + run_back[piece];
  }

  /// Coefficient of the depth of the last piece in a law of end k.
  double rest_lever(int set, int k) const {
    return (k == 0 ? end[set][0] - rest_u[0] : rest_u[1] - end[set][1]) +
           0.5 * area * mu * rest;
  }

 private:
  void set_laws(const RunQuestion& question, const RunLaw& law, double u_start);
  void set_beside(const RunQuestion& question, const RunLaw& law, double start,
                  double u_start);
};

/// A bound on the least travel from these multipliers, whatever they are; -infinity where
/// they, and some shares of them, lie outside the domain of the dual.
double dual_bound(const RunProgram& program, const RunMultipliers& y);

}  // namespace prehensile
