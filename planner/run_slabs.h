/// What a run by one contact costs at least where the convex program of run_bound.h says
/// little: that sums each inequality of a sticking instant for itself, while gravity
/// helps with one only in motions that another denies. Internal to the planner.
///
/// A run no longer than `cap` stays in the ellipse around its ends that such ways reach.
/// For any direction u ahead and any share in (-1, 1), it advances all of the way along u
/// and pays the least that the contact asks for that, all inequalities together, in each
/// of some slabs across u:
///     T >= share c dtheta + sum over slabs of width x least (dT - share c dtheta) / u.dp
#pragma once

#include "planner/local_law.h"
#include "planner/run_bound.h"

namespace prehensile {

struct RunSlabs {
  const LocalLaw* law = nullptr;
  int contact = 0;
  double c = 0.0;                              ///< [m]
  const std::vector<Vec2>* outline = nullptr;  ///< where the finger axis may be
  Vec2 start = Vec2::Zero();
  GoalArc goal;
  double turn_low = 0.0, turn_high = 0.0;  ///< [rad]
  double cap = 0.0;  ///< [m] travel of interest: more need not be proved
};

/// A bound on the travel of every run from the start to the goal, at most `cap`; 0 where
/// the law is not known. A few milliseconds.
double travel_across_slabs(const RunSlabs& question);

}  // namespace prehensile
