/// What the object of a scene looks like, where its shape is a mesh file.
#pragma once

#include <optional>

#include "io/scene_file.h"
#include "scene/object_surface.h"

namespace prehensile {

/// The triangles of the object in O, few enough for a page (mesh/few_triangles.h);
/// nothing for other shapes. Throws BadInput as `read_scene` does.
std::optional<ObjectSurface> read_object_surface(
    const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace prehensile
