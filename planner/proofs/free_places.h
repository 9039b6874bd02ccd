/// In which directions sticking pushes can carry the finger axis at a place, for the
/// finders of proofs. Internal to the planner.
#pragma once

#include "mechanics/model.h"
#include "planner/geometry/free_directions.h"
#include "planner/pads/place_slacks.h"

namespace prehensile {

/// Over pads that are whole wherever they are. `model` must outlive what is returned.
FreeAt free_over_whole_pads(const Model& model);

/// Over discs that the face clips; so much slack, over F, may be missing. `slacks`, of
/// the same model, must outlive what is returned.
FreeAt free_over_clipped_discs(const Model& model, PlaceSlacks& slacks, double allowed);

/// The same, with nothing missing and no grid where the discs are whole.
FreeAt free_closely_over_clipped_discs(const Model& model, PlaceSlacks& slacks,
                                       double allowed);

}  // namespace prehensile
