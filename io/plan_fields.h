/// Every field of a plan file, as scene_fields.h does for scenes. SI units and radians
/// throughout, so that numbers return exactly. Internal to the io layer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields.h"
#include "planner/plan.h"

namespace prehensile::internal {

inline constexpr int kPlanVersion = 1;
inline constexpr std::size_t kMostPushes = 10'000;

inline constexpr Bounds kMetres{-1e3, 1e3, "m"};
inline constexpr Bounds kRadians{-1e3, 1e3, "rad"};
inline constexpr Bounds kShares{0.0, 10.0, ""};
inline constexpr Bounds kDistances{0.0, 1e6, "m"};
inline constexpr Bounds kCosts{0.0, 1e6, ""};

enum class PushKind { kPush, kSlide, kPivot, kRoll };
inline constexpr std::array<Word<PushKind>, 4> kPushWords = {{{PushKind::kPush, "push"},
                                                              {PushKind::kSlide, "slide"},
                                                              {PushKind::kPivot, "pivot"},
                                                              {PushKind::kRoll, "roll"}}};

/// The enumerators with their names from the planner.
template <typename T, std::size_t N>
std::array<Word<T>, N> named(const std::array<T, N>& values) {
  std::array<Word<T>, N> words;
  for (std::size_t i = 0; i < N; ++i) words[i] = {values[i], name(values[i])};
  return words;
}
inline const auto kStatusWords = named(
    std::array{PlanStatus::kNotRun, PlanStatus::kReachedGoal, PlanStatus::kNothingToDo,
               PlanStatus::kInfeasible, PlanStatus::kBudgetSpent, PlanStatus::kStopped,
               PlanStatus::kUnsupported});
inline const auto kPromiseWords =
    named(std::array{Promise::kNominal, Promise::kNominalOnly, Promise::kPartOfMargin,
                     Promise::kMargin, Promise::kScene});
inline constexpr std::array<Word<bool>, 2> kBoundWords = {
    {{true, "distances"}, {false, "contacts"}}};
inline constexpr std::array<Word<bool>, 2> kGravityWords = {
    {{false, "may help"}, {true, "must not help"}}};
inline const auto kProofWords = named(std::array{
    Proof::Kind::kGoalOffObject, Proof::Kind::kStartFalls, Proof::Kind::kGoalFalls,
    Proof::Kind::kNoPusher, Proof::Kind::kNoRoll, Proof::Kind::kHalfSpace,
    Proof::Kind::kGoalBeyondLimits, Proof::Kind::kBarrier, Proof::Kind::kStartBlocked,
    Proof::Kind::kGoalBlocked, Proof::Kind::kTurn});

/// A push as the file has it: pusher and face by name.
struct WrittenPush {
  PushKind kind = PushKind::kPush;
  std::string pusher;
  std::string face;
  std::optional<double> place;
  std::optional<Vec2> direction;
  double travel = 0.0;
  std::optional<double> turn;
  std::optional<double> grip_force;
  std::optional<double> guard_angle;
  std::optional<double> guard_distance;
  PlannedPush planned;  // its numbers; the push itself is made from what is above
};

/// A constraint with the count of pushes that it stopped.
struct WrittenConstraint {
  std::string constraint;
  std::uint64_t count = 0;
};

struct WrittenExplanation {
  std::string text;
  std::vector<WrittenConstraint> stopped_by;
  std::vector<ProposedChange> changes;
};

struct WrittenPlan {
  std::string scene;
  std::string scene_digest;
  Plan plan;  // its pushes and proof are made from the two below
  std::vector<WrittenPush> pushes;
  std::optional<Proof> proof;
  std::optional<WrittenExplanation> explanation;
  double gap = kNan;
};

template <typename Fields>
void visit_grasp(Fields& fields, Grasp& grasp) {
  fields.number("x", grasp.X_HO.x, kMetres, kRequired, "Of O in H.");
  fields.number("y", grasp.X_HO.y, kMetres, kRequired, "Of O in H.");
  fields.number("theta", grasp.X_HO.theta, kRadians, kRequired, "Of O in H, about +z.");
  fields.number("roll", grasp.psi, kRadians, kRequired, "About the long axis.");
}

inline constexpr auto kVisitGrasp = [](auto& fields, Grasp& grasp) {
  visit_grasp(fields, grasp);
};

template <typename Fields>
void visit_push(Fields& fields, WrittenPush& push) {
  fields.word("kind", push.kind, kPushWords, kRequired,
              "What the motion is called. A slide with guard_angle and a pivot with "
              "guard_distance stop where they no longer are one.");
  fields.text("pusher", push.pusher, kRequired, "Name of the pusher in the scene.");
  fields.text("face", push.face, kRequired, "Face of the object that it touches.");
  fields.number("place", push.place, kMetres,
                "Centre of the pusher along the face, from the centre of the face; not "
                "for a roll.");
  fields.vector(
      "direction", push.direction, {-1.0, 1.0, ""},
      "Unit vector in O at the start of the push: where the pusher moves in the "
      "hand; not for a roll.");
  fields.number("travel", push.travel, {-10.0, 10.0, "m"}, kRequired,
                "Length of the path, >= 0; for a roll with sign, along +z of H.");
  fields.number("turn", push.turn, kRadians,
                "Of the pusher in the hand over the whole push; not for a roll.");
  fields.number("grip_force", push.grip_force, {0.0, 1e6, "N"},
                "Of each finger during the push. Absent: that of the scene.");
  fields.number("guard_angle", push.guard_angle, {0.0, 10.0, "rad"},
                "A slide stops when the object has turned by this.");
  fields.number("guard_distance", push.guard_distance, {0.0, 10.0, "m"},
                "A pivot stops when the finger axis has drifted by this.");
  PlannedPush& planned = push.planned;
  fields.group("start", planned.start, kRequired, "Pose in the hand before.",
               kVisitGrasp);
  fields.group("end", planned.end, kRequired, "Pose in the hand after.", kVisitGrasp);
  fields.measured("push_force", planned.push_force, {0.0, 1e12, "N"},
                  "Greatest along the push.");
  fields.measured("slack", planned.slack, {-1e12, 1e12, ""},
                  "Least distance from slipping along the push, margin included.");
  fields.measured("certificate", planned.certificate, {0.0, 1e12, ""},
                  "Worst residual of the laws of contact along the push.");
  fields.measured("error_estimate", planned.error_estimate, kDistances,
                  "Of the end pose.");
}

/// A number that files of before it do not have: 0 if absent, written only if not 0.
template <typename Fields>
void if_positive(Fields& fields, const char* key, double& value, const Bounds& bounds,
                 const char* doc) {
  std::optional<double> written;
  if (value > 0.0) written = value;
  fields.number(key, written, bounds, doc);
  value = written.value_or(0.0);
}

template <typename Fields>
void visit_margin(Fields& fields, Margin& margin) {
  fields.number("friction", margin.friction, kShares, kRequired, "Of the pusher.");
  fields.measured("force", margin.force, {0.0, 1e12, ""},
                  "Of weight over grip. null: the grip may vanish, which no plan "
                  "survives.");
  fields.number("torque_radius", margin.torque_radius, kShares, kRequired,
                "Of the pads.");
  fields.number("place", margin.place, kDistances, kRequired, "Of the pusher.");
  fields.number("centre_of_mass", margin.centre_of_mass, kDistances, kRequired,
                "Of the object.");
  if_positive(fields, "grasp", margin.grasp, kDistances,
              "Of the finger axis in the object when the first push begins. Absent: 0.");
  if_positive(fields, "tilt", margin.tilt, {0.0, 10.0, "rad"},
              "Of the motion and of gravity against the face. Absent: 0.");
  fields.word_if_not(false, "gravity", margin.weightless, kGravityWords,
                     "Whether pushes may need the help of gravity, or have to stick "
                     "without it as well. Absent: may help.");
}

inline const auto kVisitBorder = [](auto& fields, std::vector<Vec2>& border) {
  fields.points("border", border, Length{3, 2000}, kMetres,
                "Vertices in O. Borders neither cross nor touch.");
};

inline const auto kVisitTurnRate = [](auto& fields, TurnRate& rate) {
  fields.vector("at_start", rate.at_start, {-1e6, 1e6, ""}, kRequired,
                "There: torque radius times turn, over the way of the finger axis in O.");
  fields.vector("bend", rate.bend, {-1e9, 1e9, "1/m"}, kRequired,
                "How it changes with the place: xx, xy, yy.");
};

inline const auto kVisitTurnBounds = [](auto& fields, TurnBounds& turn) {
  fields.list("beyond", turn.beyond, Length{0, 200}, kRequired,
              "Places of the finger axis in O that no push leaves, without the goal, as "
              "those of `region`; empty: none.",
              kVisitBorder);
  fields.group("most", turn.most, kRequired, "No push turns by more.", kVisitTurnRate);
  fields.group("least", turn.least, kRequired, "No push turns by less.", kVisitTurnRate);
};

template <typename Fields>
void visit_proof(Fields& fields, Proof& proof) {
  fields.word("kind", proof.kind, kProofWords, kRequired, "Which argument.");
  fields.vector("twist", proof.twist, {-1e6, 1e6, ""}, kRequired,
                "Evidence that gravity is not held.");
  fields.vector("direction", proof.direction, {-1.0, 1.0, ""}, kRequired,
                "Normal of the half-plane that excludes the goal.");
  fields.list("region", proof.region, Length{0, 200}, kOptional,
              "Of a barrier or a turn: places of the finger axis in O that no push "
              "leaves, by the closed borders between which they are (even-odd rule).",
              kVisitBorder);
  fields.group(
      "turn", proof.turn,
      "Of a turn: bounds on it for ways that stay in `region`, if it has any, and "
      "out of `beyond`.",
      kVisitTurnBounds);
  fields.text("text", proof.text, kRequired, "The argument in words.");
}

template <typename Fields>
void visit_costs(Fields& fields, WrittenPlan& record) {
  Plan& plan = record.plan;
  fields.measured("cost", plan.cost, kCosts,
                  "J = placements + travel / length, or by the prices of the scene.");
  fields.number("placements", plan.placements, kCosts, kRequired, "S: of a pusher.");
  fields.measured("travel", plan.travel, kDistances, "T: path length of the plan.");
  if_positive(fields, "work", plan.work, {0.0, 1e12, "J"},
              "W: what the friction of the pads takes. Absent: 0, or the scene states no "
              "cost.");
  if_positive(fields, "grip_changes", plan.grip_changes, kCosts,
              "G: changes of the grip force. Absent: 0, or the scene states no cost.");
  fields.measured("lower_bound", plan.lower_bound, kCosts, "No plan costs less.");
  fields.word(
      "bound_by", plan.bound_is_trivial, kBoundWords, kOptional,
      "What the bound knows: the distances to the goal alone, or what the contacts "
      "allow as well.");
  fields.number("bound_at_goal", plan.bound_at_goal, kCosts,
                "No plan that ends at the goal itself, within a thousandth of its "
                "tolerances, costs less. Absent: the plan ends beside it, or lower_bound "
                "says as much.");
  fields.measured("gap", record.gap, {-1.0, 1e12, ""},
                  "(cost - lower_bound) / lower_bound; for people, not read back.");
  fields.measured("published_cost", plan.published_cost, kCosts,
                  "1 per push by a new pusher, 0.1 by the same one.");
}

template <typename Fields>
void visit_change(Fields& fields, ProposedChange& change) {
  fields.text("what", change.what, kRequired, "In words.");
  fields.text("option", change.option, kOptional, "Of the command line that makes it.");
  fields.text("pusher", change.pusher, kOptional, "To add to the pushers of the scene.");
  fields.measured("cost", change.cost, kCosts, "J of the plan found with it.");
}

template <typename Fields>
void visit_explanation(Fields& fields, WrittenExplanation& explanation) {
  fields.text("text", explanation.text, kRequired, "One paragraph.");
  fields.list("stopped_by", explanation.stopped_by, Length{0, 100}, kOptional,
              "What stopped the pushes that the search tried, most frequent first.",
              [](auto& f, WrittenConstraint& constraint) {
                f.text("constraint", constraint.constraint, kRequired, "In words.");
                f.count("count", constraint.count, "Pushes that it stopped.");
              });
  fields.list("changes", explanation.changes, Length{0, 1000}, kOptional,
              "Changes that were planned for and worked.",
              [](auto& f, ProposedChange& change) { visit_change(f, change); });
}

/// `Work` is what a plan counts in signed numbers; a file has none below 0.
template <typename Fields, typename Work>
void visit_work(Fields& fields, const char* key, Work& work, const char* doc) {
  auto count = static_cast<std::uint64_t>(work);
  fields.count(key, count, doc);
  work = static_cast<Work>(count);
}

template <typename Fields>
void visit_plan(Fields& fields, WrittenPlan& record) {
  Plan& plan = record.plan;
  fields.version(kPlanVersion);
  fields.text("scene_digest", record.scene_digest, kRequired,
              "Of the scene (FNV-1a 64 of its text below).");
  fields.word("status", plan.status, kStatusWords, kRequired, "How the search ended.");
  fields.text("message", plan.message, kRequired, "The same in words.");
  fields.group("proof", record.proof, "Why no plan exists; only if infeasible.",
               [](auto& f, Proof& proof) { visit_proof(f, proof); });
  fields.group("explanation", record.explanation,
               "Why there is no plan, or one with less margin than asked for, and what "
               "would help.",
               [](auto& f, WrittenExplanation& e) { visit_explanation(f, e); });
  fields.text("planner", plan.planner, kRequired, "Which planner found it.");
  fields.count("seed", plan.seed, "Of every random choice.");
  fields.group("margin", plan.margin, kRequired,
               "Box of uncertainty that every push survives: shares, and distances in m.",
               [](auto& f, Margin& margin) { visit_margin(f, margin); });
  fields.word(
      "promise", plan.promise, kPromiseWords, kOptional,
      "What the margin is. part of the margin: no plan was found that survives the "
      "one asked for, this one survives a part of it. nominal only: nor for a part, "
      "this one holds for the values of the scene alone.");
  fields.group("start", plan.start, kRequired, "Pose in the hand before.", kVisitGrasp);
  fields.group("goal", plan.goal, kRequired, "Pose reached.", kVisitGrasp);
  fields.list("pushes", record.pushes, Length{0, kMostPushes}, kRequired, "In order.",
              [](auto& f, WrittenPush& push) { visit_push(f, push); });
  visit_costs(fields, record);
  visit_work(fields, "stick_tests", plan.stick_tests, "Work of the own planner.");
  visit_work(fields, "propagations", plan.propagations, "Work of OMPL's planners.");
  visit_work(fields, "instants", plan.instants, "Exact mechanics calls in checking.");
  fields.measured("seconds", plan.seconds, {0.0, 1e9, "s"}, "Wall time.");
  fields.text("scene", record.scene, kRequired, "The complete scene file (YAML).");
}

}  // namespace prehensile::internal
