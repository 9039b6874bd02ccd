/// The search for a push where the loads of the pads shift: spatial instants instead of
/// closed forms. What no place can do is not proved there. Internal to the primitives
/// layer.
#pragma once

#include "primitives/place.h"

namespace prehensile {

/// Slack where there is no such motion.
inline constexpr double kNoMotionInSpace = -1.0;

/// Margin by which a line sticks, least along the wanted motion: dimensionless, through
/// zero where it slips or tips; `kNoMotionInSpace` where there is none. `model` is
/// gripped with the force in question.
double slack_in_space(const Model& model, const WantedMotion& wanted, int contact,
                      double place);

/// The least slack over members of the margin box: the least friction of the pusher with
/// every corner of force, torque radius, place and centre of mass. Errors of grasp and
/// tilt are left out.
double robust_slack_in_space(const Model& model, const WantedMotion& wanted, int contact,
                             double place, const Margin& margin);

/// The first instant of the push, made forward; fills all of `placed` but the whole path.
/// Its twist is off by what goes beyond the yield of the pads.
void make_in_space(const Model& model, const WantedMotion& wanted, const Margin& margin,
                   PlacedPush& placed);

/// Where a line sticks most firmly: over the face, then NLopt (where built) around the
/// best. Fills `place` and `grip_force`; counts instants.
struct SpacePlace {
  double place = 0.0;
  double grip_force = kNan;
  double slack = -1.0;
  int evaluations = 0;
};
SpacePlace best_place_in_space(const Model& model, const WantedMotion& wanted,
                               int contact, double grip_low, double grip_high);

/// The loosest of these grip forces with which the place survives the margin box, given
/// that the tightest does: the push force falls with the grip.
double loosest_in_space(const Model& model, const WantedMotion& wanted, int contact,
                        double place, double grip_low, double grip_high,
                        const Margin& margin);

}  // namespace prehensile
