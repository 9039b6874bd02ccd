#include "planner/point_margin.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "planner/meet_end.h"
#include "planner/plan_trial.h"

namespace prehensile {
namespace {

constexpr std::uint64_t kTrials = 32;
constexpr std::uint64_t kStride = 211;  // through the corners: prime to their number

UncertaintyBox box_of(const Margin& margin) {
  UncertaintyBox box;
  box[Unknown::kFriction] = margin.friction;
  box[Unknown::kMass] = margin.force;
  box[Unknown::kTorqueRadius] = margin.torque_radius;
  box[Unknown::kPlace] = margin.place;
  box[Unknown::kTilt] = margin.tilt;
  constexpr double kOfEach = 0.5 * std::numbers::sqrt2;
  box[Unknown::kCentreOfMassX] = kOfEach * margin.centre_of_mass;
  box[Unknown::kCentreOfMassY] = kOfEach * margin.centre_of_mass;
  box[Unknown::kGraspX] = kOfEach * margin.grasp;
  box[Unknown::kGraspY] = kOfEach * margin.grasp;
  return box;
}

}  // namespace

std::string point_margin_fault(const Model& model, const Plan& plan,
                               const TransitionOptions& options) {
  const bool turns_freely =
      std::any_of(plan.pushes.begin(), plan.pushes.end(),
                  [&](const PlannedPush& push) { return is_by_point(model, push.push); });
  const UncertaintyBox box = box_of(plan.margin);
  if (!turns_freely || box.active().empty()) return {};
  for (std::uint64_t i = 0; i < kTrials; ++i) {
    BoxPoint at = corner(box, i * kStride);
    at[static_cast<std::size_t>(Unknown::kFriction)] = -1.0;
    const PlanTrial trial = try_plan(model, plan, box, at, options);
    if (!trial.is_scene || trial.sticks) continue;
    return "push " + std::to_string(trial.failed_push + 1) +
           ": within the margin the object turns about the point otherwise, and " +
           (trial.status == TransitionStatus::kCompleted ? "slips"
                                                         : name(trial.status).data());
  }
  return {};
}

}  // namespace prehensile
