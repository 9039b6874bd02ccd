/// The shortest run of sticking pushes by one contact, from below: a convex program, and
/// a bound from its dual. Internal to the planner.
///
/// The path is cut where it first comes to each of a number of depths -n.p between start
/// and goal, those of the corners of the outline among them. For a piece of depth D, with
/// the steps du of t.p and dz = c dtheta and the travel tau, the laws of a run
/// (run_law.h) summed over the piece are
///     tau >= sqrt(D^2 + du^2 + dz^2)
///     mu D -+ du + back tau >= 0
///     C dtheta >= h du + (u - u_low) D  - E - slack_low tau
///     C dtheta <= h du + (u - u_high) D + E + slack_high tau
///     beside +-dtheta <= D + retreat tau
/// h and u being means over the piece, h the height over the face, and E = (mu^2 D^2 -
/// du^2) / (2 mu) twice the largest area between the chord and a path inside the cone,
/// and `beside` the least that a path can be beside the face there.
/// All of them are convex where tau may be greater than the length; so that gravity may
/// be used by turning to and fro, as it may in fact. The bound is the value of the
/// Lagrange dual (Boyd and Vandenberghe, Convex Optimization, 2004, 5.1) at multipliers
/// from an interior-point method (run_interior.h), which holds whatever they are.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "planner/bounds/word_node.h"

namespace prehensile {

/// Where a run may end, as the end angle varies: at centre + share arc, share in [-1, 1],
/// up to the smaller of slack_i + slope_i share [m].
struct GoalArc {
  Vec2 centre = Vec2::Zero();
  Vec2 arc = Vec2::Zero();
  std::array<double, 2> slack{}, slope{};

  /// Greatest distance of a member from the line.
  double widest() const;
  /// Greatest w.(p - centre) of the members, from above.
  double reach(const Vec2& w) const { return std::abs(w.dot(arc)) + w.norm() * widest(); }
};

struct RunQuestion {
  const RunLaws* laws = nullptr;
  int contact = 0;
  double c = 0.0;                              ///< [m]
  const std::vector<Vec2>* outline = nullptr;  ///< where the finger axis may be
  Vec2 start = Vec2::Zero();
  GoalArc goal;
  double turn_low = 0.0, turn_high = 0.0;  ///< [rad]
  double cap = 0.0;  ///< [m] travel of interest: more need not be proved
  /// Paths that are straight between the depths only: E = 0.
  bool chords_only = false;
  /// [m] > 0, of paths: the product of slack and multiplier of each law. Paths of greater
  /// ones are longer, and keep farther from the borders of the laws.
  double weight = 0.0;
};

/// A bound on the travel of every run from the start to the goal that is no longer than
/// `cap` [m], at most `cap`; 0 where the goal is not ahead of the contact. No heap.
double run_bound(const RunQuestion& question) noexcept;

inline constexpr int kRunPieces = 24;

struct RunPath {
  std::array<Vec2, kRunPieces - 1> places;  ///< between start and end [m]
  Vec2 end = Vec2::Zero();
  double share = 0.0;  ///< of the goal's arc, at the end
};

/// The way-points of the shortest run to the goal, by the same program; false if there is
/// none within `cap`, up to 0.01 mm. What gravity presses on may be wrong: a run may have
/// to turn to and fro. No heap.
bool run_path(const RunQuestion& question, RunPath& path) noexcept;

}  // namespace prehensile
