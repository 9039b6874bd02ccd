/// Key frames of a film as one picture, without a browser: each push seen along the
/// closing direction from the hand, before and after.
#pragma once

#include <string>

#include "viewer/film.h"

namespace prehensile::viewer {

/// SVG text on white; at most `most` pushes, the rest counted in words. A film without
/// pushes shows the start and the goal.
std::string key_frames(const Model& model, const Film& film, int most = 12);

}  // namespace prehensile::viewer
