/// Triangles of the object, to look at: the mechanics knows nothing of them.
#pragma once

#include <array>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

struct ObjectSurface {
  std::vector<Vec3> vertices;                 ///< [m] in O
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  double off = 0.0;  ///< [m] that a vertex of the body lies off these, at most
};

}  // namespace prehensile
