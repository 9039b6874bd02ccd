#include "mesh/few_triangles.h"

#include <algorithm>
#include <map>

namespace prehensile {
namespace {

constexpr int kFinest = 256;  // cells along the longest side
constexpr double kCoarser = 0.85;

struct Cell {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  int chosen = -1;  // index of a vertex
};

/// Of each vertex, the one that stands for all in its cell.
std::vector<int> representatives(const std::vector<Vec3>& vertices, const Vec3& low,
                                 double size) {
  const auto key = [&](const Vec3& p) {
    const Eigen::Vector3i at = ((p - low) / size).array().floor().cast<int>();
    return std::array<int, 3>{at.x(), at.y(), at.z()};
  };
  std::map<std::array<int, 3>, Cell> cells;
  for (const Vec3& p : vertices) {
    Cell& cell = cells[key(p)];
    cell.sum += p;
    ++cell.count;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Cell& cell = cells[key(vertices[i])];
    const Vec3 mean = cell.sum / cell.count;
    if (cell.chosen < 0 ||
        (vertices[i] - mean).norm() <
            (vertices[static_cast<std::size_t>(cell.chosen)] - mean).norm()) {
      cell.chosen = static_cast<int>(i);
    }
  }
  std::vector<int> chosen;
  chosen.reserve(vertices.size());
  for (const Vec3& p : vertices) chosen.push_back(cells[key(p)].chosen);
  return chosen;
}

/// The triangles that are left when vertices are one, and only the vertices that they
/// use.
ObjectSurface merged(const std::vector<Vec3>& vertices,
                     const std::vector<std::array<int, 3>>& triangles,
                     const std::vector<int>& chosen) {
  ObjectSurface surface;
  std::vector<int> number(vertices.size(), -1);
  for (const std::array<int, 3>& triangle : triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = chosen[static_cast<std::size_t>(triangle[k])];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] ||
        corners[2] == corners[0]) {
      continue;
    }
    for (int& corner : corners) {
      const auto at = static_cast<std::size_t>(corner);
      if (number[at] < 0) {
        number[at] = static_cast<int>(surface.vertices.size());
        surface.vertices.push_back(vertices[at]);
      }
      corner = number[at];
    }
    surface.triangles.push_back(corners);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& stands_for = vertices[static_cast<std::size_t>(chosen[i])];
    surface.off = std::max(surface.off, (vertices[i] - stands_for).norm());
  }
  return surface;
}

}  // namespace

ObjectSurface few_triangles(const TriangleMesh& mesh, const Eigen::Isometry3d& X_OM,
                            int most) {
  ObjectSurface whole{.triangles = mesh.triangles};
  Vec3 low = Vec3::Constant(1e9);
  Vec3 high = -low;
  for (const Vec3& p : mesh.vertices) {
    whole.vertices.push_back(X_OM * p);
    low = low.cwiseMin(whole.vertices.back());
    high = high.cwiseMax(whole.vertices.back());
  }
  if (static_cast<int>(mesh.triangles.size()) <= most) return whole;
  ObjectSurface few;
  for (double cells = kFinest; cells >= 1.0; cells *= kCoarser) {
    const double size = (high - low).maxCoeff() / cells;
    few = merged(whole.vertices, whole.triangles,
                 representatives(whole.vertices, low, size));
    if (static_cast<int>(few.triangles.size()) <= most) break;
  }
  return few;
}

}  // namespace prehensile
