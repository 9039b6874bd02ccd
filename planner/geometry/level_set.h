/// Numbers on a square grid of places, and the loops on which they have a value. Internal
/// to the planner.
#pragma once

#include <array>
#include <vector>

#include "planner/loops.h"

namespace prehensile {

/// Nodes low + spacing (i, j), 0 <= i < nx, 0 <= j < ny.
struct PlaceGrid {
  Vec2 low = Vec2::Zero();  ///< [m]
  double spacing = 0.0;     ///< [m]
  int nx = 0, ny = 0;

  /// That covers a polygon and some nodes on each side of it, `per_side` over its longer
  /// side.
  static PlaceGrid over(const std::vector<Vec2>& outline, int per_side);

  int count() const { return nx * ny; }
  int index(int i, int j) const { return i * ny + j; }
  int column(int node) const { return node / ny; }
  int row(int node) const { return node % ny; }
  Vec2 place(int node) const { return low + spacing * Vec2(column(node), row(node)); }
  bool has(int i, int j) const { return i >= 0 && j >= 0 && i < nx && j < ny; }
  /// The nodes around a place and their shares of what is linear in x and y between them;
  /// as on the border beyond it.
  struct Share {
    int node;
    double share;
  };
  std::array<Share, 4> around(const Vec2& p) const;
  double interpolated(const std::vector<double>& values, const Vec2& p) const;
  /// The node next to a place, which has to be within the grid.
  int nearest(const Vec2& p) const;
};

/// The loops around `values` < level, of which linear interpolation over triangles is
/// taken; nodes on the border of the grid count as above it. Vertices off the straight
/// line through others by less than `tolerance` [m] are left out.
Loops loops_below(const PlaceGrid& grid, std::vector<double> values, double level,
                  double tolerance);

/// Whether a place is between the loops.
bool is_between(const Loops& loops, const Vec2& p);

}  // namespace prehensile
