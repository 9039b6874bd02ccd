/// What motions by a contact cost at least in a slab of the object, by the laws of single
/// instants. Internal to the planner.
#pragma once

#include "planner/geometry/segment.h"
#include "planner/pads/local_law.h"

namespace prehensile {

/// Places with low <= u.p <= low + width, and perp(u).p within `across` [m].
struct Slab {
  Vec2 u;  ///< unit
  double low = 0.0, width = 0.0;
  Extent across;
};

struct SlabQuestion {
  int first_contact = 0, end_contact = 0;  ///< of Model::contacts, the last excluded
  double share = 0.0;                      ///< in (-1, 1)
  int steps = 0;                           ///< of the branch and bound
  /// [m] that across the slab are worth dividing as much as half a turn of directions.
  double as_half_turn = 0.0;
};

/// The least (dT - share c dtheta) / u.dp of motions that advance along u, from below, by
/// branch and bound over places, directions and contacts; infinity if there are none.
/// Allocates.
double least_cost(const LocalLaw& law, const Slab& slab, const SlabQuestion& question);

}  // namespace prehensile
