/// Lower bounds on the cost J of any sticking plan, over the whole goal set: tolerances,
/// free coordinates and whole turns included.
#pragma once

#include "mechanics/model.h"

namespace prehensile {

/// Least distance in (p_OF, c theta) from a grasp to the goal set, rounded down [m].
double distance_to_goal(const Model& model, const Grasp& start, const Goal& goal);

/// J >= this for every plan of sticking pushes and rolls that reaches the goal; 0 at the
/// goal.
double lower_bound(const Model& model, const Grasp& start, const Goal& goal);

}  // namespace prehensile
