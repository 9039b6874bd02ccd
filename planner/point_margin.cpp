#include "planner/point_margin.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "mechanics/pad_law.h"
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

bool turns_freely(const Model& model, const Plan& plan) {
  return std::ranges::any_of(plan.pushes, [&](const PlannedPush& push) {
    return is_by_point(model, push.push);
  });
}

constexpr auto kMass = static_cast<std::size_t>(Unknown::kMass);

/// The i-th of the corners that plans are tried at.
BoxPoint member(const UncertaintyBox& box, std::uint64_t i) {
  BoxPoint at = corner(box, i * kStride);
  at[static_cast<std::size_t>(Unknown::kFriction)] = -1.0;
  return at;
}

/// Whether the fingers alone hold the object at this grasp while the hand is as the push
/// has it.
bool is_held(const Model& model, const Grasp& grasp, const PlannedPush& planned,
             const UncertaintyBox& box, const BoxPoint& at) {
  const UncertainPush varied = vary(model.scene, grasp, planned.push, box, at);
  if (!check(varied.scene).empty()) return true;
  const Model other = prepare(varied.scene, model.options);
  const int contact = counterpart(model, contact_of(varied.push), other);
  if (contact < 0) return true;
  const PlanarPose& X_HO = varied.start.X_HO;
  const Vec2& g_O = other.contacts[static_cast<std::size_t>(contact)].g_O;
  const PlanarGrasp held = grasp_at(other, X_HO, rotated(X_HO.theta, g_O));
  return held.count > 0 && gravity_slack_by_pad_law(other, held) > 0.0;
}

bool is_held_where_given(const Model& model, const Plan& plan, const UncertaintyBox& box,
                         const BoxPoint& at) {
  const PlannedPush& last = plan.pushes.back();
  return is_held(model, plan.start, plan.pushes.front(), box, at) &&
         is_held(model, last.end, last, box, at);
}

}  // namespace

bool point_plan_may_fall(const Model& model, const Plan& plan) {
  const UncertaintyBox box = box_of(plan.margin);
  if (!turns_freely(model, plan) || box.active().empty()) return false;
  for (std::uint64_t i = 0; i < kTrials; ++i) {
    const BoxPoint at = member(box, i);
    if (at[kMass] > 0.0 && !is_held_where_given(model, plan, box, at)) return true;
  }
  return false;
}

std::string point_margin_fault(const Model& model, const Plan& plan,
                               const TransitionOptions& options) {
  const UncertaintyBox box = box_of(plan.margin);
  if (!turns_freely(model, plan) || box.active().empty()) return {};
  for (std::uint64_t i = 0; i < kTrials; ++i) {
    BoxPoint at = member(box, i);
    PlanTrial trial = try_plan(model, plan, box, at, options);
    const auto falls_where_given = [&] {
      return trial.status == TransitionStatus::kFalls &&
             (trial.falls_at_start() || !is_held_where_given(model, plan, box, at));
    };
    if (falls_where_given()) {
      at[kMass] = -1.0;
      trial = try_plan(model, plan, box, at, options);
      if (falls_where_given()) continue;
    }
    if (!trial.is_scene || trial.sticks) continue;
    return "push " + std::to_string(trial.failed_push + 1) +
           ": within the margin the object turns about the point otherwise, and " +
           (trial.status == TransitionStatus::kCompleted ? "slips"
                                                         : name(trial.status).data());
  }
  return {};
}

}  // namespace prehensile
