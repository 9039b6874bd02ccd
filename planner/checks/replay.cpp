#include "planner/checks/replay.h"

#include <algorithm>
#include <cmath>

#include "mechanics/certificate_evidence.h"
#include "mechanics/violation.h"
#include "planner/bounds/bounds.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/holding_check.h"
#include "planner/checks/member_margin.h"
#include "planner/checks/space_margin.h"
#include "planner/costs.h"
#include "planner/obstacles/confines_check.h"
#include "planner/planner.h"
#include "planner/steering/confines.h"
#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

// Relative. The force of a pad of a few points varies as it turns, and so does the
// extremum of its samples.
constexpr double kForceTolerance = 0.1;
constexpr double kCostTolerance = 1e-6;   // relative; the plan file rounds nothing
constexpr double kSlackTolerance = 1e-4;  // of the friction force; where points push

double position_error(const Grasp& a, const Grasp& b) {
  return std::hypot(a.X_HO.x - b.X_HO.x, a.X_HO.y - b.X_HO.y);
}

double angle_error(const Grasp& a, const Grasp& b) {
  return worse(std::abs(a.X_HO.theta - b.X_HO.theta), std::abs(a.psi - b.psi));
}

bool same_grasp(const Grasp& a, const Grasp& b, const ReplayOptions& options) {
  return position_error(a, b) <= options.position_tolerance &&
         angle_error(a, b) <= options.angle_tolerance;
}

bool is_finite(const Grasp& grasp) {
  return std::isfinite(grasp.X_HO.x) && std::isfinite(grasp.X_HO.y) &&
         std::isfinite(grasp.X_HO.theta) && std::isfinite(grasp.psi);
}

bool is_finite(const Push& push) {
  if (const auto* roll = std::get_if<Roll>(&push)) return std::isfinite(roll->travel);
  const LinearPush linear = as_linear(push);
  const bool finite = std::isfinite(linear.place) && linear.e.allFinite() &&
                      std::isfinite(linear.travel) && std::isfinite(linear.turn);
  return finite && std::abs(linear.e.norm() - 1.0) <= 1e-6 && linear.travel >= 0.0;
}

/// What keeps a push from being replayed at all, or an empty text.
std::string unusable(const Model& model, const PlannedPush& planned) {
  const int contact = contact_of(planned.push);
  if (contact < 0 || contact >= static_cast<int>(model.contacts.size())) {
    return "names a contact that the scene does not have";
  }
  if (!is_finite(planned.push)) return "is not a finite push along a unit direction";
  if (!is_finite(planned.start) || !is_finite(planned.end)) {
    return "has a pose that is not finite";
  }
  return {};
}

std::string disagreement(const ReplayedPush& replayed, const ReplayOptions& options) {
  const Transition& done = replayed.transition;
  if (!done.completed()) {
    return std::string(name(done.status)) +
           (done.reason.empty() ? "" : ": " + std::string(done.reason));
  }
  if (!(done.worst_certificate <= options.transition.certificate_tolerance)) {
    return "an instant fails its certificate";
  }
  if (!(replayed.position_error <= options.position_tolerance &&
        replayed.angle_error <= options.angle_tolerance)) {
    return "the object ends elsewhere";
  }
  if (!(replayed.force_error <= kForceTolerance)) return "the push force differs";
  if (!(replayed.slack >= -kStickTolerance)) {
    return "it slips within the margin of the plan";
  }
  return {};
}

/// What a push claims about itself and what its replay says, or an empty text.
std::string false_claim(const PlannedPush& planned, const ReplayedPush& replayed,
                        const ReplayOptions& options) {
  if (std::isfinite(replayed.slack) &&
      !(planned.slack <= replayed.slack + kSlackTolerance)) {
    return "it states more margin than it has";
  }
  if (!(planned.certificate <= options.transition.certificate_tolerance)) {
    return "it states a certificate that does not pass";
  }
  if (!(planned.error_estimate >= 0.0 && std::isfinite(planned.error_estimate))) {
    return "it states an error that is no length";
  }
  return {};
}

ReplayedPush replay_push(const Model& model, const Margin& margin, const Grasp& start,
                         const PlannedPush& planned, const ReplayOptions& options) {
  ReplayedPush replayed;
  replayed.why = unusable(model, planned);
  if (!replayed.why.empty()) return replayed;
  replayed.transition = apply(model, start, planned.push, options.transition);
  const Transition& done = replayed.transition;
  replayed.position_error = position_error(done.end, planned.end);
  replayed.angle_error = angle_error(done.end, planned.end);
  replayed.force_error =
      std::abs(done.max_push_force - planned.push_force) / done.max_push_force;
  replayed.slack = push_slack(model, start, planned.push, margin);
  replayed.why = disagreement(replayed, options);
  if (replayed.why.empty()) replayed.why = false_claim(planned, replayed, options);
  if (replayed.why.empty()) {
    const PlannedPush here{.push = planned.push, .start = start};
    replayed.why = space_margin_fault(model, here, margin, options.transition);
  }
  replayed.agrees = replayed.why.empty();
  return replayed;
}

bool margin_is_sound(const Margin& margin) {
  return margin.friction >= 0.0 && margin.force >= 0.0 && std::isfinite(margin.force) &&
         margin.torque_radius >= 0.0 && margin.place >= 0.0 &&
         margin.centre_of_mass >= 0.0 && margin.grasp >= 0.0 && margin.tilt >= 0.0;
}

/// Whether one box lies within another.
bool is_within(const Margin& part, const Margin& whole) {
  const auto most = [](double width) { return width * (1.0 + 1e-9) + 1e-12; };
  return part.friction <= most(whole.friction) && part.force <= most(whole.force) &&
         part.torque_radius <= most(whole.torque_radius) &&
         part.place <= most(whole.place) &&
         part.centre_of_mass <= most(whole.centre_of_mass) &&
         part.grasp <= most(whole.grasp) && part.tilt <= most(whole.tilt);
}

bool promise_is_right(const Model& model, const Plan& plan) {
  const bool is_nominal =
      plan.promise == Promise::kNominal || plan.promise == Promise::kNominalOnly;
  if (is_nominal != plan.margin.is_none()) return false;
  if (plan.promise != Promise::kScene) return true;
  return model.scene.uncertainty &&
         is_within(margin_of(model, box_of(model.scene)), plan.margin);
}

bool agrees(double stated, double computed) {
  return std::abs(stated - computed) <= kCostTolerance * std::max(1.0, computed);
}

/// What the pads take along a push, otherwise than friction_work: point by point in many
/// short steps, or over soft points as force times travel.
double work_along(const Model& model, const PlannedPush& push) {
  constexpr int kSteps = 64;
  const auto contact = static_cast<std::size_t>(contact_of(push.push));
  const double share = model.contacts[contact].grip_share;
  const PlanarPose& from = push.start.X_HO;
  const PlanarPose& to = push.end.X_HO;
  const Vec2 d = finger_in_object(to) - finger_in_object(from);
  const double turn = to.theta - from.theta;
  if (model.has_soft_points())
    return share * model.F * std::hypot(d.norm(), model.c * turn);
  double work = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double done = (i + 0.5) / kSteps;
    const double theta = from.theta + done * turn;
    const PlanarPose X_HO = pose_from_finger(finger_in_object(from) + done * d, theta);
    const Vec2 v = -rotated(theta, d);
    const PlanarTwist V(v.x(), v.y(), turn);
    work += friction_power(grasp_at(model, X_HO, Vec2::Zero()), V);
  }
  return share * work / kSteps;
}

/// The work that a plan states, less that of its rolls, for which one instant is enough.
bool work_is_right(const Model& model, const Plan& plan) {
  constexpr double kTolerance = 0.02;  // where clipping takes points away one by one
  if (!model.scene.cost) return plan.work == 0.0 && plan.grip_changes == 0.0;
  double stated = plan.work;
  double work = 0.0;
  for (const PlannedPush& push : plan.pushes) {
    if (std::holds_alternative<Roll>(push.push)) {
      stated -= friction_work(model, push);
    } else {
      work += work_along(model, push);
    }
  }
  return std::abs(work - stated) <= kTolerance * std::max(work, plan.work);
}

/// S, T, J and the bound counted again, T from the poses instead of the pushes. Costs of
/// pushes that cannot be replayed at all are not counted: they are wrong.
bool costs_are_right(const Model& model, const Plan& plan) {
  for (const PlannedPush& push : plan.pushes) {
    if (!unusable(model, push).empty()) return false;
  }
  Plan counted;
  counted.pushes = plan.pushes;
  account(model, counted);
  double travel = 0.0;
  for (const PlannedPush& push : plan.pushes) {
    const Vec2 d = finger_in_object(push.end.X_HO) - finger_in_object(push.start.X_HO);
    const double turn = model.c * (push.end.X_HO.theta - push.start.X_HO.theta);
    const double roll = model.roll_radius * (push.end.psi - push.start.psi);
    travel += std::hypot(d.norm(), turn, roll);
  }
  const CostWeights price = prices(model);
  const double cost = plan.placements + price.travel * travel / model.L +
                      price.work * counted.work + price.grip_change * plan.grip_changes;
  return agrees(plan.placements, counted.placements) && agrees(plan.travel, travel) &&
         agrees(plan.work, counted.work) && plan.grip_changes == counted.grip_changes &&
         work_is_right(model, plan) && agrees(plan.cost, cost) &&
         agrees(plan.published_cost, counted.published_cost);
}

/// A bound that the plan claims is proved again: as a question of its own, or where the
/// work for that ends too early, as the planner came to it. A weaker claim than what
/// could be proved is right, too.
bool is_proved(const Model& model, const Plan& plan, const Goal& goal, double claimed) {
  if (!(claimed >= 0.0) || claimed > plan.cost * (1.0 + kCostTolerance)) return false;
  const Grasp& start = model.scene.start;
  return bound_holds(model, start, goal, claimed,
                     {.nodes = 4 * kBoundNodes, .margin = plan.margin}) ||
         lower_bound(model, start, goal, plan.cost, {.margin = plan.margin}).value >=
             claimed;
}

bool bounds_are_right(const Model& model, const Plan& plan) {
  const Goal goal = goal_within_limits(model.scene);
  if (!is_proved(model, plan, goal, plan.lower_bound)) return false;
  if (!plan.bound_at_goal) return true;
  const Goal itself = goal_itself(goal);
  return reaches(itself, plan.goal) &&
         is_proved(model, plan, itself, *plan.bound_at_goal);
}

bool poses_connect(const Plan& plan, const ReplayOptions& options) {
  for (std::size_t i = 1; i < plan.pushes.size(); ++i) {
    if (!same_grasp(plan.pushes[i].start, plan.pushes[i - 1].end, options)) return false;
  }
  return true;
}

std::string first_disagreement(const Model& model, const Plan& plan,
                               const ReplayOptions& options, const Replay& replay) {
  if (!plan.usable()) return "the plan does not claim to reach its goal";
  if (!margin_is_sound(plan.margin)) return "the margin is not a box of uncertainty";
  if (!promise_is_right(model, plan))
    return "the plan does not have the margin that it promises";
  if (!replay.starts_right) return "the plan does not start at the start of the scene";
  if (!replay.connected) return "a push does not start where the one before ended";
  for (std::size_t i = 0; i < replay.pushes.size(); ++i) {
    if (!replay.pushes[i].agrees) {
      return "push " + std::to_string(i + 1) + ": " + replay.pushes[i].why;
    }
  }
  if (replay.pushes.size() < plan.pushes.size()) return "a push cannot be replayed";
  std::string why;
  const bool shifts = plan.margin.grasp + plan.margin.tilt > 0.0;
  if (shifts && !stays_on_object(model, plan, &why)) return why;
  if (!replay.confinement.empty()) return replay.confinement;
  why = start_holding_fault(model, plan);
  if (why.empty()) why = margin_holding_fault(model, plan);
  if (!why.empty()) return why;
  why = member_margin_fault(model, plan, options.transition);
  if (!why.empty()) return why;
  if (!replay.reaches_goal) return "the object does not end at the goal";
  if (!same_grasp(plan.goal, replay.end, options)) {
    return "the plan states another end than it has";
  }
  if (!replay.costs_right) return "the costs are not those of the pushes";
  if (!replay.bound_right) return "the lower bound of the cost cannot be proved";
  return {};
}

}  // namespace

Replay replay(const Model& model, const Plan& plan, const ReplayOptions& options) {
  Replay result;
  const Grasp& start = model.scene.start;
  const Grasp& first = plan.pushes.empty() ? plan.start : plan.pushes.front().start;
  result.starts_right =
      same_grasp(plan.start, start, options) && same_grasp(first, start, options);
  result.connected = poses_connect(plan, options);
  result.end = start;
  double travelled = 0.0;
  std::vector<PlannedPush> replayed_pushes;
  for (const PlannedPush& planned : plan.pushes) {
    result.pushes.push_back(replay_push(model, carried(plan.margin, travelled),
                                        result.end, planned, options));
    travelled += travel_in_pad_plane(planned.push);
    const ReplayedPush& replayed = result.pushes.back();
    result.instants += replayed.transition.instants;
    if (!replayed.transition.completed()) break;
    replayed_pushes.push_back({planned.push, result.end, replayed.transition.end});
    result.end = replayed.transition.end;
  }
  result.confinement = confinement_fault(model, replayed_pushes);
  if (model.scene.goal) {
    result.reaches_goal = reaches(*model.scene.goal, result.end);
    result.costs_right = costs_are_right(model, plan);
    result.bound_right = bounds_are_right(model, plan);
  }
  result.why = first_disagreement(model, plan, options, result);
  result.agrees = result.why.empty();
  return result;
}

}  // namespace prehensile
