#include "planner/checks/plan_trial.h"

#include <algorithm>

#include "mechanics/violation.h"
#include "planner/checks/holding_check.h"
#include "planner/planner.h"

namespace prehensile {
namespace {

void set_contact(Push& push, int contact) {
  std::visit([contact](auto& kind) { kind.contact = contact; }, push);
}

constexpr auto kAngle = static_cast<std::size_t>(Unknown::kGraspAngle);

/// What the law of rolls knows of the box: forces, frictions and places.
UncertaintyBox box_of_rolls(UncertaintyBox box) {
  for (const Unknown unknown : {Unknown::kCentreOfMassX, Unknown::kCentreOfMassY,
                                Unknown::kTilt, Unknown::kGraspAngle}) {
    box[unknown] = 0.0;
  }
  return box;
}

Grasp turned(const Grasp& grasp, double angle) {
  Grasp other = grasp;
  other.X_HO = pose_from_finger(finger_in_object(grasp.X_HO), grasp.X_HO.theta + angle);
  return other;
}

/// A plan without pushes: the fingers hold the object, and where they hold it is a goal.
PlanTrial try_to_hold(const Model& model, const UncertaintyBox& box, const BoxPoint& at) {
  PlanTrial trial;
  const UncertainPush varied =
      vary(model.scene, model.scene.start, LinearPush{}, box, at);
  trial.is_scene = check(varied.scene).empty();
  if (!trial.is_scene) return trial;
  trial.end = varied.start;
  trial.sticks = fingers_hold_start(prepare(varied.scene, model.options));
  trial.reaches = trial.sticks && reaches(*model.scene.goal, trial.end);
  return trial;
}

}  // namespace

PlanTrial try_plan(const Model& model, const Plan& plan, const UncertaintyBox& box,
                   const BoxPoint& at, const TransitionOptions& options) {
  if (plan.pushes.empty()) return try_to_hold(model, box, at);
  PlanTrial trial;
  trial.end = model.scene.start;
  UncertaintyBox rest = box;  // the object is misplaced in the hand once only
  rest[Unknown::kGraspX] = rest[Unknown::kGraspY] = rest[Unknown::kGraspAngle] = 0.0;
  std::optional<Model> other;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    const Push& push = plan.pushes[i].push;
    const Grasp from{trial.end.X_HO};  // rolled it looks as it did at 0
    const bool rolls = std::holds_alternative<Roll>(push);
    const UncertaintyBox& here = i == 0 ? box : rest;
    // By which the object is off in the hand, before and by this place of the box: a roll
    // knows of neither.
    const double askew = from.X_HO.theta - plan.pushes[i].start.X_HO.theta;
    const double askew_here = here[Unknown::kGraspAngle] * at[kAngle];
    UncertainPush varied =
        rolls ? vary(model.scene, turned(from, -askew), push, box_of_rolls(here), at)
              : vary(model.scene, from, push, here, at);
    if (rolls) other.reset();
    if (!other) {
      trial.is_scene = check(varied.scene).empty();
      if (!trial.is_scene) return trial;
      other = prepare(varied.scene, model.options);
    }
    trial.failed_push = static_cast<int>(i);
    const int contact = counterpart(model, contact_of(varied.push), *other);
    if (contact < 0) {
      trial.is_scene = false;
      return trial;
    }
    set_contact(varied.push, contact);
    const Transition done = apply(*other, varied.start, varied.push, options);
    trial.status = done.status;
    const double psi = trial.end.psi + done.end.psi;
    trial.end = rolls ? turned(done.end, askew + askew_here) : done.end;
    trial.end.psi = psi;
    if (rolls) other.reset();
    trial.slipped = worse(trial.slipped, done.slipped);
    if (done.max_push_force > trial.push_force) trial.push_force = done.max_push_force;
    if (!done.completed() || (!rolls && !(done.slipped <= kTrialSlip))) return trial;
  }
  trial.failed_push = -1;
  trial.sticks = true;
  trial.reaches = model.scene.goal && reaches(*model.scene.goal, trial.end);
  return trial;
}

}  // namespace prehensile
