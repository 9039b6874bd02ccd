#include "benchmarks/suite/scene_of_mesh.h"

#include <cstdio>

#include "benchmarks/suite/suite_fields.h"
#include "io/document.h"
#include "io/scene_file.h"

namespace prehensile::suite {
namespace {

std::string unit_word(double unit) {
  for (const auto& word : kMeshUnitWords) {
    if (word.value == unit) return std::string(word.text);
  }
  return "m";
}

internal::Value number(double value) {
  return internal::Value::plain(internal::number_text(value));
}

internal::Value walls(double friction) {
  using internal::Value;
  Value list = Value::list();
  const char* const names[] = {"wall", "floor", "back", "ceiling"};
  for (int side = 0; side < 4; ++side) {
    Value& wall = list.items.emplace_back(Value::map());
    wall.add("name", Value::plain(names[side]));
    wall.add("line", Value::map());
    wall.add("friction", number(friction));
    wall.add("normal_deg", number(90.0 * side));
  }
  return list;
}

}  // namespace

Scene scene_of_mesh(const MeshFiles& meshes, const std::filesystem::path& file) {
  using internal::Value;
  Value root = Value::map();
  root.add("version", number(1));
  Value& object = root.add("object", Value::map());
  Value& mesh = object.add("mesh", Value::map());
  mesh.add("file", Value::quoted(file.filename().string()));
  mesh.add("unit", Value::plain(unit_word(meshes.unit)));
  object.add("mass", number(meshes.mass));
  Value& gripper = root.add("gripper", Value::map());
  Value& pad = gripper.add("pad", Value::map()).add("disc", Value::map());
  pad.add("radius", number(meshes.pad_radius));
  gripper.add("friction", number(meshes.finger_friction));
  gripper.add("grip_force", number(meshes.grip_force));
  root.add("pushers", walls(meshes.pusher_friction));
  return parse_scene_alone(internal::to_yaml(root), file.string(), {},
                           file.parent_path());
}

}  // namespace prehensile::suite
