/// Bodies as triangles, for files that want them.
#pragma once

#include <array>
#include <vector>

#include "viewer/bodies.h"

namespace prehensile::viewer {

/// Counter-clockwise seen from outside; corners are not shared, so that edges stay sharp.
struct Surface {
  std::vector<std::array<Vec3, 3>> triangles;  ///< [m]
};

/// In O. The sides of a body from a mesh are an open strip; all others are closed.
Surface surface_of(const ObjectBody& body);

/// A pad in H between two heights.
Surface surface_of(const PadBody& pad, double low, double high);

/// A pusher in the frame (n, t, z) of its centre: it lies at n <= 0. `thickness` [m] is
/// what it has where the scene gives it none.
Surface surface_of(const PusherBody& pusher, double thickness);

/// Of a closed surface [m^3].
double volume_of(const Surface& surface);

}  // namespace prehensile::viewer
