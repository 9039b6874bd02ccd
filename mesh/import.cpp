#include "mesh/import.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cstring>

#include "mesh/text_mesh.h"

namespace prehensile::internal {
namespace {

constexpr std::size_t kBinaryHead = 84;  // of an STL file: text, and the count of faces
constexpr std::size_t kBinaryFace = 50;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  std::string message = name;
  message += ": ";
  message += why;
  throw BadMesh(message);
}

std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_binary_stl(const std::string& bytes) {
  if (bytes.size() < kBinaryHead) return false;
  std::uint32_t faces = 0;
  std::memcpy(&faces, bytes.data() + 80, sizeof faces);
  return bytes.size() == kBinaryHead + kBinaryFace * std::size_t{faces};
}

}  // namespace

TriangleMesh import_faces(const std::string& bytes, const std::string& name,
                          double unit) {
  const std::string ending = ending_of(name);
  std::string faces;
  if (ending == ".obj") {
    faces = bare_obj(bytes, name);
  } else if (ending == ".stl") {
    faces = is_binary_stl(bytes) ? bytes : bare_stl(bytes, name);
  } else {
    refuse(name, "unknown ending " + (ending.empty() ? "(none)" : ending) +
                     ": expected .stl or .obj");
  }

  Assimp::Importer importer;
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      static_cast<int>(aiComponent_NORMALS) | static_cast<int>(aiComponent_TEXCOORDS) |
          static_cast<int>(aiComponent_COLORS) | static_cast<int>(aiComponent_MATERIALS));
  const aiScene* scene =
      importer.ReadFileFromMemory(faces.data(), faces.size(),
                                  static_cast<unsigned>(aiProcess_RemoveComponent) |
                                      static_cast<unsigned>(aiProcess_Triangulate),
                                  ending.c_str() + 1);
  if (!scene) refuse(name, "broken: expected a mesh with vertices and faces");

  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const int first = static_cast<int>(mesh.vertices.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D& v = part.mVertices[i];
      mesh.vertices.emplace_back(unit * Vec3(v.x, v.y, v.z));
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;  // a point or a line
      mesh.triangles.push_back({first + static_cast<int>(face.mIndices[0]),
                                first + static_cast<int>(face.mIndices[1]),
                                first + static_cast<int>(face.mIndices[2])});
    }
    if (mesh.triangles.size() > kMostTriangles) {
      refuse(name, "more than " + std::to_string(kMostTriangles) +
                       " triangles: expected a simpler mesh");
    }
  }
  return mesh;
}

}  // namespace prehensile::internal
