#include "planner/plan_trial.h"

#include <algorithm>

#include "planner/planner.h"

namespace prehensile {
namespace {

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
    const int contact = counterpart(model, contact_of(varied.push), *other);
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
