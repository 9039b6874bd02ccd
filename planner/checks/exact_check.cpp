#include "planner/checks/exact_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mechanics/violation.h"
#include "planner/checks/holding_check.h"
#include "planner/checks/meet_end.h"
#include "planner/checks/member_margin.h"
#include "planner/checks/space_margin.h"
#include "planner/obstacles/confines_check.h"
#include "planner/pads/ring_pads.h"
#include "planner/pads/run_law.h"
#include "planner/pads/spread_pads.h"
#include "planner/planner.h"
#include "planner/steering/goal.h"
#include "planner/steering/roll_step.h"
#include "planner/steering/steering.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kPoseAgreement = 1e-6;  // [m] and [rad]

/// What sticks rides with its pusher exactly; an object that turns about a point is
/// followed as well as the transition function does that, which weighs angles with c.
double pose_error(const Model& model, const PlannedPush& push, const Grasp& end) {
  const Grasp& planned = push.end;
  const double angle = std::abs(end.X_HO.theta - planned.X_HO.theta);
  const double scale = is_by_point(model, push.push) ? model.c : 1.0;
  return worst_of({std::hypot(end.X_HO.x - planned.X_HO.x, end.X_HO.y - planned.X_HO.y),
                   scale * angle, std::abs(end.psi - planned.psi)});
}

/// What is wrong with a push, or an empty text.
std::string fault_of(const Model& model, const PlannedPush& push, const Transition& done,
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
  if (!rolls && !(done.slipped <= kPoseAgreement))
    return "the object slips on the pusher";
  if (!(pose_error(model, push, done.end) <= kPoseAgreement)) {
    return "the object ends elsewhere";
  }
  return {};
}

/// A place of a push where its slack is looked at: the pose, and how the object moves
/// there relative to the hand, in a common scale.
struct Instant {
  PlanarPose X_HO;
  Vec2 velocity = Vec2::Zero();  ///< [m] of the finger axis' place, in O
  double omega = 0.0;            ///< [rad]
  double travelled = 0.0;        ///< [m] by the finger axis in O since the push began
};

double slack_at(const Model& model, const PushContact& contact, double place,
                const Instant& at, const Margin& margin) {
  const double v = at.velocity.norm();
  const Vec2 e = v > 0.0 ? Vec2(at.velocity / v) : contact.n;
  return exact_stick_test(model, contact, place, at.X_HO, e, v, at.omega, margin,
                          at.travelled)
      .slack;
}

/// What the pads leave at an instant of a push by a point with gravity as while the face
/// lies flush, wherever on it the point may be, so that the laws of bounds.h, barrier.h
/// and turn_proof.h hold for the push. Round ones are spread over all angles: a disc
/// pulls nowhere aside as the points that stand for it do.
double slack_by_laws(const Model& model, const PushContact& contact, const Instant& at,
                     const Margin& margin) {
  constexpr double kInstant = 1e-9;  // share of the motion
  const Vec2 p_OF = finger_in_object(at.X_HO);
  if (has_ring_pads(model)) {
    const double v = at.velocity.norm();
    const Vec2 e = v > 0.0 ? Vec2(at.velocity / v) : contact.n;
    return ring_slack(model, contact, p_OF, e, kInstant * v, kInstant * at.omega,
                      margin_of_laws(model, contact, margin));
  }
  if (has_clipped_discs(model)) {
    return spread_slack(model, contact, p_OF, at.velocity, at.omega);
  }
  PushContact anywhere = contact;
  anywhere.is_point = false;
  anywhere.half_length = std::numeric_limits<double>::infinity();
  return slack_at(model, anywhere, 0.0, at, Margin::none());
}

/// The object turns about a point as the pads let it: looked at along the way that it
/// takes, moving as it does there, with gravity as it is where the object has turned away
/// from its pusher.
double slack_by_point(const Model& model, const Grasp& start, const LinearPush& push,
                      int parts, const Margin& margin) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  std::vector<Sample> trace;
  if (!apply(model, start, push, {.max_step = 1.0 / parts}, &trace).completed()) {
    return -kInfinity;
  }
  double slack = kInfinity;
  Instant at;
  Vec2 last = finger_in_object(start.X_HO);
  for (const Sample& sample : trace) {
    at.X_HO = sample.grasp.X_HO;
    const Vec2 p_OF = finger_in_object(at.X_HO);
    at.travelled += (p_OF - last).norm();
    last = p_OF;
    const double turned = at.X_HO.theta - pusher_pose(push, start.X_HO, sample.s).theta;
    PushContact here = contact;
    here.g_O = rotated(-turned, contact.g_O);
    const PlanarInstant instant = solve_planar(
        grasp_at(model, at.X_HO, here.g_O),
        drive_at(contact, push.place, at.X_HO, pusher_twist(push, start.X_HO, sample.s)));
    if (instant.status != InstantStatus::kMoves) return -kInfinity;
    at.velocity = rotated(-at.X_HO.theta, instant.V_HO.head<2>());
    at.omega = instant.V_HO[2];
    slack = tighter(slack, slack_at(model, here, push.place, at, margin));
    slack = tighter(slack, slack_by_laws(model, contact, at, margin));
  }
  return slack;
}

/// A push of so many turns adds up small errors of its steps: its exact check may pass
/// and one with half the step fail.
constexpr double kManyTurns = 20.0 * 2.0 * std::numbers::pi;

/// Points of pushers with less to spare may stick and slip by turns.
constexpr double kLeastSlackOfPoints = 1e-6;

/// [m] Over smaller torque radii what a push may miss its end by, 1e-6 m, is much of an
/// angle.
constexpr double kLeastRadius = 1e-4;

}  // namespace

int places_along(double travel, double turn) noexcept {
  constexpr double kTravel = 2e-3;  // [m]
  constexpr double kTurn = 0.1;     // [rad]
  const double parts = std::max(travel / kTravel, std::abs(turn) / kTurn);
  return static_cast<int>(std::clamp(std::ceil(parts) + 1.0, 3.0, 50.0));
}

double push_slack(const Model& model, const Grasp& start, const Push& push,
                  const Margin& margin, int most_spread_parts) {
  if (const auto* roll = std::get_if<Roll>(&push))
    return roll_slack(model, start, *roll, margin);
  const LinearPush linear = as_linear(push);
  const PushContact& contact = model.contacts[linear.contact];
  const Vec2 p_OF = finger_in_object(start.X_HO);
  const int points = places_along(linear.travel, linear.turn);
  if (contact.is_point) return slack_by_point(model, start, linear, points - 1, margin);
  double slack = std::numeric_limits<double>::infinity();
  if (has_ring_pads(model)) {
    slack = ring_slack(model, contact, p_OF, linear.e, linear.travel, linear.turn,
                       margin_of_laws(model, contact, margin));
  } else if (has_clipped_discs(model)) {
    slack = spread_slack_along(model, contact, p_OF, linear.e, linear.travel, linear.turn,
                               most_spread_parts);
  }
  for (int i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / (points - 1);
    const PlanarPose X_HO = pose_from_finger(p_OF - s * linear.travel * linear.e,
                                             start.X_HO.theta + s * linear.turn);
    const Instant at{X_HO, linear.travel * linear.e, linear.turn, s * linear.travel};
    slack = tighter(slack, slack_at(model, contact, linear.place, at, margin));
  }
  return slack;
}

double travel_in_pad_plane(const Push& push) {
  return std::holds_alternative<Roll>(push) ? 0.0 : as_linear(push).travel;
}

bool stays_on_object(const Model& model, const Plan& plan, std::string* why) {
  if (plan.pushes.empty()) return true;
  double travelled = 0.0;
  const Vec2 first = finger_in_object(plan.start.X_HO);
  const Vec2 last = finger_in_object(plan.pushes.back().end.X_HO);
  const bool ends_as_given =
      !model.scene.goal || is_place_given(*model.scene.goal, first, last);
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    const PlannedPush& push = plan.pushes[i];
    const Vec2 from = finger_in_object(push.start.X_HO);
    const Vec2 to = finger_in_object(push.end.X_HO);
    const bool stays =
        path_on_object(model, {from, travelled == 0.0}, {to, to == last && ends_as_given},
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

/// As a replay looks at a plan.
TransitionOptions at_half_step(TransitionOptions options) {
  options.max_step *= 0.5;
  return options;
}

/// A push looked at twice as closely, as a replay does, from where the one before so
/// ended: a second motion may be possible at a few places only, and of pushes by points
/// what an end misses may grow in the next.
std::string fault_at_half_step(const Model& model, const PlannedPush& push,
                               const TransitionOptions& options, Grasp& at, Plan& plan) {
  const TransitionOptions half = at_half_step(options);
  const Transition done = apply(model, at, push.push, half);
  plan.instants += done.instants;
  at = done.end;
  return fault_of(model, push, done, half);
}

}  // namespace

bool check_exactly(const Model& model, const TransitionOptions& options, Plan& plan,
                   std::string* why) {
  double travelled = 0.0;
  Grasp at = plan.start;  // as a replay begins
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    PlannedPush& push = plan.pushes[i];
    const Transition done = apply(model, push.start, push.push, options);
    plan.instants += done.instants;
    push.push_force = done.max_push_force;
    push.certificate = done.worst_certificate;
    push.error_estimate = done.error_estimate;
    // From where a replay begins it: points of clipped pads come and go one by one, so of
    // a push by a point that turns the object many times next to nothing beside may
    // matter.
    push.slack = push_slack(model, at, push.push, carried(plan.margin, travelled));
    travelled += travel_in_pad_plane(push.push);
    std::string fault = fault_of(model, push, done, options);
    if (fault.empty()) fault = fault_at_half_step(model, push, options, at, plan);
    if (fault.empty()) fault = space_margin_fault(model, push, plan.margin, options);
    if (fault.empty()) continue;
    if (why) *why = "push " + std::to_string(i + 1) + ": " + fault;
    return false;
  }
  std::string fault = confinement_fault(model, plan.pushes);
  if (fault.empty()) fault = start_holding_fault(model, plan);
  if (fault.empty()) fault = margin_holding_fault(model, plan);
  if (fault.empty()) fault = member_margin_fault(model, plan, at_half_step(options));
  if (fault.empty() && model.scene.goal && !reaches(*model.scene.goal, at)) {
    fault = "the object ends beside the goal at half the step";
  }
  if (!fault.empty()) {
    if (why) *why = fault;
    return false;
  }
  return plan.margin.grasp + plan.margin.tilt == 0.0 || stays_on_object(model, plan, why);
}

bool is_delicate(const Model& model, const Plan& plan) {
  return std::ranges::any_of(plan.pushes, [&](const PlannedPush& push) {
    const double turn = push.end.X_HO.theta - push.start.X_HO.theta;
    if (std::abs(turn) > kManyTurns) return true;
    const auto* linear = std::get_if<LinearPush>(&push.push);
    return linear && model.contacts[linear->contact].is_point &&
           (!(push.slack >= kLeastSlackOfPoints) || model.c < kLeastRadius);
  });
}

}  // namespace prehensile
