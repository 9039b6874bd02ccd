/// What a roll puts on the object on its way, as the robot that does it has to bear it:
/// the force of the support with both of its parts, and where object and force are in the
/// hand meanwhile.
#pragma once

#include <vector>

#include "primitives/transition.h"

namespace prehensile {

/// One moment of a roll.
struct RollLoad {
  double s = 0.0;  ///< share of the travel
  Grasp grasp;
  double normal_force = 0.0;      ///< [N] of the support on the object, along n
  double tangential_force = 0.0;  ///< [N] likewise, along +z of H
  double z_HO = 0.0;    ///< [m] of O: jaws that a prism moves apart do not move alike
  double z_foot = 0.0;  ///< [m] in H, of the place at which the support's force acts
  /// [m] of that place along t of the contact, from the finger axis. Where the balance
  /// leaves it open it is the middle of the support's line, or next to it.
  double along = 0.0;
};

/// From the start of the roll to its end; empty if it does not complete. Allocates.
std::vector<RollLoad> roll_loads(const Model& model, const Grasp& start,
                                 const Roll& roll);

/// In between, linearly; beyond the ends as there. `loads` may not be empty.
RollLoad roll_load_at(const std::vector<RollLoad>& loads, double s);

}  // namespace prehensile
