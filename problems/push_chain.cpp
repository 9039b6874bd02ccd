#include "problems/push_chain.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "mechanics/sticking.h"
#include "primitives/roll.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kShortestMove = 5e-3;  // [m]
constexpr double kLongestMove = 40e-3;  // [m]
constexpr double kLargestTurn = 2.0;    // [rad]
constexpr int kTriesPerMove = 400;

bool held(const Model& model, const PushContact& contact, const Vec2& p_OF) {
  return holding_slack(model, p_OF, contact.g_O, Margin{}) > 0.0;
}

/// The push sticks with the exact pads over the default margin, at points every 2 mm and
/// 0.1 rad, stays on the object, ends where gravity is held, and is certified.
bool sticks(const Model& model, const PlanarPose& X_HO, const LinearPush& push) {
  const PushContact& contact = model.contacts[push.contact];
  const Vec2 p_OF = finger_in_object(X_HO);
  if (!held(model, contact, p_OF) || !held(model, contact, p_OF - push.travel * push.e)) {
    return false;
  }
  const int parts =
      1 + static_cast<int>(std::max(push.travel / 2e-3, std::abs(push.turn) / 0.1));
  for (int i = 0; i <= parts; ++i) {
    const double s = static_cast<double>(i) / parts;
    const Vec2 p = p_OF - s * push.travel * push.e;
    if (depth_inside(model.outline, p) < 1e-3) return false;
    const PlanarPose pose = pose_from_finger(p, X_HO.theta + s * push.turn);
    const StickTest test = exact_stick_test(model, contact, push.place, pose, push.e,
                                            push.travel, push.turn, Margin{});
    if (!(test.slack >= 0.0)) return false;
  }
  const Transition done = apply(model, {X_HO, 0.0}, push);
  return done.completed() && done.slipped == 0.0;
}

/// A point pusher sticks at its point while the object turns about it as it likes: the
/// push is one that the exact mechanics follows to its end, on the object all the way,
/// gravity held before and after.
bool follows(const Model& model, const PlanarPose& X_HO, const LinearPush& push) {
  constexpr double kSlip = 1e-5;  // [m]
  const PushContact& contact = model.contacts[push.contact];
  const Transition done = apply(model, {X_HO, 0.0}, push);
  const Vec2 end = finger_in_object(done.end.X_HO);
  const auto is_deep = [&](const Vec2& p) {
    return depth_inside(model.outline, p) > 1e-3;
  };
  if (!done.completed() || !(done.slipped < kSlip) || !is_deep(end) ||
      !held(model, contact, finger_in_object(X_HO)) || !held(model, contact, end)) {
    return false;
  }
  std::vector<Sample> trace;
  apply(model, {X_HO, 0.0}, push, {}, &trace);
  return std::all_of(trace.begin(), trace.end(), [&](const Sample& sample) {
    return is_deep(finger_in_object(sample.grasp.X_HO));
  });
}

std::optional<LinearPush> random_move(const Model& model, const PlanarPose& X_HO,
                                      int avoided, RandomStream& random) {
  for (int i = 0; i < kTriesPerMove; ++i) {
    LinearPush push;
    push.contact = random.below(static_cast<int>(model.contacts.size()));
    const PushContact& contact = model.contacts[push.contact];
    if (contact.is_point) {
      const double half = 0.45 * (contact.b - contact.a).norm();
      push.place = random.in(-half, half);
    }
    const double cone = std::atan(contact.mu);
    push.e = rotated(random.in(-cone, cone), contact.n);
    push.travel = random.in(kShortestMove, kLongestMove);
    const double kappa = std::tan(random.in(-1.5, 1.5));
    push.turn = kappa * push.travel / model.c;
    if (push.contact == avoided || std::abs(push.turn) > kLargestTurn) continue;
    if (contact.is_point ? follows(model, X_HO, push) : sticks(model, X_HO, push)) {
      return push;
    }
  }
  return std::nullopt;
}

/// A roll by a random angle on a grip that the support makes unique, where it is
/// possible.
std::optional<Roll> random_roll(const Model& model, const Grasp& grasp,
                                RandomStream& random) {
  const double dpsi = random.in(-kPi, kPi);
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const RollSection section = roll_section(model, static_cast<int>(i), grasp);
    if (!section.possible || !(section.weight > 0.0)) continue;
    const auto& friction = model.scene.gripper.friction;
    const Roll roll{.contact = static_cast<int>(i),
                    .travel = dpsi / section.psi_per_travel,
                    .grip_force = 0.05 * section.weight / (friction[0] + friction[1])};
    if (apply(model, grasp, roll).completed()) return roll;
  }
  return std::nullopt;
}

}  // namespace

bool held_by_all(const Model& model, const Vec2& p_OF) {
  return std::all_of(
      model.contacts.begin(), model.contacts.end(),
      [&](const PushContact& contact) { return held(model, contact, p_OF); });
}

bool append_chain(const Model& model, const ChainRange& range, RandomStream& random,
                  RandomRegrasp& problem) {
  Grasp grasp = model.scene.start;
  const int wanted = range.least + random.below(range.most - range.least + 1);
  std::set<int> pushers;
  for (int i = 0; i < wanted; ++i) {
    const bool must_change = range.two_pushers && pushers.size() == 1 && i + 1 == wanted;
    const auto move =
        random_move(model, grasp.X_HO, must_change ? *pushers.begin() : -1, random);
    if (!move) return false;
    problem.pushes.push_back(*move);
    pushers.insert(model.contacts[move->contact].pusher);
    if (model.contacts[move->contact].is_point) {
      grasp.X_HO = apply(model, grasp, *move).end.X_HO;
      continue;
    }
    const Vec2 p_OF = finger_in_object(grasp.X_HO) - move->travel * move->e;
    grasp.X_HO = pose_from_finger(p_OF, grasp.X_HO.theta + move->turn);
  }
  if (range.rolls) {
    const auto roll = random_roll(model, grasp, random);
    if (!roll) return false;
    problem.pushes.push_back(*roll);
    grasp = apply(model, grasp, *roll).end;
  }
  problem.pushers = static_cast<int>(pushers.size());
  std::optional<Goal>& goal_of_scene = problem.scene.goal;
  Goal& goal = goal_of_scene ? *goal_of_scene : goal_of_scene.emplace();
  goal.x = grasp.X_HO.x;
  goal.y = grasp.X_HO.y;
  goal.theta = wrapped(grasp.X_HO.theta);
  goal.psi.reset();
  if (range.rolls) goal.psi = wrapped(grasp.psi);
  return true;
}

}  // namespace prehensile
