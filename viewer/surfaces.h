/// Bodies as triangles, for files that want them.
#pragma once

#include <array>
#include <vector>

#include "scene/object_surface.h"
#include "viewer/bodies.h"

namespace prehensile::viewer {

/// Counter-clockwise seen from outside; corners are not shared, so that edges stay sharp.
struct Surface {
  std::vector<std::array<Vec3, 3>> triangles;  ///< [m]
};

/// In O. The sides of a body from a mesh are an open strip; all others are closed.
Surface surface_of(const ObjectBody& body);

/// Triangles of a mesh, in O.
Surface surface_of(const ObjectSurface& mesh);

/// A body of the scene in the frame where it stands. A half space is drawn as a slab that
/// reaches `extent` [m] from its point to each side.
Surface surface_of(const ConvexBody& body, double extent);

/// How far from the origin of W pushes take place [m], the size of the object added.
double extent_of(const Model& model);

/// A pad in H between two heights.
Surface surface_of(const PadBody& pad, double low, double high);

/// A pusher in the frame (n, t, z) of its centre: it lies at n <= 0. `thickness` [m] is
/// what it has where the scene gives it none.
Surface surface_of(const PusherBody& pusher, double thickness);

/// What a convex body covers, seen along z: counter-clockwise.
std::vector<Vec2> shadow_of(const Surface& surface);

/// Of a closed surface [m^3].
double volume_of(const Surface& surface);

}  // namespace prehensile::viewer
