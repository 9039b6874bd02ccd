#include "planner/geometry/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace prehensile {
namespace {

constexpr int kNodesBeyond = 2;

/// A place on the edge of a triangle between two nodes, lesser first.
using EdgeOfNodes = std::pair<int, int>;

EdgeOfNodes edge_of(int u, int v) { return {std::min(u, v), std::max(u, v)}; }

/// Pieces of the loops: from edge to edge, what is below the level on the left.
using Pieces = std::map<EdgeOfNodes, EdgeOfNodes>;

/// Nodes counter-clockwise.
void add_piece(const std::array<int, 3>& nodes, const std::vector<double>& values,
               double level, Pieces& pieces) {
  const auto below = [&](int k) { return values[nodes[k % 3]] < level; };
  for (int k = 0; k < 3; ++k) {
    if (below(k) == below(k + 1) || below(k) == below(k + 2)) continue;
    EdgeOfNodes begin = edge_of(nodes[k], nodes[(k + 1) % 3]);
    EdgeOfNodes end = edge_of(nodes[k], nodes[(k + 2) % 3]);
    if (!below(k)) std::swap(begin, end);
    pieces[begin] = end;
  }
}

Vec2 place_on(const PlaceGrid& grid, const EdgeOfNodes& edge,
              const std::vector<double>& values, double level) {
  const double u = values[edge.first];
  const double v = values[edge.second];
  const double share = std::clamp((level - u) / (v - u), 0.01, 0.99);
  return grid.place(edge.first) +
         share * (grid.place(edge.second) - grid.place(edge.first));
}

/// Keeps the vertices of [first, last] that are farther than `tolerance` from the line
/// through those kept (Douglas and Peucker); the first is kept, the last is not.
void keep_corners(const std::vector<Vec2>& line, std::size_t first, std::size_t last,
                  double tolerance, std::vector<Vec2>& kept) {
  const Vec2 along = line[last] - line[first];
  double farthest = tolerance;
  std::size_t corner = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 off = line[i] - line[first];
    const double share =
        std::clamp(off.dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
    const double distance = (off - share * along).norm();
    if (distance <= farthest) continue;
    farthest = distance;
    corner = i;
  }
  if (corner == 0) {
    kept.push_back(line[first]);
    return;
  }
  keep_corners(line, first, corner, tolerance, kept);
  keep_corners(line, corner, last, tolerance, kept);
}

std::vector<Vec2> without_straight_vertices(std::vector<Vec2> loop, double tolerance) {
  const Vec2 first = loop.front();
  const auto opposite =
      std::max_element(loop.begin(), loop.end(), [&](const Vec2& u, const Vec2& v) {
        return (u - first).squaredNorm() < (v - first).squaredNorm();
      });
  const auto half = static_cast<std::size_t>(opposite - loop.begin());
  loop.push_back(first);
  std::vector<Vec2> kept;
  keep_corners(loop, 0, half, tolerance, kept);
  keep_corners(loop, half, loop.size() - 1, tolerance, kept);
  return kept;
}

}  // namespace

PlaceGrid PlaceGrid::over(const std::vector<Vec2>& outline, int per_side) {
  Vec2 low = outline.front();
  Vec2 high = low;
  for (const Vec2& vertex : outline) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  PlaceGrid grid;
  grid.spacing = (high - low).maxCoeff() / per_side;
  grid.low = low - kNodesBeyond * grid.spacing * Vec2::Ones();
  const Vec2 cells = (high - low) / grid.spacing;
  grid.nx = static_cast<int>(std::ceil(cells.x())) + 2 * kNodesBeyond + 1;
  grid.ny = static_cast<int>(std::ceil(cells.y())) + 2 * kNodesBeyond + 1;
  return grid;
}

int PlaceGrid::nearest(const Vec2& p) const {
  const Vec2 at = (p - low) / spacing;
  return index(std::clamp(static_cast<int>(std::lround(at.x())), 0, nx - 1),
               std::clamp(static_cast<int>(std::lround(at.y())), 0, ny - 1));
}

std::array<PlaceGrid::Share, 4> PlaceGrid::around(const Vec2& p) const {
  const Vec2 at = (p - low) / spacing;
  const int i = std::clamp(static_cast<int>(at.x()), 0, nx - 2);
  const int j = std::clamp(static_cast<int>(at.y()), 0, ny - 2);
  const double x = std::clamp(at.x() - i, 0.0, 1.0);
  const double y = std::clamp(at.y() - j, 0.0, 1.0);
  return {{{index(i, j), (1.0 - x) * (1.0 - y)},
           {index(i + 1, j), x * (1.0 - y)},
           {index(i, j + 1), (1.0 - x) * y},
           {index(i + 1, j + 1), x * y}}};
}

double PlaceGrid::interpolated(const std::vector<double>& values, const Vec2& p) const {
  double sum = 0.0;
  for (const auto& [node, share] : around(p)) {
    if (share > 0.0) sum += share * values[static_cast<std::size_t>(node)];
  }
  return sum;
}

Loops loops_below(const PlaceGrid& grid, std::vector<double> values, double level,
                  double tolerance) {
  for (int node = 0; node < grid.count(); ++node) {
    const int i = grid.column(node);
    const int j = grid.row(node);
    const bool inner = i > 0 && j > 0 && i + 1 < grid.nx && j + 1 < grid.ny;
    if (!inner) values[node] = std::max(values[node], 2.0 * level);
  }
  Pieces pieces;
  for (int i = 0; i + 1 < grid.nx; ++i) {
    for (int j = 0; j + 1 < grid.ny; ++j) {
      const int a = grid.index(i, j);
      const int b = grid.index(i + 1, j);
      const int c = grid.index(i + 1, j + 1);
      const int d = grid.index(i, j + 1);
      add_piece({a, b, c}, values, level, pieces);
      add_piece({a, c, d}, values, level, pieces);
    }
  }
  Loops loops;
  while (!pieces.empty()) {
    std::vector<Vec2> loop;
    auto piece = pieces.begin();
    while (piece != pieces.end()) {
      loop.push_back(place_on(grid, piece->first, values, level));
      const EdgeOfNodes next = piece->second;
      pieces.erase(piece);
      piece = pieces.find(next);
    }
    std::vector<Vec2> corners = without_straight_vertices(std::move(loop), tolerance);
    if (corners.size() >= 3) loops.push_back(std::move(corners));
  }
  return loops;
}

bool is_between(const Loops& loops, const Vec2& p) {
  bool between = false;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2& u = loop[i];
      const Vec2& v = loop[(i + 1) % loop.size()];
      if ((u.y() > p.y()) == (v.y() > p.y())) continue;
      const double x = u.x() + (p.y() - u.y()) / (v.y() - u.y()) * (v.x() - u.x());
      if (p.x() < x) between = !between;
    }
  }
  return between;
}

}  // namespace prehensile
