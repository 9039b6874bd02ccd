#include "planner/proofs/refuse.h"

#include <array>

#include "mechanics/pad_law.h"
#include "planner/costs.h"
#include "planner/proofs/barrier.h"
#include "planner/proofs/turn_proof.h"
#include "planner/steering/limits.h"

namespace prehensile {
namespace {

std::string sentence(Proof::Kind kind) {
  switch (kind) {
    case Proof::Kind::kGoalOffObject:
      return "at every pose of the goal the pads are off the object";
    case Proof::Kind::kStartFalls:
      return "at the start the grasp does not hold the object against gravity";
    case Proof::Kind::kGoalFalls:
      return "at the goal the grasp does not hold the object against gravity, whatever "
             "pusher is near";
    case Proof::Kind::kNoPusher:
      return "no pusher can touch any face of the object";
    case Proof::Kind::kNoRoll:
      return "the goal fixes the roll angle and no pusher can roll the object";
    case Proof::Kind::kHalfSpace:
      return "every possible push moves the finger axis into a half-plane that does not "
             "contain the goal";
    case Proof::Kind::kGoalBeyondLimits:
      return "the limits of the scene exclude every pose of the goal";
    case Proof::Kind::kBarrier:
      return "no sticking push moves the finger axis out of a region of the object that "
             "contains the start and not the goal";
    case Proof::Kind::kStartBlocked:
      return "at the start obstacles are in the way of every push: of the hand or the "
             "object while it pushes there or approaches, or the hand's own body in that "
             "of the object";
    case Proof::Kind::kGoalBlocked:
      return "at the goal obstacles are in the way of every push: of the hand or the "
             "object while it pushes there or retreats, or the hand's own body in that "
             "of "
             "the object";
    case Proof::Kind::kTurn:
      return "sticking pushes turn the object too little, or too much, on all ways from "
             "the start to the goal";
    case Proof::Kind::kNone:
      break;
  }
  return {};
}

Proof make_proof(Proof::Kind kind) { return {.kind = kind, .text = sentence(kind)}; }

/// The twist with which gravity gains most over friction at a pose; without friction the
/// fall itself.
Proof falling_proof(const Model& model, Proof::Kind kind, const PlanarPose& X_HO,
                    const Vec2& g_O) {
  Proof proof = make_proof(kind);
  const PlanarGrasp grasp = grasp_at(model, X_HO, g_O);
  if (grasp.count > 0) {
    gravity_slack_by_pad_law(model, grasp, &proof.twist);
  } else if (!grasp.w_g.isZero()) {
    proof.twist << grasp.w_g.head<2>().normalized(), 0.0;
  }
  return proof;
}

/// Normals of half-planes that may contain all motions e of the object: those along the
/// borders of the contacts' cones of motion, and the faces' own.
std::vector<Vec2> candidate_directions(const Model& model) {
  std::vector<Vec2> directions;
  for (const PushContact& contact : model.contacts) {
    const double angle = std::atan(contact.mu) + kIsotropyError;
    for (const double side : {1.0, -1.0}) {
      directions.push_back(side * perp(rotated(-side * angle, contact.n)));
    }
    directions.push_back(contact.n);
  }
  return directions;
}

bool accept(const Model& model, const Proof& candidate, Proof& proof) {
  if (!verify(model, candidate)) return false;
  proof = candidate;
  return true;
}

}  // namespace

Proof find_proof(const Model& model) {
  Proof proof;
  if (!model.scene.goal) return proof;
  const Goal& goal = *model.scene.goal;
  using Kind = Proof::Kind;
  for (const Kind kind :
       {Kind::kNoPusher, Kind::kGoalOffObject, Kind::kGoalBeyondLimits, Kind::kNoRoll}) {
    if (accept(model, make_proof(kind), proof)) return proof;
  }
  const Proof start = falling_proof(model, Kind::kStartFalls, model.scene.start.X_HO,
                                    model.scene.g_W / greatest_grip_share(model));
  if (accept(model, start, proof)) return proof;
  if (goal.x && goal.y && goal.theta && !model.contacts.empty()) {
    const PlanarPose X_HO{*goal.x, *goal.y, *goal.theta};
    const Proof end =
        falling_proof(model, Kind::kGoalFalls, X_HO, model.contacts.front().g_O);
    if (accept(model, end, proof)) return proof;
  }
  for (const Vec2& direction : candidate_directions(model)) {
    Proof half_space = make_proof(Kind::kHalfSpace);
    half_space.direction = direction;
    if (accept(model, half_space, proof)) return proof;
  }
  for (const Kind kind : {Kind::kStartBlocked, Kind::kGoalBlocked}) {
    if (accept(model, make_proof(kind), proof)) return proof;
  }
  return proof;
}

Proof find_barrier_proof(const Model& model, const std::function<bool()>& stopped) {
  Proof proof = make_proof(Proof::Kind::kBarrier);
  proof.region = find_barrier(model, stopped);
  if (!proof.region.empty()) return proof;
  proof = make_proof(Proof::Kind::kTurn);
  return find_turn(model, proof, stopped) ? proof : Proof{};
}

Proof look_for_barrier(const Model& model, const PlanOptions& options, const Work& work) {
  if (!options.prove) return {};
  if (work.meter) work.meter->enter("proof");
  const Limits limits(options, work);
  return find_barrier_proof(model,
                            [&] { return limits.stopped() || limits.out_of_time(); });
}

}  // namespace prehensile
