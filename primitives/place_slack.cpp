#include "primitives/place_slack.h"

#include <algorithm>
#include <cmath>

#include "primitives/space_place.h"

namespace prehensile {
namespace {

constexpr int kPathSamples = 9;

double nan_unless_finite(double slack) { return std::isfinite(slack) ? slack : kNan; }

}  // namespace

StickAlong stick_along(const Model& model, const PushContact& contact,
                       const WantedMotion& wanted, double place, const Margin& margin) {
  StickAlong along;
  const double speed = wanted.velocity.norm();
  const LinearPush push = wanted.push(0, place);
  const int samples = wanted.is_path ? kPathSamples : 1;
  for (int k = 0; k < samples; ++k) {
    const PlanarPose X_HO = pusher_pose(push, wanted.X_HO, k / (kPathSamples - 1.0));
    const StickTest nominal = exact_stick_test(model, contact, place, X_HO, push.e, speed,
                                               wanted.turn, Margin::none());
    double robust =
        exact_stick_test(model, contact, place, X_HO, push.e, speed, wanted.turn, margin)
            .slack;
    // Where the pads alone do not hold the object the motion is not the only one.
    const Vec2 p_OF = finger_in_object(X_HO);
    robust = std::min(robust, holding_slack(model, p_OF, contact.g_O, margin));
    if (k == 0) {
      along.slack = nominal.slack;
      along.robust_slack = robust;
      along.push_force = nominal.push_force;
      along.centre = nominal.centre_of_pressure;
    } else {
      along.slack = std::min(along.slack, nominal.slack);
      along.robust_slack = std::min(along.robust_slack, robust);
    }
  }
  return along;
}

PlaceSlack slack_at(const Model& model, const WantedMotion& wanted, int contact,
                    double place, const Margin& margin) {
  const PushContact& face = model.contacts[contact];
  if (!model.push_needs_space(face)) {
    const StickAlong along = stick_along(model, face, wanted, place, margin);
    return {nan_unless_finite(along.slack), nan_unless_finite(along.robust_slack)};
  }
  if (face.is_point) return {};
  PlaceSlack slack;
  slack.nominal = slack_in_space(model, wanted, contact, place);
  slack.robust = robust_slack_in_space(model, wanted, contact, place, margin);
  for (double* of : {&slack.nominal, &slack.robust}) {
    if (*of == kNoMotionInSpace) *of = kNan;
  }
  return slack;
}

}  // namespace prehensile
