/// A push: the choice of a contact and of the pusher's motion. The pusher stands still in
/// the world and the hand moves; seen from the hand, the pusher follows the path below.
///
/// The pusher frame P coincides with O when the push starts. Along a linear push the
/// finger axis runs straight in P, or along an arc, while the hand turns at a constant
/// rate; an object that sticks to the pusher rides in P. Slide and pivot are the named
/// cases of paper section VII.
#pragma once

#include <variant>

#include "mechanics/model.h"

namespace prehensile {

/// The general push: the pusher translates and turns. With bend = -turn its twist in the
/// hand is constant: a screw, which turns every point of it on an arc about one centre.
struct LinearPush {
  int contact = 0;      ///< index in Model::contacts
  double place = 0.0;   ///< [m] of the pusher's centre along t from the face's centre
  Vec2 e = {1.0, 0.0};  ///< unit, in P: direction in which the pusher moves in the hand
  double travel = 0.0;  ///< [m] >= 0, length of the finger axis' path in P
  double turn = 0.0;    ///< [rad] of the pusher in the hand over the whole push
  double bend = 0.0;    ///< [rad] by which e turns in P over the whole push; 0: straight
};

/// Straight slide (paper VII-A): no turn; guarded against rotation of the object.
struct Slide {
  int contact = 0;
  double place = 0.0;
  Vec2 e = {1.0, 0.0};
  double travel = 0.0;
  double guard_angle =
      0.05;  ///< [rad] the object may turn before the guard stops the push
};

/// Pivot about the finger axis (paper VII-B); guarded against drift of the finger axis.
struct Pivot {
  int contact = 0;
  double place = 0.0;
  double turn = 0.0;
  double guard_distance = 1e-3;  ///< [m] the finger axis may drift in the object
};

/// Roll (paper VII-C): the pusher, a support under a round object, moves along the
/// closing direction; the object turns about its own axis by travel / radius.
///
/// A grasp that holds the object against gravity leaves it open whether the support or
/// the fingers carry it. So the fingers may loosen: the support takes the weight, the
/// object rolls, the fingers close again. A loose grip is also what the paper finds to
/// roll best.
struct Roll {
  int contact = 0;
  double travel = 0.0;      ///< [m] signed, along +z of H
  double grip_force = 0.0;  ///< [N] of each finger during the roll; 0: that of the scene
};

using Push = std::variant<LinearPush, Slide, Pivot, Roll>;

int contact_of(const Push& push);

/// The pusher's path for slide, pivot and linear push.
LinearPush as_linear(const Push& push);

/// Pose of P in H when the share s in [0, 1] of the push is done.
PlanarPose pusher_pose(const LinearPush& push, const PlanarPose& X_HO_start,
                       double s) noexcept;

/// Twist of the pusher in H per unit of s.
PlanarTwist pusher_twist(const LinearPush& push, const PlanarPose& X_HO_start,
                         double s) noexcept;

/// "slide", "pivot", "roll" or "push": the name of what a motion is. `travel_tolerance`
/// [m] and `turn_tolerance` [rad] say when a part counts as absent.
const char* kind_name(double travel, double turn, double roll,
                      double travel_tolerance = 1e-6, double turn_tolerance = 1e-6);

}  // namespace prehensile
