/// How large the instant problems of a scene are: what `inspect` prints and what the
/// leaving-out tests assert.
#pragma once

#include "mechanics/model.h"

namespace prehensile {

/// Counts for one contact at the start pose. The exact solver eliminates every force, so
/// its unknowns are the twist alone; the paper's formulation keeps them all.
struct ProblemSize {
  int unknowns = 3;               ///< exact planar solver: the object twist
  int finger_points = 0;          ///< merged points of the two pads
  int pusher_points = 0;          ///< 1 point, 2 line
  int generators = 0;             ///< friction generators of all points, paper eq. (2)
  int spatial_unknowns = 0;       ///< exact spatial solver: object twist and jaw rates
  int spatial_points = 0;         ///< of both pads and the pusher
  int reference_unknowns = 0;     ///< lambda_n, beta, xi and twist of the paper's problem
  int reference_constraints = 0;  ///< its linear rows
};

/// `generators_per_point`: g of paper eq. (2) for the finger points. A frictionless
/// pusher has no generators; a grasp without friction points none at all.
ProblemSize size_of_problem(const Model& model, int contact,
                            int generators_per_point = 8);

}  // namespace prehensile
