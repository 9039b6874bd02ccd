/// Polygons cut into triangles, and into compact parts. Internal to the scene layer and
/// to drawing.
#pragma once

#include <array>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// Counter-clockwise.
struct Triangle {
  std::array<Vec2, 3> vertices;
};
double area_of(const Triangle& t);
Vec2 centroid_of(const Triangle& t);

/// Ear clipping of a simple counter-clockwise polygon.
std::vector<Triangle> triangulate(const std::vector<Vec2>& outline);

/// Cuts such a polygon into at least `count` triangles, the longest one halved again and
/// again across its longest side.
std::vector<Triangle> pieces_of(const std::vector<Vec2>& outline, std::size_t count);

/// A compact part of a polygon.
struct PolygonPart {
  Vec2 centroid = Vec2::Zero();  ///< [m]
  double area = 0.0;             ///< [m^2]
};

/// Joins pieces to `count` (a power of two) parts of nearly the same area.
std::vector<PolygonPart> parts_of(const std::vector<Triangle>& pieces, int count);

}  // namespace prehensile
