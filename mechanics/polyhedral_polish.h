/// Sharpens an interior-point answer on polyhedral cones. Internal to the mechanics
/// layer; cold path.
///
/// An interior-point method leaves every complementarity product a little above zero, so
/// force and slack both carry an error of about the square root of it. But once each pair
/// is known to be at zero on one side or the other, the laws are linear equations: finger
/// friction is a corner of its polygon, a point of one edge (the slip then stands at
/// right angles to it), or free (no slip); a pusher point is open, sticks or slips.
#pragma once

#include <span>

#include "mechanics/polyhedral_instant.h"

namespace prehensile {

/// The answer with the pattern of the unknowns z, nearest to them; to be judged by
/// residual_of like any other, because the pattern may have been read wrongly.
PolyhedralAnswer polished(const PolyhedralInstant& instant, std::span<const double> z);

}  // namespace prehensile
