/// One member of a box of uncertainty: the whole plan, followed push by push with other
/// frictions, forces, masses and places than planned for.
#pragma once

#include "planner/plan.h"
#include "primitives/uncertainty.h"

namespace prehensile {

/// What became of a plan in one member of a box.
struct PlanTrial {
  bool is_scene = true;  ///< false: the box reaches beyond what a scene may be
  int failed_push = -1;  ///< the first that did not complete, or slipped; -1: none
  TransitionStatus status = TransitionStatus::kNotRun;  ///< of that push, or the last one
  double slipped = 0.0;                                 ///< [m] most along any pusher
  bool sticks = false;      ///< every push completed without slip
  bool reaches = false;     ///< and the pose at the end is a goal
  Grasp end;                ///< where the last push left the object
  double push_force = 0.0;  ///< [N] greatest
};

/// Longest path of a contact along a pusher that counts as sticking [m].
inline constexpr double kTrialSlip = 1e-6;

/// Follows the plan in the scene as it is at this place of the box. The unknowns are the
/// same for all pushes; the object is off its place in the hand when the first push
/// begins, and each later push begins where the one before left it. Each push begins with
/// pusher and face flush: errors of the object in the hand are carried to the end, while
/// a real pusher takes away those along its normal. So `sticks` says what the plan
/// promises, and `reaches` is rather strict.
///
/// Of a plan without pushes `sticks` says whether the fingers hold the object, and `end`
/// is where they do.
///
/// A roll is known of an object square to its support and with its centre of mass in its
/// middle only (primitives/roll.h): it is tried without errors of tilt, centre of mass
/// and angle; the angle by which the object is off in the hand is there again after it.
PlanTrial try_plan(const Model& model, const Plan& plan, const UncertaintyBox& box,
                   const BoxPoint& at, const TransitionOptions& options = {});

}  // namespace prehensile
