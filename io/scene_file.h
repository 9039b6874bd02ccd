/// Scene files: YAML, version 1, SI units unless the key says otherwise. Every fault
/// names file, line, field, value and what was expected.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace prehensile {

/// What is wrong with an input file or an option; what() holds every message, one per
/// line: `file:line: field: value: expected ...`.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct SceneFile {
  Scene scene;
  std::string text;  ///< as read, overrides not included
  std::string
      digest;  ///< of the scene with its overrides (FNV-1a 64, hex): ties plans to it
};

/// Reads a scene. `overrides` are `path=value` pairs of the command line's --set, e.g.
/// "gripper.grip_force=30" or "pushers.0.friction=0.5". Throws BadInput.
SceneFile read_scene(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

/// The same from text; `label` stands for the file's name in messages, `folder` is where
/// the mesh files of the scene lie.
SceneFile parse_scene(const std::string& text, const std::string& label,
                      const std::vector<std::string>& overrides = {},
                      const std::filesystem::path& folder = {});

/// The scene alone, for many overrides of one text: the digest costs as much again.
Scene parse_scene_alone(const std::string& text, const std::string& label,
                        const std::vector<std::string>& overrides = {},
                        const std::filesystem::path& folder = {});

/// A complete scene file, every field written out.
std::string scene_to_yaml(const Scene& scene);

/// The JSON Schema of scene files, generated from the same field list as the reader.
std::string scene_schema();

}  // namespace prehensile
