/// Triangle meshes of solid bodies: read, mended where that is safe, refused with a
/// reason otherwise.
#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// What is wrong with a mesh; what() names the file and what was expected.
class BadMesh : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A closed surface, triangles counter-clockwise seen from outside. It may have several
/// shells: cavities, or parts that overlap (then volumes count twice where they do).
struct TriangleMesh {
  std::vector<Vec3> vertices;                 ///< [m] in the frame M of the file
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
  std::vector<std::string> repairs;           ///< what was mended, for people
};

/// Sides of the box around the vertices, along the axes of M [m]; at least one vertex.
Vec3 extent(const std::vector<Vec3>& vertices);

inline constexpr std::uintmax_t kLargestMesh = 50'000'000;  ///< bytes
inline constexpr int kMostTriangles = 50'000;

/// Reads an STL (text or binary) or OBJ file; `unit` [m] is the length that 1 stands for.
/// Only vertices and faces are looked at: no file that it names is ever opened.
///
/// Mended: vertices that coincide within 1e-6 of the size are one, faces without area are
/// dropped, shells whose faces disagree or look inwards are turned. Throws BadMesh for
/// other formats, files that are broken, too large or not finite, surfaces that are open,
/// doubled or branch, and bodies without volume.
TriangleMesh read_mesh(const std::filesystem::path& file, double unit);

/// The same from the bytes of a file; `name` decides the format by its ending.
TriangleMesh mesh_from_bytes(const std::string& bytes, const std::string& name,
                             double unit);

/// Mass properties of the homogeneous body.
struct MeshProperties {
  double volume = 0.0;                               ///< [m^3]
  Vec3 centroid = Vec3::Zero();                      ///< [m] in M
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< [m^2] mean of r r^T about the
                                                     ///< centroid, in M
};
MeshProperties properties_of(const TriangleMesh& mesh);

}  // namespace prehensile
