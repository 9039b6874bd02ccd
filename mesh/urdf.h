/// What a robot description beside a mesh says about it.
#pragma once

#include <filesystem>
#include <optional>

namespace prehensile {

/// Mass [kg] of the body in the URDF file of the same name as the mesh, if there is such
/// a file with exactly one mass in it, > 0. Friction and inertia there are mostly
/// placeholders and are not read. Throws BadMesh for a file that is too large or no XML.
std::optional<double> mass_beside(const std::filesystem::path& mesh);

}  // namespace prehensile
