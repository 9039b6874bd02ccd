/// The pads of a scene in another shape: what the shape alone changes.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "scene/scene.h"

namespace prehensile {

/// "1:1", "1:2" and "1:4" are rectangles, their long side along y of H; "line" lies along
/// it; "half_disc" is a polygon, its straight side towards -x, its centre of pressure on
/// the finger axis.
inline constexpr std::array<std::string_view, 5> kPadShapes = {"1:1", "1:2", "1:4",
                                                               "line", "half_disc"};

/// The pad of one of kPadShapes, 1 m long (the disc: of radius 1 m); nothing for another
/// name.
std::optional<Pad> pad_of_shape(std::string_view name);

/// The scene with pads of this shape, as large as gives them the torque radius [m] that
/// its own have, which must be positive: turning on the spot costs the same. Over a
/// polygon to 1e-5 of it, its quadrature not being quite the same at each size.
Scene with_pads(Scene scene, const Pad& shape);

}  // namespace prehensile
