#include "io/scene_file.h"

#include <cstdint>
#include <cstdio>

#include "io/document.h"
#include "io/field_reader.h"
#include "io/field_schema.h"
#include "io/field_writer.h"
#include "io/mesh_scene.h"
#include "io/object_surface.h"
#include "io/scene_fields.h"

namespace prehensile {
namespace {

using internal::Faults;
using internal::Value;

constexpr auto kVisit = [](auto& fields, Scene& scene) {
  internal::visit_scene(fields, scene);
};

/// What `check` finds, at the line of the field or of the nearest value around
/// it. Where a field could not be read, what depends on it is not worth a
/// message.
void add_faults_of_values(const Scene& scene, const Value& root, Faults& faults) {
  const Faults unreadable = faults;
  for (const Fault& fault : check(scene)) {
    if (unreadable.concerns(fault.field)) continue;
    faults.add(internal::place_of(root, fault.field), fault.field, fault.what);
  }
}

Scene parsed(const std::string& text, const std::string& label,
             const std::vector<std::string>& overrides,
             const std::filesystem::path& folder, std::optional<ObjectSurface>* surface) {
  Faults faults(label, overrides);
  if (text.size() > internal::kLargestScene) {
    faults.fail({}, "",
                std::to_string(text.size()) + " bytes: expected at most " +
                    std::to_string(internal::kLargestScene) + " bytes");
  }
  Value root = internal::parse_yaml(text, faults);
  if (root.find("scene_digest")) {
    faults.fail({}, "", "a plan file: expected a scene file");
  }
  internal::apply_overrides(root, overrides, faults);
  internal::add_mass_beside_mesh(root, folder, faults);
  Scene scene;
  internal::FieldReader::read(root, "", faults, scene, kVisit);
  internal::load_mesh(scene, root, folder, faults, surface);
  add_faults_of_values(scene, root, faults);
  faults.raise();
  return scene;
}

}  // namespace

Scene parse_scene_alone(const std::string& text, const std::string& label,
                        const std::vector<std::string>& overrides,
                        const std::filesystem::path& folder) {
  return parsed(text, label, overrides, folder, nullptr);
}

SceneFile parse_scene(const std::string& text, const std::string& label,
                      const std::vector<std::string>& overrides,
                      const std::filesystem::path& folder) {
  SceneFile file;
  file.scene = parse_scene_alone(text, label, overrides, folder);
  file.text = text;
  file.digest = internal::digest_of(scene_to_yaml(file.scene));
  return file;
}

SceneFile read_scene(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides) {
  const std::string text = internal::read_text(file, internal::kLargestScene);
  return parse_scene(text, file.string(), overrides, file.parent_path());
}

std::optional<ObjectSurface> read_object_surface(
    const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const std::string text = internal::read_text(file, internal::kLargestScene);
  std::optional<ObjectSurface> surface;
  parsed(text, file.string(), overrides, file.parent_path(), &surface);
  return surface;
}

std::string scene_to_yaml(const Scene& scene) {
  Scene copy = scene;  // visitors may change what they visit; this one does not
  return internal::to_yaml(internal::FieldWriter::write(copy, kVisit));
}

std::string scene_schema() {
  Scene defaults;
  return internal::FieldSchema::document(
      "Scene of prehensile",
      "What is held, what holds it, what it is pushed against, and the "
      "regrasp that is wanted. SI units unless the key says otherwise.",
      defaults, kVisit);
}

}  // namespace prehensile
