/// What one place of a push needs where the loads of the pads shift: no closed form
/// carries over, so spatial instants are asked with one grip force after the other.
#pragma once

#include "primitives/grip_range.h"

namespace prehensile {

/// The same scene, gripped with another force.
Model gripped(const Model& model, double force);

/// The least grip force of the search with which the pads alone hold gravity [N], the
/// pusher of this contact gone; infinity: none. A grasp that all but falls may count as
/// one that does.
double least_to_hold_in_space(const Model& model, int contact, const PlanarPose& X_HO,
                              const Vec2& g_O, const GripRangeOptions& options);

/// As `grip_sample`. The pusher sticks where the object only follows it, up to what the
/// pads yield, stays in the pad plane and would be held without it; so `stick_low` is not
/// below `hold`. Of several runs of forces it is the one around the scene's own, or
/// nearest to it.
GripSample grip_sample_in_space(const Model& model, const Grasp& start,
                                const LinearPush& push, double s,
                                const GripRangeOptions& options);

}  // namespace prehensile
