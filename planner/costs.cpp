#include "planner/costs.h"

#include <algorithm>
#include <cmath>

#include "mechanics/pad_law.h"
#include "planner/steering/steering.h"
#include "primitives/roll.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Path length of the finger axis, the turn and the roll in the planner's space [m].
/// About a point pusher the object turns by another angle than the pusher.
double travel_of(const Model& model, const PlannedPush& planned) {
  if (const auto* roll = std::get_if<Roll>(&planned.push)) return std::abs(roll->travel);
  const LinearPush linear = as_linear(planned.push);
  if (!model.contacts[static_cast<std::size_t>(linear.contact)].is_point) {
    return std::hypot(linear.travel, model.c * linear.turn);
  }
  const PlanarPose& from = planned.start.X_HO;
  const PlanarPose& to = planned.end.X_HO;
  return std::hypot((finger_in_object(to) - finger_in_object(from)).norm(),
                    model.c * (to.theta - from.theta));
}

/// [N] that a push adds to what the hand needs on the ways beside it.
double grip_beside(const Model& model, const Push* push) {
  const bool counts = push && !std::holds_alternative<Roll>(*push);
  return counts ? grip_force_of(model, *push) : 0.0;
}

double grip_between(const Model& model, const Push* before, const Push* after) {
  return std::max({model.scene.gripper.grip_force, grip_beside(model, before),
                   grip_beside(model, after)});
}

const Push* push_at(const std::vector<PlannedPush>& pushes, std::size_t i) {
  return i < pushes.size() ? &pushes[i].push : nullptr;
}

/// Power over F that whole pads take per travel, at the least over all motions at any
/// angle of the object. It is convex in the motion, so its gradient G at a unit motion
/// u bounds it for unit motions off u by up to `off` [rad]: cos(off) G.u - sin(off) |G|
/// across u.
double least_drag(const Model& model) {
  if (model.has_soft_points()) return 1.0;
  constexpr int kAround = 96;
  constexpr int kUpright = 24;
  const double off = 0.5 * kPi * std::hypot(2.0 / kAround, 0.5 / kUpright);
  const ContactPoints& pads = model.region.whole();
  double least = 1.0;
  for (int i = 0; i < kAround; ++i) {
    const Vec2 along(std::cos(2.0 * kPi * i / kAround),
                     std::sin(2.0 * kPi * i / kAround));
    for (int k = 0; k < kUpright; ++k) {
      const double rise = 0.5 * kPi * (k + 0.5) / kUpright;
      const Vec2 v = std::cos(rise) * along;
      const Eigen::Vector3d u(v.x(), v.y(), std::sin(rise));
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
      for (int j = 0; j < pads.count; ++j) {
        const Vec2 p(pads.x[j], pads.y[j]);
        const Vec2 w = (v + u.z() / model.c * perp(p)).normalized();
        gradient += pads.weight[j] * Eigen::Vector3d(w.x(), w.y(), cross(p, w) / model.c);
      }
      const double power = gradient.dot(u);
      const double across = (gradient - power * u).norm();
      least = std::min(least, std::cos(off) * power - std::sin(off) * across);
    }
  }
  return std::max(0.0, least);
}

/// What the support does to a prism that it rolls from side to side, whose weight comes
/// to rest as high as it was: the mean traction of every two attitudes in a row.
double work_of_prism_roll(const Model& model, const Grasp& start, const Roll& roll) {
  std::vector<Sample> trace;
  apply_roll(model, start, roll, {}, &trace);
  double work = 0.0;
  for (std::size_t i = 1; i < trace.size(); ++i) {
    const double traction =
        0.5 * (trace[i].tangential_force + trace[i - 1].tangential_force);
    work += traction * (trace[i].s - trace[i - 1].s) * roll.travel;
  }
  return std::abs(work);
}

/// One instant decides a roll of a cylinder (primitives/roll.h).
double work_of_roll(const Model& model, const Grasp& start, const Roll& roll) {
  if (model.prism) return work_of_prism_roll(model, start, roll);
  if (!model.cross_section) return kNan;
  CrossSectionModel section = *model.cross_section;
  section.grip_force = grip_force_of(model, roll);
  const auto contact = static_cast<std::size_t>(roll.contact);
  const CrossSectionDrive drive{
      .mu = model.contacts[contact].mu,
      .sheet_rate = roll.travel,
      .weight = roll_section(model, roll.contact, start).weight};
  return solve_cross_section(section, drive).tangential_force[kSheet] * roll.travel;
}

}  // namespace

CostWeights prices(const Model& model) {
  return model.scene.cost.value_or(CostWeights{});
}

double longest_placement_length(const Model& model) noexcept {
  if (!model.scene.cost) return model.L;
  const CostWeights& price = *model.scene.cost;
  const bool alike = model.region.is_fixed_in_hand();
  double work = 0.0;
  const bool rolls = model.cross_section || (model.scene.goal && model.scene.goal->psi);
  if (alike && price.work > 0.0 && model.c > 0.0 && !rolls) {
    double weakest = 1.0;
    for (const PushContact& contact : model.contacts) {
      weakest = std::min(weakest, contact.grip_share);
    }
    work = price.work * weakest * model.F * least_drag(model);
  }
  return model.L / (price.travel + work * model.L);
}

double friction_work(const Model& model, const PlannedPush& push) noexcept {
  if (const auto* roll = std::get_if<Roll>(&push.push)) {
    return work_of_roll(model, push.start, *roll);
  }
  // Gauss-Legendre on equal parts: the power is smooth but where the face begins to clip.
  constexpr int kParts = 8;
  constexpr double kOff = 0.2886751345948129;  // 1 / (2 sqrt 3) from the middle of a part
  const FlatState from{finger_in_object(push.start.X_HO), push.start.X_HO.theta};
  const FlatState to{finger_in_object(push.end.X_HO), push.end.X_HO.theta};
  const Vec2 d = to.p_OF - from.p_OF;
  double work = 0.0;
  for (int i = 0; i < kParts; ++i) {
    for (const double off : {-kOff, kOff}) {
      const PlanarPose X_HO = pose_along(from, to, (i + 0.5 + off) / kParts);
      const Vec2 v = -rotated(X_HO.theta, d);
      const PlanarTwist V(v.x(), v.y(), to.theta - from.theta);
      work += friction_power(model, grasp_at(model, X_HO, Vec2::Zero()), V);
    }
  }
  const auto contact = static_cast<std::size_t>(contact_of(push.push));
  return work / (2 * kParts) * model.contacts[contact].grip_share;
}

double grip_force_on_way(const Model& model, const std::vector<PlannedPush>& pushes,
                         std::size_t push) {
  const Push* before = push > 0 ? push_at(pushes, push - 1) : nullptr;
  return grip_between(model, before, push_at(pushes, push));
}

double greatest_grip_share(const Model& model) {
  double greatest = 1.0;
  for (const PushContact& contact : model.contacts) {
    greatest = std::max(greatest, contact.grip_share);
  }
  return greatest;
}

int grip_changes_on_way(const Model& model, const Push* before, const Push* after) {
  constexpr double kSame = 1e-9;
  const double way = grip_between(model, before, after);
  const auto changes = [&](const Push* push) {
    return push && std::abs(grip_force_of(model, *push) - way) > kSame * way ? 1 : 0;
  };
  return changes(before) + changes(after);
}

int grip_changes(const Model& model, const std::vector<PlannedPush>& pushes) {
  int changes = 0;
  for (std::size_t i = 0; i <= pushes.size(); ++i) {
    const Push* before = i > 0 ? push_at(pushes, i - 1) : nullptr;
    const Push* after = push_at(pushes, i);
    const bool stays = before && after && same_placement(*after, *before);
    if (!stays) changes += grip_changes_on_way(model, before, after);
  }
  return pushes.empty() ? 0 : changes;
}

bool same_placement(const Push& push, const Push& before) {
  const bool rolls = std::holds_alternative<Roll>(push);
  if (rolls != std::holds_alternative<Roll>(before)) return false;
  if (contact_of(push) != contact_of(before)) return false;
  return rolls || as_linear(push).place == as_linear(before).place;
}

void account(const Model& model, Plan& plan) {
  constexpr double kSamePusherCost = 0.1;  // of the published planners
  plan.placements = 0.0;
  plan.travel = 0.0;
  plan.published_cost = 0.0;
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    const Push& push = plan.pushes[i].push;
    const Push* before = i > 0 ? &plan.pushes[i - 1].push : nullptr;
    if (!before || !same_placement(push, *before)) plan.placements += 1.0;
    const bool same_pusher = before && contact_of(push) == contact_of(*before);
    plan.published_cost += same_pusher ? kSamePusherCost : 1.0;
    plan.travel += travel_of(model, plan.pushes[i]);
  }
  plan.work = 0.0;
  plan.grip_changes = 0.0;
  if (model.scene.cost) {
    for (const PlannedPush& push : plan.pushes) plan.work += friction_work(model, push);
    plan.grip_changes = grip_changes(model, plan.pushes);
  }
  const CostWeights price = prices(model);
  plan.cost = plan.placements + price.travel * plan.travel / model.L +
              price.work * plan.work + price.grip_change * plan.grip_changes;
}

}  // namespace prehensile
