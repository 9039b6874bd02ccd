/// Scenes and places with discs that the face clips, which tests share.
#pragma once

#include "planner/pads/spread_pads.h"
#include "scene/outline.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile::testing {

inline Scene clipped_square() {
  Scene scene = walled_square();
  scene.overhang = Overhang::kClip;
  return scene;
}

/// A place on the face at which the discs are not whole.
inline Vec2 clipped_place(const Model& model, Random& random) {
  for (;;) {
    const Vec2 p_OF = random.in_box(0.06, 0.06);
    if (contains(model.pad_face, p_OF) &&
        !model.region.is_whole(pose_from_finger(p_OF, 0.0))) {
      return p_OF;
    }
  }
}

}  // namespace prehensile::testing
