#include "planner/checks/member_margin.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>

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

/// Longest step at a first glance, of a push.
constexpr double kGlance = 0.25;

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

/// The box of a plan's margin, and its members one by one.
class Members {
 public:
  Members(const Model& model, const Plan& plan)
      : model_(model),
        plan_(plan),
        by_points_(has_pushes_by_points(model, plan)),
        box_(box_of(plan.margin)) {}

  /// Whether members may do what the slack of the pushes does not tell.
  bool matter() const {
    const auto clips = [&](const PlannedPush& push) { return is_clipped(model_, push); };
    return !box_.active().empty() && (by_points_ || model_.cross_section ||
                                      std::ranges::any_of(plan_.pushes, clips));
  }

  /// What becomes of the plan in a member that does not survive it, or nothing.
  std::optional<PlanTrial> failed(std::uint64_t member,
                                  const TransitionOptions& options) const {
    BoxPoint at = corner(box_, member * kStride);
    at[static_cast<std::size_t>(Unknown::kFriction)] = -1.0;
    const PlanTrial trial = try_plan(model_, plan_, box_, at, options);
    if (trial.sticks) return std::nullopt;
    // Without a first push the start is off the object, which is given.
    if (!trial.is_scene && trial.failed_push < 0) return std::nullopt;
    // Where the fingers hold the object, and where the pads stay on it, is known without
    // members (holding_check.h, stays_on_object).
    const bool is_lost = trial.status == TransitionStatus::kFalls ||
                         trial.status == TransitionStatus::kPadLost;
    if (!by_points_ && is_lost) return std::nullopt;
    return trial;
  }

 private:
  const Model& model_;
  const Plan& plan_;
  bool by_points_;
  UncertaintyBox box_;
};

std::string fault_of(const PlanTrial& trial) {
  const bool slips = trial.status == TransitionStatus::kCompleted;
  return "push " + std::to_string(trial.failed_push + 1) +
         ": a member of the box within the margin " +
         (!trial.is_scene ? "has no such contact"
          : slips         ? "slips"
                          : "ends: " + std::string(name(trial.status)));
}

}  // namespace

std::string member_margin_fault(const Model& model, const Plan& plan,
                                const TransitionOptions& options) {
  const Members members(model, plan);
  if (!members.matter()) return {};
  // Most members that fail do so at a first glance, which costs little; closely looked at
  // is what that suspects, and then everything.
  TransitionOptions glance = options;
  glance.max_step = std::max(options.max_step, kGlance);
  for (const bool is_glance : {true, false}) {
    for (std::uint64_t i = 0; i < kTrials; ++i) {
      if (is_glance && !members.failed(i, glance)) continue;
      if (const auto trial = members.failed(i, options)) return fault_of(*trial);
    }
  }
  return {};
}

}  // namespace prehensile
