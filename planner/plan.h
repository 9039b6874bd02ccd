/// A regrasp plan and everything that is known about it.
///
/// Cost J = S + T / L, or what the scene states (costs.h): S pusher placements (runs of
/// pushes by the same pusher at the same place), T travel = path length of
/// (p_OF, c theta, r psi) [m], L longer side of the object. The published cost, 1 per
/// push by a new pusher and 0.1 by the same, is reported beside it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/sticking.h"
#include "planner/loops.h"
#include "planner/push_constraint.h"
#include "primitives/push.h"
#include "primitives/transition.h"

namespace prehensile {

/// One push of a plan with the numbers that the exact mechanics gives for it.
struct PlannedPush {
  Push push;
  Grasp start, end;
  double push_force = kNan;  ///< [N] greatest along the push
  double slack = kNan;  ///< least robust slack along the push (StickTest), margin box
                        ///< of the plan included; >= 0
  double certificate = kNan;     ///< worst entry along the push
  double error_estimate = kNan;  ///< [m]
};

enum class PlanStatus {
  kNotRun,
  kReachedGoal,  ///< pushes valid; every push passed the exact check with the margin
  kNothingToDo,  ///< the start is a goal
  kInfeasible,   ///< refused; `proof` can be verified by `verify`
  kBudgetSpent,  ///< undecided: no plan within the work budget or time limit
  kStopped,      ///< undecided: interrupted
  kUnsupported,  ///< the scene asks for what this planner does not do; see message
};
std::string_view name(PlanStatus status);

/// A bound on c dtheta along dp_OF that depends on the place: the gradient of a quadratic
/// function of p_OF. Places are meant from that of the start [m].
struct TurnRate {
  Vec2 at_start = Vec2::Zero();  ///< no unit
  Vec3 bend = Vec3::Zero();      ///< [1/m] how it changes with the place: xx, xy, yy

  Vec2 at(const Vec2& from_start) const {
    return at_start + Vec2(bend[0] * from_start.x() + bend[1] * from_start.y(),
                           bend[1] * from_start.x() + bend[2] * from_start.y());
  }

  /// Bound on c times the turn over all ways from the start to there [m].
  double along(const Vec2& from_start) const {
    return from_start.dot(at(0.5 * from_start));
  }
};

/// By how much the object turns on ways of the finger axis that do not get to `beyond`.
struct TurnBounds {
  Loops beyond;          ///< [m] of places p_OF; empty if none is in it
  TurnRate most, least;  ///< least . dp_OF <= c dtheta <= most . dp_OF
};

/// Why no plan exists. Each kind is checked by `verify` from the model alone.
struct Proof {
  enum class Kind {
    kNone,
    kGoalOffObject,  ///< the pads would not be on the object at any pose of the goal set
    kStartFalls,     ///< gravity is not held at the start; twist = evidence
    kGoalFalls,      ///< gravity is not held at the goal whatever pusher is near
    kNoPusher,       ///< no pusher can touch any face, and the goal is not the start
    kNoRoll,         ///< the goal fixes psi and nothing can roll the object
    kHalfSpace,      ///< every possible push moves p_OF into a half-plane that excludes
                     ///< the goal; direction = its normal
    kGoalBeyondLimits,  ///< the limits of the scene exclude every pose of the goal set
    kBarrier,  ///< no push moves p_OF out of a region that excludes the goal; region = it
    kStartBlocked,  ///< every push that begins at the start meets obstacles there
    kGoalBlocked,   ///< every push that ends at the goal meets obstacles there
    kTurn,  ///< no push moves p_OF out of `region`, nor back out of turn->beyond, which
            ///< excludes the goal; in between the bounds on the turn exclude its angle
  };
  Kind kind = Kind::kNone;
  PlanarTwist twist = PlanarTwist::Zero();
  Vec2 direction = Vec2::Zero();
  Loops region;  ///< [m] of places p_OF; of a turn: empty if all places are in it
  std::optional<TurnBounds> turn;
  std::string text;
};
std::string_view name(Proof::Kind kind);

/// What a plan promises to survive.
enum class Promise {
  kNominal,       ///< as asked: only the values of the scene
  kNominalOnly,   ///< no plan was found for the margin asked for; this one has none
  kPartOfMargin,  ///< likewise; this one has a part of it, which is its `margin`
  kMargin,        ///< the margin given in the options, or the usual box
  kScene,         ///< the uncertainty that the scene states
};
std::string_view name(Promise promise);

/// A change of the scene or of the options that was planned for and worked.
struct ProposedChange {
  std::string what;    ///< for people
  std::string option;  ///< of the command line that makes it; empty: none does
  std::string pusher;  ///< to add to the scene file's pushers; empty: none
  double cost = kNan;  ///< J of the plan found with it
};

/// Why there is no plan, or one with less margin, and what would help (advice.h).
struct Explanation {
  std::string text;  ///< one paragraph
  std::vector<ProposedChange> changes;
};

struct Plan {
  PlanStatus status = PlanStatus::kNotRun;
  std::string message;
  Proof proof;

  Grasp start, goal;  ///< goal: the member of the goal set that was reached
  std::vector<PlannedPush> pushes;
  Margin margin;  ///< box of uncertainty that every push survives
  Promise promise = Promise::kMargin;

  double cost = kNan;            ///< J
  double placements = 0;         ///< S
  double travel = kNan;          ///< T [m]
  double work = 0.0;             ///< [J] that pads take; 0 where the scene has no cost
  double grip_changes = 0.0;     ///< likewise
  double lower_bound = kNan;     ///< valid bound on J over all sticking plans
  bool bound_is_trivial = true;  ///< by distances alone, nothing about pushers
  std::int64_t bound_nodes = 0;  ///< work of the bound, see planner/bounds/bounds.h
  /// Bound of plans that end at the goal itself (goal_itself), as this one does: where
  /// that is more than `lower_bound`, which ends beside the goal may leave low.
  std::optional<double> bound_at_goal;
  double published_cost = kNan;

  std::string planner;  ///< which planner found it
  std::uint64_t seed = 0;
  std::int64_t stick_tests = 0;            ///< work of the own planner
  std::int64_t propagations = 0;           ///< work of OMPL's planners
  std::int64_t instants = 0;               ///< exact mechanics calls in checking
  double seconds = kNan;                   ///< wall time, recorded only
  ConstraintCounts stopped_by;             ///< met by the own search
  std::optional<Explanation> explanation;  ///< only if asked for, see advice.h
  bool stopped_early = false;  ///< interrupted: the best plan found until then

  bool usable() const {
    return status == PlanStatus::kReachedGoal || status == PlanStatus::kNothingToDo;
  }
  /// Of the cost over its bound; 0 where it is the bound, be that 0 as of nothing to do.
  double gap() const { return gap_to(lower_bound); }
  double gap_to(double bound) const {
    return cost == bound ? 0.0 : (cost - bound) / bound;
  }
  bool rolls() const;  ///< some push is a roll
};

/// Of each finger during a push [N].
double grip_force_of(const Model& model, const Push& push);

}  // namespace prehensile
