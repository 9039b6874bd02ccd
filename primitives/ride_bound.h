/// How long the contact mode of a ride is sure to last: the exact guard of a line pusher
/// that sticks to a whole face, where the object moves with the pusher and no instant
/// needs to be solved.
///
/// Seen from the pusher the object stands still, the finger axis runs along a line or an
/// arc and the pads turn about it. The friction of a pad point is a vector of known
/// length against its velocity; it changes as that velocity turns and as the point moves,
/// and both are bounded by travel and turn. So are with them the forces that the pusher
/// must exert.
#pragma once

#include "mechanics/planar_problem.h"

namespace prehensile {

/// What keeps a flush line sticking, by its two ends: loads, and what friction has left.
struct RideMargin {
  std::array<double, 2> normal_force{0.0, 0.0};  ///< [N]
  double friction_left = 0.0;                    ///< [N] mu normal - |tangential|
};

/// A share of the push, at most `most`, over which none of the margins can become
/// negative; 0 if one is already. `turn` [rad] of the whole push, and `curve` [m] =
/// travel x bend: by how much the velocity of the finger axis in P changes; the drive's
/// twist is per unit of the share. Valid while the pads keep their points. Rigorous up to
/// rounding.
double sure_to_last(const PlanarGrasp& grasp, const PlanarDrive& drive, double turn,
                    double curve, const RideMargin& margin, double most) noexcept;

}  // namespace prehensile
