/// Points and cells that stand for a pad, and the part of a cell that a face presses on.
/// Internal to the scene layer.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "scene/contact_region.h"
#include "scene/polygon_pieces.h"

namespace prehensile {

/// Pressure at a place of a pad, up to a factor.
class PadDensity {
 public:
  PadDensity(const Pad& pad, const PadPressure& pressure);

  /// At p in H; 0 beyond the rim of a profile that ends there.
  double operator()(const Vec2& p) const;

  bool is_uniform() const { return !hertz_ && edge_load_ == 0.0; }

 private:
  Vec2 along_;  // unit, of the pad's first side
  Vec2 half_;   // [m] half sides or radius; 0 along a side that the pad lacks
  bool round_;
  bool hertz_;
  double edge_load_;
  double mean_square_ = 0.0;  // [m^2] of the distance to the finger axis, by the profile
};

/// Quadrature of a whole pad about the finger axis, weights summing to 1. Disc: Gauss
/// rings, exact for the torque of uniform pressure; rectangle: Gauss points on four
/// panels; line: cell centres, exact for the torque; polygon: centres of triangles, with
/// the torque of the whole. Never on the rim, where points would hold too much torque.
/// `points`: 1, 4, 8, 16, 32 or 64; a hard point pad has one.
ContactPoints pad_points(const Pad& pad, const PadPressure& pressure, int points);

/// The pad as friction in the pad plane knows it: a soft point is stood for by the round
/// patch with the same largest friction moment.
Pad in_plane_equivalent(const Pad& pad);

/// Largest distance of a pad point from the finger axis [m].
double pad_reach(const Pad& pad);

/// A convex polygon, or a segment (two vertices).
struct CellShape {
  static constexpr int kMaxVertices = 12;
  int count = 0;
  std::array<Vec2, kMaxVertices> vertices;  ///< entries from `count` on are not set

  void add(const Vec2& vertex) { vertices[count++] = vertex; }
};

/// A small convex part of the pad in H; a line pad is cut into segments.
struct PadCell {
  double measure = 0.0;          ///< [m^2], or [m] for a segment
  Vec2 centroid = Vec2::Zero();  ///< [m]
  double reach = 0.0;            ///< [m] farthest vertex from the centroid
  double within = 0.0;           ///< [m] of the finger axis: no vertex is farther
  double pressure = 1.0;         ///< at the centroid, up to a factor common to the pad
  Vec2 middle = Vec2::Zero();    ///< [m] the centroid before it is scaled
  CellShape shape;               ///< last: it is looked at where an edge cuts the cell
};

/// Cuts a pad into cells, `per_side` along each side, scaled about the finger axis by the
/// few tenths of a per cent that give them the torque radius of `pad_points`: so the pad
/// loses no torque at the moment it starts to leave the face.
std::vector<PadCell> pad_cells(const Pad& pad, const PadPressure& pressure, int per_side);

/// Where the cells of a pad lie on the object at one pose.
class CellFrame {
 public:
  explicit CellFrame(const PlanarPose& X_OH)
      : p_OH_(translation(X_OH)),
        cos_(std::cos(X_OH.theta)),
        sin_(std::sin(X_OH.theta)) {}

  Vec2 in_object(const Vec2& p_H) const {
    return p_OH_ + Vec2(cos_ * p_H.x() - sin_ * p_H.y(), sin_ * p_H.x() + cos_ * p_H.y());
  }
  Vec2 turned_to_hand(const Vec2& v_O) const {
    return {cos_ * v_O.x() + sin_ * v_O.y(), cos_ * v_O.y() - sin_ * v_O.x()};
  }
  Vec2 in_hand(const Vec2& p_O) const { return turned_to_hand(p_O - p_OH_); }

 private:
  Vec2 p_OH_;
  double cos_, sin_;
};

/// The part of a cell that lies on the face; measure 0 if none.
struct PressedCell {
  double measure = 0.0;
  Vec2 centroid = Vec2::Zero();  ///< in H
};
PressedCell press(const PadCell& cell, const std::vector<Triangle>& face,
                  const CellFrame& frame) noexcept;

/// From a to b [m], in O.
struct FaceEdge {
  Vec2 a, b;
};

/// The same where this is the only edge of the face that reaches the cell.
PressedCell press_at_edge(const PadCell& cell, const FaceEdge& edge,
                          const CellFrame& frame) noexcept;

/// The same where these two are, and the face is left of both.
PressedCell press_at_corner(const PadCell& cell, const FaceEdge& one, const FaceEdge& two,
                            const CellFrame& frame) noexcept;

}  // namespace prehensile
