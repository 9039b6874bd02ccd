#include "planner/advice.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "planner/steering/limits.h"
#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

constexpr double kMostFriction = 2.0;  // what any pusher might be covered with
constexpr double kUsualFriction = 0.5;
constexpr double kPusherDistance = 0.1;  // [m] of a proposed pusher from the face

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value + 0.0);  // never "-0"
  return text;
}

/// As it is read back from what `number` writes: what is named is what was tried.
double written(double value) { return std::strtod(number(value).c_str(), nullptr); }

/// Tries changed scenes and keeps those that can be planned.
class Adviser {
 public:
  Adviser(const Model& model, const Plan& plan, const PlanOptions& options,
          std::int64_t budget)
      : model_(model),
        falls_(plan.proof.kind == Proof::Kind::kStartFalls ||
               plan.proof.kind == Proof::Kind::kGoalFalls),
        is_by_other_(options.planner != PlanOptions{}.planner),
        options_(options) {
    options_.budget = std::min(options.budget, budget);
    options_.nominal_if_needed = false;
    options_.prove = false;
    options_.planner = PlanOptions{}.planner;
    options_.settings = {};
    begin_ = std::chrono::steady_clock::now() -
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(std::fmax(0.0, plan.seconds)));
    options_.margin = options.margin.value_or(usual_margin(model));
  }

  /// Whether the time was over before all was tried.
  bool is_late() const { return !with_time_left(options_, begin_); }

  std::vector<ProposedChange> changes() {
    if (is_by_other_) works(model_.scene, {"the own planner", "--planner push"});
    try_frictions();
    try_finger_frictions();
    if (!try_grip_forces()) try_grip_range();
    try_tolerances();
    try_free_angle();
    try_limits();
    try_obstacles();
    try_pushers();
    return std::move(changes_);
  }

 private:
  bool stopped() const { return options_.stop && options_.stop->load(); }

  /// Keeps the change if its scene can be planned with the margin asked for.
  bool works(const Scene& scene, ProposedChange change) {
    const auto rest = with_time_left(options_, begin_);
    if (stopped() || !rest || !check(scene).empty()) return false;
    const Plan plan = plan_regrasp(prepare(scene, model_.options), *rest);
    if (plan.status != PlanStatus::kReachedGoal) return false;
    change.cost = plan.cost;
    changes_.push_back(std::move(change));
    return true;
  }

  void try_frictions() {
    const std::vector<Pusher>& pushers = model_.scene.pushers;
    for (std::size_t i = 0; i < pushers.size(); ++i) {
      const double from = pushers[i].friction;
      for (const double factor : {1.25, 1.5, 2.0, 3.0}) {
        const double to =
            written(std::max(factor * from, from == 0.0 ? 0.1 * factor : 0.0));
        if (to > kMostFriction) break;
        Scene scene = model_.scene;
        scene.pushers[i].friction = to;
        ProposedChange change{"friction of pusher " + pushers[i].name + " " +
                              number(from) + " -> " + number(to)};
        change.option = "--set pushers." + std::to_string(i) + ".friction=" + number(to);
        if (works(scene, std::move(change))) break;
      }
    }
  }

  /// Of a grasp that falls, whatever holds it: that is told without a search.
  bool is_worth_trying(double factor) const { return factor <= 4.0 || falls_; }

  void try_finger_frictions() {
    const std::array<double, 2> from = model_.scene.gripper.friction;
    for (const double factor : {1.25, 1.5, 2.0, 4.0, 8.0, 16.0, 32.0}) {
      const std::array<double, 2> to = {written(factor * from[0]),
                                        written(factor * from[1])};
      if (!is_worth_trying(factor) || std::max(to[0], to[1]) > kMostFriction) return;
      Scene scene = model_.scene;
      scene.gripper.friction = to;
      const auto both = [](const std::array<double, 2>& mu) {
        return mu[0] == mu[1] ? number(mu[0])
                              : '[' + number(mu[0]) + ',' + number(mu[1]) + ']';
      };
      ProposedChange change{"friction of the fingers " + both(from) + " -> " + both(to)};
      change.option = "--set gripper.friction=" + both(to);
      if (works(scene, std::move(change))) return;
    }
  }

  bool try_grip_forces() {
    const double from = model_.scene.gripper.grip_force;
    for (const double factor : {1.25, 1.5, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
      if (!is_worth_trying(factor)) return false;
      Scene scene = model_.scene;
      const double to = written(factor * from);
      scene.gripper.grip_force = to;
      ProposedChange change{"grip force " + number(from) + " N -> " + number(to) + " N"};
      change.option = "--set gripper.grip_force=" + number(to);
      if (works(scene, std::move(change))) return true;
    }
    return false;
  }

  void try_grip_range() {
    const double own = model_.scene.gripper.grip_force;
    if (model_.scene.g_W.isZero() || model_.scene.g_Wz != 0.0 ||
        model_.scene.gripper.grip_range) {
      return;
    }
    const std::string low = number(0.5 * own);
    const std::string high = number(4.0 * own);
    Scene scene = model_.scene;
    scene.gripper.grip_range = Vec2(written(0.5 * own), written(4.0 * own));
    ProposedChange change{"a grip force for each push, of " + low + " to " + high + " N"};
    change.option = "--set gripper.grip_range=[" + low + ',' + high + ']';
    works(scene, std::move(change));
  }

  void try_tolerances() {
    const Goal& goal = *model_.scene.goal;
    for (const double factor : {2.0, 5.0, 10.0, 20.0}) {
      Scene scene = model_.scene;
      const double to = written(factor * goal.position_tolerance);
      scene.goal->position_tolerance = to;
      ProposedChange change{"position tolerance of the goal " +
                            number(1e3 * goal.position_tolerance) + " mm -> " +
                            number(1e3 * to) + " mm"};
      change.option = "--set goal.tolerance.position=" + number(to);
      if (works(scene, std::move(change))) break;
    }
    if (goal.test != GoalTest::kPerCoordinate || !goal.theta) return;
    constexpr double kDegree = std::numbers::pi / 180.0;
    for (const double degrees : {5.0, 10.0, 20.0, 45.0}) {
      if (degrees * kDegree <= goal.angle_tolerance) continue;
      Scene scene = model_.scene;
      scene.goal->angle_tolerance = degrees * kDegree;
      ProposedChange change{"angle tolerance of the goal " +
                            number(goal.angle_tolerance / kDegree) + " deg -> " +
                            number(degrees) + " deg"};
      change.option = "--set goal.tolerance.angle_deg=" + number(degrees);
      if (works(scene, std::move(change))) return;
    }
  }

  void try_free_angle() {
    if (!model_.scene.goal->theta) return;
    Scene scene = model_.scene;
    scene.goal->theta.reset();
    works(scene, {"a goal without an angle (leave goal.theta out)"});
  }

  void try_limits() {
    if (model_.scene.goal->theta_is == ThetaMeaning::kNumber) {
      Scene scene = model_.scene;
      scene.goal->theta_is = ThetaMeaning::kAngle;
      works(scene, {"a goal whose turns do not count", "--set goal.theta_is=angle"});
    }
    if (!model_.scene.limits) return;
    try_wider_theta();
    const auto without = [&](const char* what, const auto& change) {
      Scene scene = model_.scene;
      change(*scene.limits);
      works(scene, {what});
    };
    const GraspLimits& limits = *model_.scene.limits;
    if (limits.finger_low || limits.finger_high) {
      without(
          "no limits on the finger axis (leave limits.finger_low and finger_high out)",
          [](GraspLimits& l) { l.finger_low = l.finger_high = std::nullopt; });
    }
    if (limits.hand_low || limits.hand_high || limits.hand_angle_low) {
      without("no limits on the hand in the world (leave limits.hand_... out)",
              [](GraspLimits& l) {
                l.hand_low = l.hand_high = std::nullopt;
                l.hand_angle_low = l.hand_angle_high = std::nullopt;
              });
    }
  }

  void try_wider_theta() {
    constexpr double kDegree = std::numbers::pi / 180.0;
    const GraspLimits& limits = *model_.scene.limits;
    if (!limits.theta_low && !limits.theta_high) return;
    for (const double degrees : {15.0, 45.0, 90.0, 180.0, 360.0}) {
      Scene scene = model_.scene;
      ProposedChange change{"limits on theta wider by " + number(degrees) + " deg"};
      const auto widen = [&](std::optional<double>& limit, double by, const char* field) {
        if (!limit) return;
        const double to = written(*limit / kDegree + by);
        *limit = to * kDegree;
        change.option += change.option.empty() ? "--set " : " --set ";
        change.option += std::string(field) + '=' + number(to);
      };
      widen(scene.limits->theta_low, -degrees, "limits.theta_low_deg");
      widen(scene.limits->theta_high, degrees, "limits.theta_high_deg");
      if (works(scene, std::move(change))) return;
    }
  }

  /// Without one of the bodies of the fixture, or else with no clearance.
  void try_obstacles() {
    if (!model_.scene.obstacles) return;
    const std::vector<ConvexBody>& fixture = model_.scene.obstacles->fixture;
    for (std::size_t i = 0; i < fixture.size(); ++i) {
      Scene scene = model_.scene;
      std::vector<ConvexBody>& bodies = scene.obstacles->fixture;
      bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
      works(scene, {"the body " + fixture[i].name + " of the fixture taken away"});
    }
    if (model_.scene.obstacles->clearance <= 0.0) return;
    Scene scene = model_.scene;
    scene.obstacles->clearance = 0.0;
    works(scene, {"no clearance of the hand", "--set obstacles.clearance=0"});
  }

  /// One flat pusher more, against each face that none touches yet.
  void try_pushers() {
    for (std::size_t i = 0; i < model_.faces.size(); ++i) {
      const Face& face = model_.faces[i];
      const bool is_touched = std::any_of(
          model_.contacts.begin(), model_.contacts.end(),
          [&](const PushContact& c) { return c.face == static_cast<int>(i); });
      if (is_touched || !face.on_hull) continue;
      Scene scene = model_.scene;
      Pusher pusher;
      pusher.name = "wall_at_" + face.name;
      pusher.feature = LineFeature{};
      pusher.friction = kUsualFriction;
      for (const Pusher& other : scene.pushers) {
        pusher.friction = std::max(pusher.friction, other.friction);
      }
      pusher.p_WP = face.centre() - kPusherDistance * face.n;
      pusher.normal_angle = std::atan2(face.n.y(), face.n.x());
      pusher.faces = {face.name};
      ProposedChange change{"one more pusher, a wall of friction " +
                            number(pusher.friction) + " against face " + face.name};
      change.pusher =
          "{name: " + pusher.name + ", line: {}, friction: " + number(pusher.friction) +
          ", position: [" + number(pusher.p_WP.x()) + ", " + number(pusher.p_WP.y()) +
          "], normal_deg: " + number(pusher.normal_angle * 180.0 / std::numbers::pi) +
          ", faces: [\"" + face.name + "\"]}";
      scene.pushers.push_back(std::move(pusher));
      works(scene, std::move(change));
    }
  }

  const Model& model_;
  const bool falls_;
  const bool is_by_other_;  ///< planner than that of the trials
  PlanOptions options_;
  std::chrono::steady_clock::time_point begin_;  ///< of planning
  std::vector<ProposedChange> changes_;
};

/// "62 % because ..., 21 % because ..."
std::string shares(const ConstraintCounts& stopped_by) {
  std::array<int, kPushConstraints> order;
  for (int i = 0; i < kPushConstraints; ++i) order[static_cast<std::size_t>(i)] = i;
  const auto count = [&](int i) { return stopped_by[static_cast<PushConstraint>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return count(a) > count(b); });
  const double total = static_cast<double>(stopped_by.total());
  std::string out;
  for (int k = 0; k < 3; ++k) {
    const int i = order[static_cast<std::size_t>(k)];
    const double share = static_cast<double>(count(i)) / total;
    if (share < 0.01) break;
    if (!out.empty()) out += ", ";
    out += number(std::round(100.0 * share));
    out += " % because ";
    out += name(static_cast<PushConstraint>(i));
  }
  return out;
}

std::string paragraph(const Plan& plan, const Explanation& explanation, bool is_late) {
  std::string text;
  if (plan.status == PlanStatus::kInfeasible) {
    text = "No plan exists: " + plan.proof.text + ".";
  } else if (plan.promise == Promise::kPartOfMargin) {
    text = "A plan was found for a part of the margin only.";
  } else if (plan.usable()) {
    text = "Only a nominal plan was found.";
  } else {
    text = "No plan was found, which does not prove that there is none.";
  }
  if (plan.stopped_by.total() > 0) {
    text += " Of " + std::to_string(plan.stopped_by.total()) +
            " pushes that the search gave up, " + shares(plan.stopped_by) + ".";
  }
  if (explanation.changes.empty() && is_late) {
    return text + " The time was over before all changes that might help were tried.";
  }
  if (explanation.changes.empty()) {
    return text +
           " None of the changes that were tried (frictions, grip force, "
           "tolerances, angle of the goal, limits and obstacles of the scene, one pusher "
           "more) makes it solvable" +
           (plan.usable() ? " with the whole margin." : ".");
  }
  text += plan.usable() ? " With the whole margin it can be solved with "
                        : " It can be solved with ";
  for (std::size_t i = 0; i < explanation.changes.size(); ++i) {
    if (i > 0) text += i + 1 == explanation.changes.size() ? "; or with " : "; with ";
    text += explanation.changes[i].what;
  }
  return text + ".";
}

}  // namespace

Explanation explain(const Model& model, const Plan& plan, const PlanOptions& options,
                    std::int64_t budget) {
  Explanation explanation;
  bool is_late = false;
  if (model.scene.goal) {
    Adviser adviser(model, plan, options, budget);
    explanation.changes = adviser.changes();
    is_late = adviser.is_late();
  }
  explanation.text = paragraph(plan, explanation, is_late);
  return explanation;
}

}  // namespace prehensile
