#include "planner/exact_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/confines_check.h"
#include "planner/ring_pads.h"
#include "planner/roll_step.h"
#include "planner/space_margin.h"
#include "planner/steering.h"

namespace prehensile {
namespace {

constexpr double kPoseAgreement = 1e-6;  // [m] and [rad]

double pose_error(const Grasp& a, const Grasp& b) {
  return std::max({std::hypot(a.X_HO.x - b.X_HO.x, a.X_HO.y - b.X_HO.y),
                   std::abs(a.X_HO.theta - b.X_HO.theta), std::abs(a.psi - b.psi)});
}

/// What is wrong with a push, or an empty text.
std::string fault_of(const PlannedPush& push, const Transition& done,
                     const TransitionOptions& options) {
  if (!done.completed()) {
    return std::string(name(done.status)) +
           (done.reason.empty() ? "" : ": " + std::string(done.reason));
  }
  if (!(done.worst_certificate <= options.certificate_tolerance)) {
    return "an instant fails its certificate";
  }
  if (!(push.slack >= -kStickTolerance)) return "it slips within the margin";
  const bool rolls = std::holds_alternative<Roll>(push.push);
  if (!rolls && done.slipped > kPoseAgreement) return "the object slips on the pusher";
  if (!(pose_error(done.end, push.end) <= kPoseAgreement)) {
    return "the object ends elsewhere";
  }
  return {};
}

}  // namespace

double push_slack(const Model& model, const Grasp& start, const Push& push,
                  const Margin& margin) {
  if (const auto* roll = std::get_if<Roll>(&push))
    return roll_slack(model, *roll, margin);
  constexpr double kPointTravel = 2e-3;  // [m]
  constexpr double kPointTurn = 0.1;     // [rad]
  const LinearPush linear = as_linear(push);
  const PushContact& contact = model.contacts[linear.contact];
  const Vec2 p_OF = finger_in_object(start.X_HO);
  const double parts =
      std::max(linear.travel / kPointTravel, std::abs(linear.turn) / kPointTurn);
  const int points = static_cast<int>(std::clamp(std::ceil(parts) + 1.0, 3.0, 50.0));
  double slack = has_ring_pads(model) ? ring_slack(model, contact, p_OF, linear.e,
                                                   linear.travel, linear.turn)
                                      : std::numeric_limits<double>::infinity();
  for (int i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / (points - 1);
    const PlanarPose X_HO = pose_from_finger(p_OF - s * linear.travel * linear.e,
                                             start.X_HO.theta + s * linear.turn);
    const StickTest test =
        exact_stick_test(model, contact, linear.place, X_HO, linear.e, linear.travel,
                         linear.turn, margin, s * linear.travel);
    slack = std::min(slack, test.slack);
  }
  return slack;
}

double travel_in_pad_plane(const Push& push) {
  return std::holds_alternative<Roll>(push) ? 0.0 : as_linear(push).travel;
}

bool stays_on_object(const Model& model, const Plan& plan, std::string* why) {
  double travelled = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    const PlannedPush& push = plan.pushes[i];
    const Vec2 from = finger_in_object(push.start.X_HO);
    const Vec2 to = finger_in_object(push.end.X_HO);
    const bool stays =
        path_on_object(model, {from, travelled == 0.0},
                       {to, to == finger_in_object(plan.pushes.back().end.X_HO)},
                       carried(plan.margin, travelled));
    travelled += travel_in_pad_plane(push.push);
    if (stays) continue;
    if (why) {
      *why = "push " + std::to_string(i + 1) +
             ": the pads may leave the object within the margin";
    }
    return false;
  }
  return true;
}

namespace {

/// The same push looked at twice as closely, as a replay does: a second motion may be
/// possible at a few places only.
std::string fault_at_half_step(const Model& model, const PlannedPush& push,
                               const TransitionOptions& options, Plan& plan) {
  TransitionOptions half = options;
  half.max_step = 0.5 * options.max_step;
  const Transition done = apply(model, push.start, push.push, half);
  plan.instants += done.instants;
  return fault_of(push, done, half);
}

}  // namespace

bool check_exactly(const Model& model, const TransitionOptions& options, Plan& plan,
                   std::string* why) {
  double travelled = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    PlannedPush& push = plan.pushes[i];
    const Transition done = apply(model, push.start, push.push, options);
    plan.instants += done.instants;
    push.push_force = done.max_push_force;
    push.certificate = done.worst_certificate;
    push.error_estimate = done.error_estimate;
    push.slack =
        push_slack(model, push.start, push.push, carried(plan.margin, travelled));
    travelled += travel_in_pad_plane(push.push);
    std::string fault = fault_of(push, done, options);
    if (fault.empty()) fault = fault_at_half_step(model, push, options, plan);
    if (fault.empty()) fault = space_margin_fault(model, push, plan.margin, options);
    if (fault.empty()) continue;
    if (why) *why = "push " + std::to_string(i + 1) + ": " + fault;
    return false;
  }
  const std::string fault = confinement_fault(model, plan.pushes);
  if (!fault.empty()) {
    if (why) *why = fault;
    return false;
  }
  return plan.margin.grasp + plan.margin.tilt == 0.0 || stays_on_object(model, plan, why);
}

}  // namespace prehensile
