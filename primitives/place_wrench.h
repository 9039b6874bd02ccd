/// The wrench that a wanted motion asks of the pusher. Internal to the search for places.
#pragma once

#include "primitives/place.h"

namespace prehensile {

struct NeededWrench {
  PlanarWrench w = PlanarWrench::Zero();  ///< pusher on object, about the finger axis, H
  double unknown_force = 0.0;             ///< [N] bound of a pad point that does not slip
  Vec2 unknown_at = Vec2::Zero();
};

/// At the start of the motion, over the real pads.
NeededWrench needed_wrench(const Model& model, const WantedMotion& wanted,
                           const PushContact& contact);

/// Some part of the face moves towards the object's inside: the pusher follows it.
bool advances(const PushContact& contact, const WantedMotion& wanted);

struct GripLimits {
  double low, high;
};
GripLimits grip_limits(const Model& model, const PlaceOptions& options);

/// The same scene with another grip force, of which the friction of the pads is an affine
/// function.
Model with_grip(const Model& model, double grip_force);

/// The scene at both ends of the allowed grip forces: to be made once where many motions
/// are asked about, because the points of a pad may take milliseconds.
struct GripEnds {
  GripEnds(const Model& model, const PlaceOptions& options);
  GripLimits limits;
  Model loosest, tightest;
};
std::vector<ContactVerdict> verdicts_of(const GripEnds& ends, const WantedMotion& wanted,
                                        const PlaceOptions& options);

}  // namespace prehensile
