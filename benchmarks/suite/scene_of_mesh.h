/// A scene around a mesh file. Internal to the suite.
#pragma once

#include <filesystem>

#include "benchmarks/suite/suite.h"

namespace prehensile::suite {

/// The object of the file between two round pads, among four walls, gravity along -y.
/// Throws BadInput for files that are no meshes, or that flat jaws cannot hold.
Scene scene_of_mesh(const MeshFiles& meshes, const std::filesystem::path& file);

}  // namespace prehensile::suite
