/// Text of mesh files, made harmless for the import library. Internal to the mesh layer.
#pragma once

#include <string>

namespace prehensile::internal {

/// Vertices and faces of an OBJ file and nothing else: texture coordinates, materials and
/// the files that they name are not our business. Each vertex is written by its three
/// coordinates, each face by its vertices, counted from one. Throws BadMesh that names
/// file, line and what was expected.
std::string bare_obj(const std::string& bytes, const std::string& name);

/// Facets and vertices of a text STL file, each vertex by its three coordinates. Throws
/// BadMesh likewise.
std::string bare_stl(const std::string& bytes, const std::string& name);

}  // namespace prehensile::internal
