/// A prism whose long axis lies in the pad plane: the jaws hold two of its flat sides,
/// and a support can roll it over its edges (primitives/roll_prism.h).
///
/// Its section is drawn with the lateral axis of O (y for a prism along x, x for one
/// along y) to the right and z, the closing direction, upwards.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace prehensile {

/// The prism lies in the pad plane; nullptr for every other shape.
const PrismShape* lying_prism(const Shape& shape);

/// Extents of a section [m] in its drawing.
struct SectionExtent {
  double low = 0.0, high = 0.0;            ///< lateral, of the whole section
  double face_low = 0.0, face_high = 0.0;  ///< lateral, where both jaws find a flat side;
                                           ///< face_low >= face_high: nowhere
  double bottom = 0.0, top = 0.0;          ///< along z
};
SectionExtent extent_of(const std::vector<Vec2>& section);

/// Rectangle in the pad plane: the length of the prism times [low, high] laterally [m].
std::vector<Vec2> lying_rectangle(const PrismShape& prism, double low, double high);

/// Extent along z [m] of the side of a section that looks to -lateral or +lateral; one
/// height twice where it ends in an edge.
Vec2 side_heights(const std::vector<Vec2>& section, bool towards_plus);

/// What is wrong with the section of a lying prism; empty if nothing is, or if it stands.
std::string section_fault(const PrismShape& prism);

/// The section turned by `roll` [rad] about the origin covers itself.
bool is_same_section(const std::vector<Vec2>& section, double roll) noexcept;

/// The least turn about the origin [rad] after which the section covers itself: a share
/// of a whole turn, or that.
double symmetry_angle(const std::vector<Vec2>& section) noexcept;

}  // namespace prehensile
