#include "io/mesh_scene.h"

#include <algorithm>
#include <limits>

#ifdef PREHENSILE_HAS_MESHES
#include "mesh/face_pairs.h"
#include "mesh/few_triangles.h"
#include "mesh/urdf.h"
#endif

namespace prehensile::internal {

#ifdef PREHENSILE_HAS_MESHES
namespace {

namespace fs = std::filesystem;

constexpr const char* kField = "object.mesh.file";

/// The file, if it lies in the folder or below it, links followed; else empty.
fs::path inside(const fs::path& folder, const std::string& file) {
  const fs::path name(file);
  if (file.empty() || name.is_absolute()) return {};
  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  const fs::path full = fs::weakly_canonical(root / name, error);
  if (error) return {};
  const auto [end, rest] =
      std::mismatch(root.begin(), root.end(), full.begin(), full.end());
  return end == root.end() && rest != full.end() ? full : fs::path{};
}

/// How far a pair is from what the scene asks for: direction first, then place.
const FacePair* chosen(const std::vector<FacePair>& pairs, const MeshShape& mesh) {
  if (!mesh.closing && !mesh.near_point) {
    const auto found =
        std::find_if(pairs.begin(), pairs.end(),
                     [&](const FacePair& pair) { return pair.name == mesh.pair; });
    return found == pairs.end() ? nullptr : &*found;
  }
  constexpr double kSameDirection = 1e-3;
  const auto turn = [&](const FacePair& pair) {
    if (!mesh.closing) return 0.0;
    return 1.0 - std::abs(mesh.closing->normalized().dot(pair.closing));
  };
  const auto distance = [&](const FacePair& pair) {
    return mesh.near_point ? (*mesh.near_point - pair.centre).norm() : 0.0;
  };
  double least_turn = std::numeric_limits<double>::infinity();
  for (const FacePair& pair : pairs) least_turn = std::min(least_turn, turn(pair));
  const FacePair* best = nullptr;
  for (const FacePair& pair : pairs) {
    if (turn(pair) > least_turn + kSameDirection) continue;
    if (!best || distance(pair) < distance(*best)) best = &pair;
  }
  return best;
}

std::string names_of(const std::vector<FacePair>& pairs) {
  std::string names;
  for (const FacePair& pair : pairs) names += (names.empty() ? "" : ", ") + pair.name;
  return names;
}

void load(const MeshShape& mesh, const fs::path& folder, Scene& scene, const Value& root,
          Faults& faults, std::optional<ObjectSurface>* surface) {
  const Place place = place_of(root, kField);
  const fs::path file = inside(folder, mesh.file);
  if (file.empty()) {
    faults.add(place, kField,
               shown(mesh.file) + ": expected a file in the folder of the scene");
    return;
  }
  const TriangleMesh triangles = read_mesh(file, mesh.unit);
  const std::vector<FacePair> pairs = find_face_pairs(triangles);
  if (pairs.empty()) {
    faults.add(place, kField,
               shown(mesh.file) +
                   ": no two flat faces that look away from each other: "
                   "expected a body that flat jaws can hold");
    return;
  }
  if (const FacePair* pair = chosen(pairs, mesh)) {
    const HeldBody body = body_between(triangles, *pair);
    scene.object.shape = body.shape;
    if (surface) *surface = few_triangles(triangles, body.X_MO.inverse());
    return;
  }
  faults.add(place_of(root, "object.mesh.pair"), "object.mesh.pair",
             shown(mesh.pair) + ": expected one of " + names_of(pairs));
}

}  // namespace

void add_mass_beside_mesh(Value& root, const fs::path& folder, Faults& faults) try {
  const Value& file = deepest(root, kField);
  const Value* object = root.find("object");
  if (!object || object->find("mass") || !object->find("mesh") ||
      (file.kind != Value::Kind::kPlain && file.kind != Value::Kind::kText)) {
    return;
  }
  const fs::path mesh = inside(folder, file.text);
  if (mesh.empty()) return;
  const std::optional<double> mass = mass_beside(mesh);
  if (!mass) return;
  for (Entry& entry : root.entries) {
    if (entry.key == "object") entry.value.add("mass", Value::plain(number_text(*mass)));
  }
} catch (const BadMesh& bad) {
  faults.add(place_of(root, kField), "object.mass", bad.what());
}

void load_mesh(Scene& scene, const Value& root, const fs::path& folder, Faults& faults,
               std::optional<ObjectSurface>* surface) {
  const auto* mesh = std::get_if<MeshShape>(&scene.object.shape);
  if (!mesh || faults.concerns("object.mesh")) return;
  try {
    load(MeshShape(*mesh), folder, scene, root, faults, surface);
  } catch (const BadMesh& bad) {
    faults.add(place_of(root, kField), kField, bad.what());
  }
  if (faults.concerns("object.mesh")) faults.pass_over("object");
}

#else

void add_mass_beside_mesh(Value&, const std::filesystem::path&, Faults&) {}

void load_mesh(Scene& scene, const Value& root, const std::filesystem::path&,
               Faults& faults, std::optional<ObjectSurface>*) {
  if (!std::holds_alternative<MeshShape>(scene.object.shape)) return;
  faults.add(place_of(root, "object.mesh"), "object.mesh",
             "this build reads no meshes: expected another shape");
  faults.pass_over("object");
}

#endif

}  // namespace prehensile::internal
