/// A film and the scene it plays in as JSON: all that the page knows. docs/viewer.md
/// describes the fields.
#pragma once

#include <string>

#include "viewer/film.h"

namespace prehensile::viewer {

/// SI units and radians; lengths rounded to 1e-7 m, everything else to six digits. What
/// is not a number is null. Pads are written at as many frames as have about `pad_points`
/// points in all.
std::string to_json(const Model& model, const Plan& plan, const Film& film,
                    int pad_points = 15'000);

}  // namespace prehensile::viewer
