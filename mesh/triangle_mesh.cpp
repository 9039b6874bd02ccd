#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <numeric>

#include <Eigen/Geometry>

#include "mesh/import.h"

namespace prehensile {
namespace {

using Triangle = std::array<int, 3>;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  std::string message = name;
  message += ": ";
  message += why;
  throw BadMesh(message);
}

std::string counted(std::size_t count, const char* what) {
  std::string text = std::to_string(count);
  text += ' ';
  text += what;
  return text;
}

/// Vertices that coincide within a millionth of the size become one; faces that lose
/// their area with that, or never had any, are dropped.
void weld(TriangleMesh& mesh) {
  constexpr double kSame = 1e-6;
  const double cell = kSame * extent(mesh.vertices).maxCoeff();
  std::map<std::array<std::int64_t, 3>, int> places;
  std::vector<Vec3> kept;
  std::vector<int> index(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::array<std::int64_t, 3> place{};
    for (int k = 0; k < 3; ++k) {
      place[static_cast<std::size_t>(k)] = std::llround(mesh.vertices[i][k] / cell);
    }
    const auto [found, is_new] = places.emplace(place, static_cast<int>(kept.size()));
    if (is_new) kept.push_back(mesh.vertices[i]);
    index[i] = found->second;
  }
  std::vector<Triangle> faces;
  faces.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Triangle welded{index[static_cast<std::size_t>(t[0])],
                          index[static_cast<std::size_t>(t[1])],
                          index[static_cast<std::size_t>(t[2])]};
    const bool has_area =
        welded[0] != welded[1] && welded[1] != welded[2] && welded[2] != welded[0];
    if (has_area) faces.push_back(welded);
  }
  if (faces.size() < mesh.triangles.size()) {
    mesh.repairs.push_back(
        counted(mesh.triangles.size() - faces.size(), "faces without area dropped"));
  }
  mesh.vertices = std::move(kept);
  mesh.triangles = std::move(faces);
}

/// The two triangles at every edge; refuses edges that have one, or more than two.
struct Edge {
  std::array<int, 2> triangle{-1, -1};
  int count = 0;
};
using Edges = std::map<std::array<int, 2>, Edge>;

std::array<int, 2> edge_key(const Triangle& t, int side) {
  const int a = t[static_cast<std::size_t>(side)];
  const int b = t[static_cast<std::size_t>((side + 1) % 3)];
  return {std::min(a, b), std::max(a, b)};
}

Edges edges_of(const TriangleMesh& mesh, const std::string& name) {
  Edges edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int side = 0; side < 3; ++side) {
      Edge& edge = edges[edge_key(mesh.triangles[i], side)];
      if (edge.count < 2) {
        edge.triangle[static_cast<std::size_t>(edge.count)] = static_cast<int>(i);
      }
      ++edge.count;
    }
  }
  std::size_t open = 0;
  std::size_t branching = 0;
  for (const auto& [key, edge] : edges) {
    if (edge.count == 1) ++open;
    if (edge.count > 2) ++branching;
  }
  if (open > 0) {
    refuse(name,
           counted(open, "edges belong to one face only: expected a closed surface"));
  }
  if (branching > 0) {
    refuse(name, counted(branching,
                         "edges belong to more than two faces: expected a surface that "
                         "does not branch and is not doubled"));
  }
  return edges;
}

bool runs_along(const Triangle& t, const std::array<int, 2>& edge) {
  for (std::size_t side = 0; side < 3; ++side) {
    if (t[side] == edge[0] && t[(side + 1) % 3] == edge[1]) return true;
  }
  return false;
}

/// A connected piece of the surface.
struct Shell {
  std::vector<int> triangles;
  double volume = 0.0;  ///< signed [m^3]
  Vec3 low, high;
};

double signed_volume(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  const Vec3& b = mesh.vertices[static_cast<std::size_t>(t[1])];
  const Vec3& c = mesh.vertices[static_cast<std::size_t>(t[2])];
  return a.dot(b.cross(c)) / 6.0;
}

void measure(const TriangleMesh& mesh, Shell& shell) {
  const Triangle& first = mesh.triangles[static_cast<std::size_t>(shell.triangles[0])];
  shell.low = shell.high = mesh.vertices[static_cast<std::size_t>(first[0])];
  shell.volume = 0.0;
  for (const int i : shell.triangles) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(i)];
    shell.volume += signed_volume(mesh, t);
    for (const int v : t) {
      shell.low = shell.low.cwiseMin(mesh.vertices[static_cast<std::size_t>(v)]);
      shell.high = shell.high.cwiseMax(mesh.vertices[static_cast<std::size_t>(v)]);
    }
  }
}

/// Shells with faces that agree on which side is out; returns how many were turned.
std::vector<Shell> oriented_shells(TriangleMesh& mesh, const Edges& edges,
                                   const std::string& name, std::size_t& turned) {
  std::vector<int> shell_of(mesh.triangles.size(), -1);
  std::vector<Shell> shells;
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (shell_of[seed] >= 0) continue;
    const int number = static_cast<int>(shells.size());
    Shell& shell = shells.emplace_back();
    shell.triangles.push_back(static_cast<int>(seed));
    shell_of[seed] = number;
    for (std::size_t next = 0; next < shell.triangles.size(); ++next) {
      const int here = shell.triangles[next];
      for (int side = 0; side < 3; ++side) {
        const auto key = edge_key(mesh.triangles[static_cast<std::size_t>(here)], side);
        const Edge& edge = edges.at(key);
        const int there = edge.triangle[0] == here ? edge.triangle[1] : edge.triangle[0];
        Triangle& other = mesh.triangles[static_cast<std::size_t>(there)];
        const bool agrees = runs_along(mesh.triangles[static_cast<std::size_t>(here)],
                                       key) != runs_along(other, key);
        if (shell_of[static_cast<std::size_t>(there)] < 0) {
          if (!agrees) {
            std::swap(other[0], other[1]);
            ++turned;
          }
          shell_of[static_cast<std::size_t>(there)] = number;
          shell.triangles.push_back(there);
        } else if (!agrees) {
          refuse(name, "a surface with one side only: expected a solid body");
        }
      }
    }
    measure(mesh, shell);
  }
  return shells;
}

bool lies_inside(const Shell& inner, const Shell& outer) {
  return (inner.low.array() > outer.low.array()).all() &&
         (inner.high.array() < outer.high.array()).all();
}

/// Turns shells that look inwards, but for cavities: those lie inside another shell.
void turn_outwards(TriangleMesh& mesh, std::vector<Shell>& shells, std::size_t& turned) {
  const double total =
      std::accumulate(shells.begin(), shells.end(), 0.0,
                      [](double sum, const Shell& shell) { return sum + shell.volume; });
  const double sign = total < 0.0 ? -1.0 : 1.0;
  for (Shell& shell : shells) {
    const bool is_cavity =
        sign * shell.volume < 0.0 &&
        std::any_of(shells.begin(), shells.end(), [&](const Shell& other) {
          return sign * other.volume > 0.0 && lies_inside(shell, other);
        });
    const double wanted = is_cavity ? -1.0 : 1.0;
    if (wanted * shell.volume >= 0.0) continue;
    for (const int i : shell.triangles) {
      Triangle& t = mesh.triangles[static_cast<std::size_t>(i)];
      std::swap(t[0], t[1]);
    }
    turned += shell.triangles.size();
  }
}

void mend(TriangleMesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) refuse(name, "no faces: expected a closed surface");
  for (const Vec3& v : mesh.vertices) {
    if (!v.allFinite() || v.cwiseAbs().maxCoeff() > 100.0) {
      refuse(name,
             "a vertex is not finite or farther than 100 m from the origin: "
             "expected a body that a gripper can hold (is the unit right?)");
    }
  }
  if (!(extent(mesh.vertices).maxCoeff() > 1e-6)) {
    refuse(name, "smaller than 1e-6 m: expected a body (is the unit right?)");
  }
  weld(mesh);
  if (mesh.triangles.empty()) refuse(name, "no face has an area");
  const Edges edges = edges_of(mesh, name);
  std::size_t turned = 0;
  std::vector<Shell> shells = oriented_shells(mesh, edges, name, turned);
  turn_outwards(mesh, shells, turned);
  if (turned > 0) mesh.repairs.push_back(counted(turned, "faces turned outwards"));
  const double size = extent(mesh.vertices).maxCoeff();
  if (!(properties_of(mesh).volume > 1e-9 * size * size * size)) {
    refuse(name, "no volume: expected a solid body");
  }
}

}  // namespace

Vec3 extent(const std::vector<Vec3>& vertices) {
  Vec3 low = vertices.front();
  Vec3 high = low;
  for (const Vec3& v : vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return high - low;
}

TriangleMesh mesh_from_bytes(const std::string& bytes, const std::string& name,
                             double unit) {
  TriangleMesh mesh = internal::import_faces(bytes, name, unit);
  mend(mesh, name);
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& file, double unit) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    refuse(file.string(), "cannot be read: expected an STL or OBJ file");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kLargestMesh) {
    refuse(file.string(),
           "too large: expected at most " + std::to_string(kLargestMesh) + " bytes");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) refuse(file.string(), "cannot be read");
  return mesh_from_bytes(bytes, file.string(), unit);
}

MeshProperties properties_of(const TriangleMesh& mesh) {
  MeshProperties properties;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const Vec3 origin = mesh.vertices.front();  // near the body: no cancellation
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])] - origin;
    const Vec3 b = mesh.vertices[static_cast<std::size_t>(t[1])] - origin;
    const Vec3 c = mesh.vertices[static_cast<std::size_t>(t[2])] - origin;
    const double v = a.dot(b.cross(c)) / 6.0;
    const Vec3 sum = a + b + c;
    properties.volume += v;
    properties.centroid += v / 4.0 * sum;
    second += v / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() +
               sum * sum.transpose());
  }
  if (!(properties.volume > 0.0)) return properties;
  properties.centroid /= properties.volume;
  properties.spread =
      second / properties.volume - properties.centroid * properties.centroid.transpose();
  properties.centroid += origin;
  return properties;
}

}  // namespace prehensile
