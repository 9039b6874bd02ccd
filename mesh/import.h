/// Faces of a mesh file, by the import library. Internal to the mesh layer.
#pragma once

#include <string>

#include "mesh/triangle_mesh.h"

namespace prehensile::internal {

/// Triangles as the file has them, polygons cut up, lengths times `unit`. The format is
/// told by the ending of `name`. Throws BadMesh.
TriangleMesh import_faces(const std::string& bytes, const std::string& name, double unit);

}  // namespace prehensile::internal
