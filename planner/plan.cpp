#include "planner/plan.h"

#include <algorithm>

namespace prehensile {
bool Plan::rolls() const {
  return std::any_of(pushes.begin(), pushes.end(), [](const PlannedPush& push) {
    return std::holds_alternative<Roll>(push.push);
  });
}

std::string_view name(PlanStatus status) {
  switch (status) {
    case PlanStatus::kNotRun:
      return "not run";
    case PlanStatus::kReachedGoal:
      return "reached goal";
    case PlanStatus::kNothingToDo:
      return "nothing to do";
    case PlanStatus::kInfeasible:
      return "infeasible";
    case PlanStatus::kBudgetSpent:
      return "budget spent";
    case PlanStatus::kStopped:
      return "stopped";
    case PlanStatus::kUnsupported:
      return "unsupported";
  }
  return "unknown";
}

std::string_view name(Proof::Kind kind) {
  switch (kind) {
    case Proof::Kind::kNone:
      return "none";
    case Proof::Kind::kGoalOffObject:
      return "goal off object";
    case Proof::Kind::kStartFalls:
      return "start falls";
    case Proof::Kind::kGoalFalls:
      return "goal falls";
    case Proof::Kind::kNoPusher:
      return "no pusher";
    case Proof::Kind::kNoRoll:
      return "no roll";
    case Proof::Kind::kHalfSpace:
      return "half space";
    case Proof::Kind::kGoalBeyondLimits:
      return "goal beyond limits";
    case Proof::Kind::kBarrier:
      return "barrier";
    case Proof::Kind::kStartBlocked:
      return "start blocked";
    case Proof::Kind::kGoalBlocked:
      return "goal blocked";
    case Proof::Kind::kTurn:
      return "turn";
  }
  return "unknown";
}

std::string_view name(Promise promise) {
  switch (promise) {
    case Promise::kNominal:
      return "nominal";
    case Promise::kNominalOnly:
      return "nominal only";
    case Promise::kPartOfMargin:
      return "part of the margin";
    case Promise::kMargin:
      return "margin";
    case Promise::kScene:
      return "scene uncertainty";
  }
  return "unknown";
}

std::string_view name(PushConstraint constraint) {
  switch (constraint) {
    case PushConstraint::kOffObject:
      return "the pads would leave the object";
    case PushConstraint::kGravity:
      return "the grasp alone would not hold the object";
    case PushConstraint::kBackwards:
      return "the motion leads away from the pusher";
    case PushConstraint::kFrictionCone:
      return "the motion lies outside the friction cone of the pusher";
    case PushConstraint::kFaceEnds:
      return "the push would have to act beyond the ends of the face";
    case PushConstraint::kRotation:
      return "the pushes cannot turn the object as far as needed";
    case PushConstraint::kRealPads:
      return "the push slips with the real pads";
    case PushConstraint::kThetaLimit:
      return "the angle of the object would leave its limits";
    case PushConstraint::kReach:
      return "the grasp or the hand would leave its reach";
    case PushConstraint::kCollision:
      return "the hand or the object would hit an obstacle";
    case PushConstraint::kCount:
      break;
  }
  return "unknown";
}

double grip_force_of(const Model& model, const Push& push) {
  const double own = model.scene.gripper.grip_force;
  if (const auto* roll = std::get_if<Roll>(&push)) {
    return roll->grip_force > 0.0 ? roll->grip_force : own;
  }
  const auto contact = static_cast<std::size_t>(contact_of(push));
  return own * model.contacts[contact].grip_share;
}

}  // namespace prehensile
