/// The pads of a scene in another shape: what the shape alone changes.
#pragma once

#include <string_view>

#include "scene/scene.h"

namespace prehensile {

/// What with_pads knows: "1:1", "1:2", "1:4" (rectangles, their long side along y of H),
/// "line" (along y of H) and "half_disc" (a polygon; its centre of pressure, not that of
/// its arc, is on the finger axis).
inline constexpr std::string_view kPadShapes[] = {"1:1", "1:2", "1:4", "line",
                                                  "half_disc"};

bool is_pad_shape(std::string_view shape);

/// The scene with pads of one of kPadShapes, as large as gives them the torque radius
/// that its own have (> 0): turning on the spot costs the same.
Scene with_pads(Scene scene, std::string_view shape);

}  // namespace prehensile
