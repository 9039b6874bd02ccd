/// Meshes for tests and examples: straight prisms as OBJ and STL files.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// Closed surface of the prism over a simple counter-clockwise polygon, z from `low` to
/// `high`; every face is a triangle, outwards.
struct ExtrudedMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};
ExtrudedMesh extruded(const std::vector<Vec2>& outline, double low, double high);

/// Several bodies in one file are allowed: `parts` follow each other.
std::string to_obj(const std::vector<ExtrudedMesh>& parts);
std::string to_text_stl(const std::vector<ExtrudedMesh>& parts);
std::string to_binary_stl(const std::vector<ExtrudedMesh>& parts);

/// The bracket of problems/bracket.yaml [mm]: an L with a foot.
ExtrudedMesh bracket();

}  // namespace prehensile
