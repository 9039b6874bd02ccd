/// Scenes whose object is a mesh file: the file is loaded and a solid put in its place.
/// Internal to the io layer.
#pragma once

#include "io/document.h"
#include "scene/object_surface.h"
#include "scene/scene.h"

namespace prehensile::internal {

/// Gives `object` the mass that a robot description beside the mesh states, where the
/// scene has none.
void add_mass_beside_mesh(Value& root, const std::filesystem::path& folder,
                          Faults& faults);

/// Replaces a MeshShape by the solid that its file holds. Faults name the field.
/// `surface`, if not null, gets the triangles to look at.
void load_mesh(Scene& scene, const Value& root, const std::filesystem::path& folder,
               Faults& faults, std::optional<ObjectSurface>* surface);

}  // namespace prehensile::internal
