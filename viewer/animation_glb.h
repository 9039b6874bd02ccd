/// A film as an animated GLB file (glTF 2.0, binary): for Blender, game engines and other
/// viewers. The world stands still, the hand moves; y is up as in most scenes.
#pragma once

#include <string>

#include "viewer/film.h"

namespace prehensile::viewer {

/// The bytes of the file. Throws std::runtime_error where this build has no tinygltf
/// (`has_glb`). Without pushes: the scene at its start, not animated.
std::string animation_glb(const Model& model, const Film& film);

bool has_glb();

}  // namespace prehensile::viewer
