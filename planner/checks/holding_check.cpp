#include "planner/checks/holding_check.h"

#include <algorithm>

#include "mechanics/pad_law.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/meet_end.h"
#include "planner/costs.h"
#include "planner/geometry/segment.h"
#include "planner/pads/ring_pads.h"
#include "planner/steering/goal.h"
#include "planner/steering/holding.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// An end of a push: where the finger axis is, and how far off it may be.
struct PushEnd {
  PlanarPose X_HO;
  Vec2 g_O;
  Margin margin;
  bool given = false;
};

struct PushEnds {
  std::size_t index = 0;  ///< in the plan
  PushEnd from, to;
  LinearPush push;
  bool by_point = false;
};

/// Of the pushes that are no rolls.
std::vector<PushEnds> ends_of_pushes(const Model& model, const Plan& plan) {
  std::vector<PushEnds> all;
  if (plan.pushes.empty()) return all;
  const Vec2 first = finger_in_object(plan.start.X_HO);
  const Vec2 last = finger_in_object(plan.pushes.back().end.X_HO);
  const bool ends_as_given =
      !model.scene.goal || is_place_given(*model.scene.goal, first, last);
  double travelled = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    const PlannedPush& planned = plan.pushes[i];
    const bool begins = travelled == 0.0;
    const double before = travelled;
    travelled += travel_in_pad_plane(planned.push);
    if (std::holds_alternative<Roll>(planned.push)) continue;
    const LinearPush push = as_linear(planned.push);
    const Vec2& g_O = model.contacts[static_cast<std::size_t>(push.contact)].g_O;
    const bool ends = finger_in_object(planned.end.X_HO) == last && ends_as_given;
    all.push_back({i,
                   {planned.start.X_HO, g_O, carried(plan.margin, before), begins},
                   {planned.end.X_HO, g_O, carried(plan.margin, travelled), ends},
                   push,
                   is_by_point(model, planned.push)});
  }
  return all;
}

bool is_held(const Model& model, const PushEnd& end) {
  Work work;
  return pads_hold_gravity(model, end.X_HO, end.g_O, end.margin, work);
}

bool is_held_between(const Model& model, const PushEnds& ends) {
  const int places = places_along(ends.push.travel, ends.push.turn);
  for (int i = 1; i + 1 < places; ++i) {
    PushEnd between = ends.to;
    const double s = static_cast<double>(i) / (places - 1);
    between.X_HO = pusher_pose(ends.push, ends.from.X_HO, s);
    if (!is_held(model, between)) return false;
  }
  return true;
}

bool may_miss(const Model& model, const PushEnd& end) {
  const Vec2 p_OF = finger_in_object(end.X_HO);
  return distance_to_border(model.pad_face, p_OF, p_OF) < end.margin.grasp;
}

}  // namespace

bool fingers_hold_start(const Model& model, double grip_share) {
  constexpr double kRounding = 1e-9;
  if (can_roll(model.scene.object) || model.prism) return true;
  const PlanarGrasp grasp =
      grasp_at(model, model.scene.start.X_HO, model.scene.g_W / grip_share);
  return gravity_slack_by_pad_law(model, grasp) >= -kRounding;
}

std::string start_holding_fault(const Model& model, const Plan& plan) {
  if (plan.pushes.empty()) return {};
  const double share =
      grip_force_on_way(model, plan.pushes, 0) / model.scene.gripper.grip_force;
  if (fingers_hold_start(model, std::max(1.0, share))) return {};
  return "at the start the fingers alone do not hold the object";
}

std::string margin_holding_fault(const Model& model, const Plan& plan) {
  if (plan.margin.is_none()) return {};
  const bool ends_decide = has_round_pads(model) && !can_roll(model.scene.object);
  for (const PushEnds& ends : ends_of_pushes(model, plan)) {
    if (ends.by_point || ends.from.g_O.isZero(0.0)) continue;
    const bool from = is_held(model, ends.from);
    const bool to = is_held(model, ends.to);
    const bool may_fall = (!from && !ends.from.given) || (!to && !ends.to.given) ||
                          (from && to && !ends_decide && !is_held_between(model, ends));
    if (!may_fall) continue;
    return "push " + std::to_string(ends.index + 1) +
           ": the fingers alone may not hold the object within the margin";
  }
  return {};
}

std::string given_caveat(const Model& model, const Plan& plan) {
  if (plan.margin.is_none()) return {};
  bool falls = false;
  bool misses = false;
  for (const PushEnds& ends : ends_of_pushes(model, plan)) {
    for (const PushEnd& end : {ends.from, ends.to}) {
      if (!end.given) continue;
      falls = falls || !is_held(model, end);
      misses = misses || may_miss(model, end);
    }
  }
  const char* kGiven = " the object at the start or at the goal, which are given";
  std::string text;
  if (falls) text = std::string("the fingers alone may not hold") + kGiven;
  if (misses) {
    text += std::string(falls ? "; " : "") + "the pads may be beside" + kGiven;
  }
  return text.empty() ? text : "within the margin " + text;
}

}  // namespace prehensile
