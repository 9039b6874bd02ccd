/// Pushers in the way of the arm: every pusher but the one at work stands in W all the
/// time, and the held object must not be carried through it.
#pragma once

#include <vector>

#include "planner/arm/arm_motion.h"

namespace prehensile {

/// Where a pusher is first found to cut the held object.
struct ArmCrossing {
  int pusher = 0;  ///< index in Scene::pushers
  ArmPhase phase = ArmPhase::kTransit;
  int push = 0;    ///< as in ArmSample
  double t = 0.0;  ///< [s] of the sample
};

/// The pushers that cut the outline of the held object, by more than 0.1 mm, at a sample
/// of the motion of this plan; each once, in the order in which they are met. Nothing is
/// looked at between samples. A line or plane without a length counts as endless; the
/// pusher at work does not count, but it does in a transit. The object counts as its
/// outline over its whole height, and as at rest in the hand while it rolls.
std::vector<ArmCrossing> arm_crossings(const Model& model, const Plan& plan,
                                       const ArmMotion& motion);

}  // namespace prehensile
