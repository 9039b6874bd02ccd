#include "mesh/import.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cstring>
#include <string_view>

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

/// Runs `take(line)` for every line, without its end.
template <typename Take>
void for_each_line(std::string_view text, const Take& take) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.front()))) {
      line.remove_prefix(1);
    }
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) {
      line.remove_suffix(1);
    }
    take(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

bool has_only(std::string_view line, std::string_view allowed) {
  return line.find_first_not_of(allowed) == std::string_view::npos;
}

/// Vertices and faces of an OBJ file and nothing else: texture coordinates, materials and
/// the files that they name are not our business. Each face is written by its vertices
/// alone.
std::string bare_obj(const std::string& bytes, const std::string& name) {
  std::string out = "o body\n";
  long vertices = 0;
  for_each_line(bytes, [&](std::string_view line) {
    if (line.starts_with("v ")) {
      if (!has_only(line.substr(2), "0123456789+-.eE \t")) {
        refuse(name, "a vertex that is not made of numbers");
      }
      ++vertices;
      out.append(line).append("\n");
    } else if (line.starts_with("f ")) {
      if (!has_only(line.substr(2), "0123456789- \t/")) {
        refuse(name, "a face that is not made of indices");
      }
      out += 'f';
      std::size_t at = 2;
      while (at < line.size()) {
        const std::size_t from = line.find_first_not_of(" \t", at);
        if (from == std::string_view::npos) break;
        const std::size_t to = std::min(line.find_first_of(" \t", from), line.size());
        const std::string word(line.substr(from, to - from));
        const long index = std::strtol(word.c_str(), nullptr, 10);
        const long vertex = index < 0 ? vertices + index + 1 : index;
        if (vertex < 1 || vertex > vertices) {
          refuse(name, "a face names vertex " + word + ": expected one of the " +
                           std::to_string(vertices) + " above it");
        }
        out += ' ';
        out += std::to_string(vertex);
        at = to;
      }
      out += '\n';
    }
  });
  return out;
}

void check_text_stl(const std::string& bytes, const std::string& name) {
  for_each_line(bytes, [&](std::string_view line) {
    const bool known = line.empty() || line.starts_with("solid") ||
                       line.starts_with("facet normal ") || line == "outer loop" ||
                       line.starts_with("vertex ") || line == "endloop" ||
                       line == "endfacet" || line.starts_with("endsolid");
    if (!known)
      refuse(
          name,
          "neither a text STL nor a binary one of the length that its count of triangles "
          "says");
    if (line.starts_with("vertex ") && !has_only(line.substr(7), "0123456789+-.eE \t")) {
      refuse(name, "a vertex that is not made of numbers");
    }
  });
}

}  // namespace

TriangleMesh import_faces(const std::string& bytes, const std::string& name,
                          double unit) {
  const std::string ending = ending_of(name);
  std::string faces;
  if (ending == ".obj") {
    faces = bare_obj(bytes, name);
  } else if (ending == ".stl") {
    if (!is_binary_stl(bytes)) check_text_stl(bytes, name);
    faces = bytes;
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
  if (!scene) refuse(name, "broken: " + std::string(importer.GetErrorString()));

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
