/// How firmly a pusher sticks at a place while the object makes a wanted motion, over the
/// real pads in the pad plane. Internal to the primitives layer.
#pragma once

#include "primitives/place.h"

namespace prehensile {

struct StickAlong {
  double slack = kNan;  ///< nominal, least along the path; infinite: no such motion
  double robust_slack = kNan;  ///< over the margin
  double push_force = kNan;    ///< [N] at the start
  double centre = kNan;        ///< [m] of pressure at the start, from the face's centre
};

/// `model` is gripped with the force in question.
StickAlong stick_along(const Model& model, const PushContact& contact,
                       const WantedMotion& wanted, double place, const Margin& margin);

}  // namespace prehensile
