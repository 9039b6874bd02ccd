#include "planner/plan_trial.h"

#include <algorithm>

#include "planner/planner.h"

namespace prehensile {
namespace {

bool same_place(const PushContact& a, const PushContact& b) {
  return a.pusher == b.pusher && a.face == b.face;
}

/// The contact of the same pusher and face in a varied scene, or -1. Grip forces vary
/// with the scene, their order does not.
int same_contact(const Model& nominal, const Model& other, int contact) {
  const PushContact& wanted = nominal.contacts[static_cast<std::size_t>(contact)];
  int before = 0;
  for (int i = 0; i < contact; ++i) before += same_place(nominal.contacts[i], wanted);
  for (std::size_t i = 0; i < other.contacts.size(); ++i) {
    if (same_place(other.contacts[i], wanted) && before-- == 0) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void set_contact(Push& push, int contact) {
  std::visit([contact](auto& kind) { kind.contact = contact; }, push);
}

}  // namespace

PlanTrial try_plan(const Model& model, const Plan& plan, const UncertaintyBox& box,
                   const BoxPoint& at, const TransitionOptions& options) {
  PlanTrial trial;
  trial.end = model.scene.start;
  UncertaintyBox rest = box;  // the object is misplaced in the hand once only
  rest[Unknown::kGraspX] = rest[Unknown::kGraspY] = rest[Unknown::kGraspAngle] = 0.0;
  std::optional<Model> other;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    UncertainPush varied =
        vary(model.scene, trial.end, plan.pushes[i].push, i == 0 ? box : rest, at);
    if (!other) {
      trial.is_scene = check(varied.scene).empty();
      if (!trial.is_scene) return trial;
      other = prepare(varied.scene, model.options);
    }
    trial.failed_push = static_cast<int>(i);
    const int contact = same_contact(model, *other, contact_of(varied.push));
    if (contact < 0) {
      trial.is_scene = false;
      return trial;
    }
    set_contact(varied.push, contact);
    const Transition done = apply(*other, varied.start, varied.push, options);
    trial.status = done.status;
    trial.end = done.end;
    trial.slipped = std::max(trial.slipped, done.slipped);
    if (done.max_push_force > trial.push_force) trial.push_force = done.max_push_force;
    const bool rolls = std::holds_alternative<Roll>(varied.push);
    if (!done.completed() || (!rolls && done.slipped > kTrialSlip)) return trial;
  }
  trial.failed_push = -1;
  trial.sticks = true;
  trial.reaches = model.scene.goal && reaches(*model.scene.goal, trial.end);
  return trial;
}

}  // namespace prehensile
