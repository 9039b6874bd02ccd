/// What a film shows at a time: the page computes the same in its own scripts.
#pragma once

#include "viewer/film.h"

namespace prehensile::viewer {

struct FilmState {
  Grasp grasp;                            ///< of the object in H
  double z_HO = 0.0;                      ///< [m]
  std::array<double, 2> jaw_z{0.0, 0.0};  ///< [m] in H
  PlanarPose X_WH;
  double z_WH = 0.0;  ///< [m]
};

/// [s] at the end of the film; 0 without pushes.
double duration_of(const Film& film);

/// Straight between frames; before the film its beginning, after it its end. The film has
/// phases.
FilmState state_at(const Film& film, double time);

}  // namespace prehensile::viewer
