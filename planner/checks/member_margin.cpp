#include "planner/checks/member_margin.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "planner/checks/exact_check.h"
#include "planner/checks/meet_end.h"
#include "planner/checks/plan_trial.h"

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

/// Whether the face clips the pads at an end of a push, or between.
bool is_clipped(const Model& model, const PlannedPush& planned) {
  if (std::holds_alternative<Roll>(planned.push)) return false;
  const LinearPush push = as_linear(planned.push);
  const int places = places_along(push.travel, push.turn);
  for (int i = 0; i < places; ++i) {
    const double s = static_cast<double>(i) / (places - 1);
    if (!model.region.is_whole(pusher_pose(push, planned.start.X_HO, s))) return true;
  }
  return false;
}

}  // namespace

std::string member_margin_fault(const Model& model, const Plan& plan,
                                const TransitionOptions& options) {
  const bool by_points =
      std::any_of(plan.pushes.begin(), plan.pushes.end(),
                  [&](const PlannedPush& push) { return is_by_point(model, push.push); });
  const UncertaintyBox box = box_of(plan.margin);
  const auto clips = [&](const PlannedPush& push) { return is_clipped(model, push); };
  if (box.active().empty() ||
      (!by_points && !model.cross_section && std::ranges::none_of(plan.pushes, clips))) {
    return {};
  }
  for (std::uint64_t i = 0; i < kTrials; ++i) {
    BoxPoint at = corner(box, i * kStride);
    at[static_cast<std::size_t>(Unknown::kFriction)] = -1.0;
    const PlanTrial trial = try_plan(model, plan, box, at, options);
    if (trial.sticks) continue;
    // Without a first push the start is off the object, which is given.
    if (!trial.is_scene && trial.failed_push < 0) continue;
    // Where the fingers hold the object, and where the pads stay on it, is known without
    // members (holding_check.h, stays_on_object).
    const bool is_lost = trial.status == TransitionStatus::kFalls ||
                         trial.status == TransitionStatus::kPadLost;
    if (!by_points && is_lost) continue;
    const bool slips = trial.status == TransitionStatus::kCompleted;
    return "push " + std::to_string(trial.failed_push + 1) +
           ": a member of the box within the margin " +
           (!trial.is_scene ? "has no such contact"
            : slips         ? "slips"
                            : "ends: " + std::string(name(trial.status)));
  }
  return {};
}

}  // namespace prehensile
