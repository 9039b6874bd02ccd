/// Points and cells that stand for a pad, and the part of a cell that a face presses on.
/// Internal to the scene layer.
#pragma once

#include <array>
#include <vector>

#include "scene/contact_region.h"

namespace prehensile {

/// Quadrature of a whole pad about the finger axis, weights summing to 1. Disc: Gauss
/// rings, exact for the torque; rectangle: Gauss points on four panels; line: cell
/// centres, exact for the torque. Never on the rim, where points would hold too much
/// torque. `points`: 1, 4, 8, 16, 32 or 64; a point pad has one.
ContactPoints pad_points(const Pad& pad, int points);

/// Largest distance of a pad point from the finger axis [m].
double pad_reach(const Pad& pad);

/// A small convex part of the pad in H; a line pad is cut into segments (two vertices).
struct PadCell {
  static constexpr int kMaxVertices = 12;
  PadCell() { vertices.fill(Vec2::Zero()); }

  int count = 0;
  std::array<Vec2, kMaxVertices> vertices;
  double measure = 0.0;          ///< [m^2], or [m] for a segment
  Vec2 centroid = Vec2::Zero();  ///< [m]
  double reach = 0.0;            ///< [m] farthest vertex from the centroid
};

/// Cuts a pad into cells, `per_side` along each side, scaled about the finger axis by the
/// few tenths of a per cent that give them the torque radius of `pad_points`: so the pad
/// loses no torque at the moment it starts to leave the face.
std::vector<PadCell> pad_cells(const Pad& pad, int per_side);

/// A triangle of the outline, counter-clockwise, in O.
struct Triangle {
  std::array<Vec2, 3> vertices;
};

/// Ear clipping of a simple counter-clockwise polygon.
std::vector<Triangle> triangulate(const std::vector<Vec2>& outline);

/// The part of a cell that lies on the face; measure 0 if none.
struct PressedCell {
  double measure = 0.0;
  Vec2 centroid = Vec2::Zero();  ///< in H
};
PressedCell press(const PadCell& cell, const std::vector<Triangle>& face,
                  const PlanarPose& X_OH) noexcept;

}  // namespace prehensile
