/// How near one convex body comes to another, from above, with a proof: a point of the
/// one and its distance from the other. Internal to the planner; `separation.h` bounds
/// the same from below.
#pragma once

#include "planner/obstacles/separation.h"

namespace prehensile {

/// The signed distance of a point from a body, in the frame of its shape [m]: negative
/// inside. Exact.
double signed_distance(const BodyShape& shape, const Vec3& p);

/// The point of a body nearest to p, in the frame of its shape. Not of a half-space.
Vec3 nearest_point(const BodyShape& shape, const Vec3& p);

/// The least signed distance from `b` that was found of a point of `a` [m]: where it is
/// negative the bodies overlap, and moving `a` so that none of its points goes farther
/// than r raises it by no more than r. `a` is no half-space.
double closeness(const PlacedBody& a, const PlacedBody& b);

}  // namespace prehensile
