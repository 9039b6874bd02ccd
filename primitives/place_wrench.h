/// The wrench that a wanted motion asks of the pusher. Internal to the search for places.
#pragma once

#include "primitives/place.h"

namespace prehensile {

struct NeededWrench {
  PlanarWrench w = PlanarWrench::Zero();  ///< pusher on object, about the finger axis, H
  double unknown_force = 0.0;             ///< [N] bound of a pad point that does not slip
  Vec2 unknown_at = Vec2::Zero();
};

/// At the start of the motion, over the real pads at this grip force.
NeededWrench needed_wrench(const Model& model, const WantedMotion& wanted,
                           const PushContact& contact, double grip_force);

/// Some part of the face moves towards the object's inside: the pusher follows it.
bool advances(const PushContact& contact, const WantedMotion& wanted);

struct GripLimits {
  double low, high;
};
GripLimits grip_limits(const Model& model, const PlaceOptions& options);

}  // namespace prehensile
