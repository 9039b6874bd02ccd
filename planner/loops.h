/// Regions of places of the finger axis.
#pragma once

#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// Closed polygons [m], in O, that neither cross nor touch; what is between them is by
/// the even-odd rule.
using Loops = std::vector<std::vector<Vec2>>;

}  // namespace prehensile
