/// The motion of a prescribed contact mode over any body of friction. Internal to the
/// mechanics layer.
#pragma once

#include "mechanics/contact_mode.h"
#include "mechanics/push_modes.h"

namespace prehensile {

template <class Body>
bool propose_in_mode(const Body& body, const ScaledPush& push,
                     const ContactModeOfPush& mode, const PlanarTwist* guess,
                     Motion& motion) {
  const PushModes<Body> modes(body, push);
  if (mode.load == ContactModeOfPush::Load::kBoth) {
    if (mode.slip != 0) return modes.both_slip_near(mode.slip, guess, motion);
    modes.both_stick(motion);
    return true;
  }
  const int i = static_cast<int>(mode.load);
  if (mode.slip != 0) {
    modes.point_slips(i, mode.slip, false, guess, motion);
  } else {
    modes.point_sticks(i, guess, motion);
  }
  return std::isfinite(motion.residual);  // judged, for better or worse
}

template <class Body>
MotionInMode motion_in_mode(const Body& body, const ScaledPush& push,
                            const ContactModeOfPush& mode, const PlanarTwist* guess) {
  const PlanarUnits& units = push.units;
  PlanarTwist scaled_guess;
  if (guess != nullptr) {
    const Vec2 v = point_velocity(*guess, push.centre) / units.rate;
    scaled_guess << v.x(), v.y(), (*guess)[2] * units.length / units.rate;
  }
  MotionInMode answer;
  Motion motion;
  if (!propose_in_mode(body, push, mode, guess != nullptr ? &scaled_guess : nullptr,
                       motion)) {
    return answer;
  }
  answer.V_HO = twist_in_hand(push, motion.u);
  answer.pivot = motion.pivot.index;
  answer.exists = answer.V_HO.allFinite();
  for (int i = 0; i < push.count; ++i) {
    answer.normal_force[i] = motion.normal[i] * units.force;
    answer.tangential_force[i] = motion.tangential[i] * units.force;
    answer.advances = answer.advances || push.approach(i) > kGrazing;
  }
  PlanarTwist unsupported;
  answer.held = body.holds(push.w_g, &unsupported);
  return answer;
}

}  // namespace prehensile
