/// Simple solids, for objects and for what stands around them.
#pragma once

#include <vector>

#include "scene/frames.h"

namespace prehensile {

enum class Axis { kX, kY, kZ };

/// Box, centred on the origin of O; size [m] along x, y (pad plane) and z (between jaws).
struct BoxShape {
  Vec3 size = Vec3::Zero();
};

/// Cylinder centred on the origin of O. `axis` kZ: held at its flat ends. `axis` kX or
/// kY: held on its curved side, each pad touches it along a line, and it can roll.
struct CylinderShape {
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< [m]
  Axis axis = Axis::kZ;
};

/// Straight prism over a simple polygon. `axis` kZ: along z, the polygon is the outline
/// in the pad plane of O. `axis` kX or kY: the prism lies in the pad plane, the polygon
/// is its convex section (lateral axis, z), see scene/lying_prism.h; the jaws hold two
/// flat sides of it, and a support can roll it over its edges.
struct PrismShape {
  std::vector<Vec2> outline;  ///< [m], counter-clockwise, at least 3 vertices
  double thickness = 0.0;     ///< [m] along the axis
  Axis axis = Axis::kZ;
};

}  // namespace prehensile
