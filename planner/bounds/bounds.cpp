#include "planner/bounds/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/bounds/slab_travel.h"
#include "planner/bounds/word_bound.h"
#include "planner/costs.h"
#include "planner/geometry/angle_scan.h"
#include "planner/planner.h"
#include "planner/steering/goal.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kAccuracy = 1e-7;  // [m] of distances; they are rounded down

/// Angles that a member of the goal set may have, near the angle of the start. Farther
/// turns have the same places and a longer way.
struct AngleRange {
  double low, high;
};

double angle_slack(const Goal& goal) {
  return goal.test == GoalTest::kWeightedSum
             ? goal.position_tolerance / goal.characteristic_length
             : goal.angle_tolerance;
}

/// The goal in the pad plane seen from a start, as functions of the end angle.
class GoalSet {
 public:
  GoalSet(const Model& model, const Grasp& start, const Goal& goal)
      : goal_(goal),
        p_OF_(finger_in_object(start.X_HO)),
        theta_(start.X_HO.theta),
        nearest_(nearest_angle(goal, theta_)),
        is_number_(goal.theta && goal.theta_is == ThetaMeaning::kNumber),
        c_(model.c) {}

  /// Least of f over the angles of the goal set.
  template <class Function>
  double least(double slope, const Function& f) const {
    if (!goal_.theta) return scan({theta_ - kPi, theta_ + kPi}, slope, f);
    const double slack = slack_of_angle();
    if (is_number_) return scan({nearest_ - slack, nearest_ + slack}, slope, f);
    const double other = nearest_ + (nearest_ <= theta_ ? 2.0 * kPi : -2.0 * kPi);
    return std::min(scan({nearest_ - slack, nearest_ + slack}, slope, f),
                    scan({other - slack, other + slack}, slope, f));
  }

  /// Tolerance that is left for the position at an end angle [m].
  double position_slack(double theta) const {
    if (goal_.test != GoalTest::kWeightedSum || !goal_.theta) {
      return goal_.position_tolerance;
    }
    const double off =
        std::abs(is_number_ ? theta - nearest_ : wrapped(theta - *goal_.theta));
    return std::max(0.0, goal_.position_tolerance - goal_.characteristic_length * off);
  }

  /// The finger axis moves in O by at least this if the object ends at angle theta [m]:
  /// turning the hand about the finger axis takes O to X_HO = -R(theta) p_OF, and the
  /// rest of the way in H is as long as that of the finger axis in O.
  double least_path(double theta) const {
    const Vec2 turned = -rotated(theta, p_OF_);
    const double slack = position_slack(theta);
    const Vec2 off{goal_.x ? std::abs(turned.x() - *goal_.x) : 0.0,
                   goal_.y ? std::abs(turned.y() - *goal_.y) : 0.0};
    if (goal_.test == GoalTest::kWeightedSum) return std::max(0.0, off.norm() - slack);
    return std::hypot(std::max(0.0, off.x() - slack), std::max(0.0, off.y() - slack));
  }

  double distance() const {
    const double slope = p_OF_.norm() + goal_.characteristic_length + c_;
    const double bound = least(slope, [this](double theta) {
      return std::hypot(least_path(theta), c_ * (theta - theta_));
    });
    return std::max(0.0, bound);
  }

  bool fixes_place() const { return goal_.x && goal_.y; }

  /// Where the finger axis ends in O at this angle, if both coordinates are fixed.
  Vec2 end_place(double theta) const { return -rotated(-theta, {*goal_.x, *goal_.y}); }

  /// Greatest distance of a member of the goal set at this angle from `end_place` [m].
  double place_slack(double theta) const {
    const bool square = goal_.test == GoalTest::kPerCoordinate;
    return position_slack(theta) * (square ? std::numbers::sqrt2 : 1.0);
  }

  double slope_of_place() const {
    return std::hypot(*goal_.x, *goal_.y) + 2.0 * goal_.characteristic_length;
  }

  const Vec2& start_place() const { return p_OF_; }

  /// For a goal that fixes the place.
  WordGoal for_words() const {
    WordGoal goal;
    goal.place_H = {*goal_.x, *goal_.y};
    goal.any_turn = !goal_.theta;
    const double slack = slack_of_angle();
    goal.one_winding = is_number_;
    goal.turn_low = nearest_ - slack;
    goal.turn_high = nearest_ + slack;
    const bool square = goal_.test == GoalTest::kPerCoordinate;
    goal.place_slack = goal_.position_tolerance * (square ? std::numbers::sqrt2 : 1.0);
    if (goal_.test == GoalTest::kWeightedSum && goal_.theta) {
      goal.slack_per_turn = goal_.characteristic_length;
    }
    return goal;
  }

 private:
  template <class Function>
  static double scan(const AngleRange& range, double slope, const Function& f) {
    return least_over_angle(range.low, range.high, slope, kAccuracy, f);
  }

  /// Of an angle no more than half a turn: beyond it lies the next winding.
  double slack_of_angle() const {
    return is_number_ ? angle_slack(goal_) : std::min(angle_slack(goal_), kPi);
  }

  const Goal& goal_;
  Vec2 p_OF_;
  double theta_, nearest_;
  bool is_number_;
  double c_;
};

/// For an isotropic pad the friction force points along the motion and is F phi, phi
/// <= 1. |v| / phi <= kDiscDrag sqrt(|v|^2 + (c omega)^2): 1 for the ellipsoid, 3/2 for a
/// uniform disc (where the centre of rotation is near the finger axis), and a little more
/// for its quadrature.
constexpr double kDiscDrag = 1.6;

/// Least travel of a plan whose only placement is this contact; infinity if impossible.
///
/// Along any path of one contact the push force stays in its friction cone. For an edge
/// w = mu n -+ t of the dual cone: phi F w.e >= w.m g =: G at each instant, e = -dp/|dp|.
/// G >= 0: then w.e >= G/F, and summed over the path w.(p_0 - p_1) >= G/F |p_0 - p_1|.
/// G < 0 (gravity helps): w.e |dp| >= -|G|/F |dp|/phi, so w.(p_1 - p_0) <= |G|/F x
/// kDiscDrag x T.
double single_run_travel(const Model& model, const PushContact& contact,
                         const GoalSet& set) {
  double travel = 0.0;
  for (const double side : {1.0, -1.0}) {
    const Vec2 w = contact.mu * contact.n + side * contact.t;
    const double G = model.mass * w.dot(contact.g_O) / model.F;
    const double reach = w.norm() + std::max(0.0, G);
    // The least amount by which the edge is violated over the goal set.
    const double violation = set.least(reach * set.slope_of_place(), [&](double theta) {
      const Vec2 d = set.end_place(theta) - set.start_place();
      return w.dot(d) + std::max(0.0, G) * d.norm() - reach * set.place_slack(theta);
    });
    if (violation <= kAccuracy) continue;
    if (G >= 0.0) return std::numeric_limits<double>::infinity();
    travel = std::max(travel, violation / (-G * kDiscDrag));
  }
  return travel;
}

double in_plane_bound(const Model& model, const GoalSet& set, double distance) {
  const double length = longest_placement_length(model);
  const double straight = distance / length;
  const bool isotropic = model.region.is_isotropic() && model.region.is_fixed_in_hand();
  if (!isotropic || !set.fixes_place()) return 1.0 + straight;
  double bound = 2.0 + straight;
  for (const PushContact& contact : model.contacts) {
    const double travel = single_run_travel(model, contact, set);
    bound = std::min(bound, 1.0 + std::max(distance, travel) / length);
  }
  return bound;
}

/// Least roll that the goal asks for [m] of the rolling surface.
double roll_path(const Model& model, const Grasp& start, const Goal& goal) {
  if (!goal.psi) return 0.0;
  const double off = std::abs(wrapped(*goal.psi - start.psi)) - angle_slack(goal);
  return model.roll_radius * std::max(0.0, off);
}

double roll_cost(const Model& model, const Grasp& start, const Goal& goal) {
  const double roll = roll_path(model, start, goal);
  return roll > 0.0 ? 1.0 + roll / longest_placement_length(model) : 0.0;
}

/// Relative rounding that a claimed bound is granted.
constexpr double kAcceptance = 1e-6;

/// What is left open when the work ends depends on the target a little: so much of the
/// bound is given away that a proof with the bound itself as target finds it, too.
constexpr double kToProveAgain = 1e-3;

/// J beyond which nothing is proved: plans this dear turn many times, each whole turn has
/// a question of its own, and a plan file may say what it likes.
constexpr double kGreatestTarget = 50.0;

/// Rounding of a proof of several steps, relative.
constexpr double kProofRounding = 1e-7;

/// Bounds from the words of contacts, for one question.
class Prover {
 public:
  Prover(const Model& model, const Grasp& start, const Goal& goal, const Margin& margin)
      : roll_(roll_cost(model, start, goal)), slabs_(model, margin) {
    const GoalSet set(model, start, goal);
    question_.straight = set.distance();
    if (!set.fixes_place() || question_.straight <= 0.0) return;
    question_.p_OF = finger_in_object(start.X_HO);
    laws_ = run_laws(model, margin, question_.p_OF);
    if (laws_.empty()) return;
    scene_ = word_scene(model, laws_);
    question_.theta = start.X_HO.theta;
    question_.goal = set.for_words();
    question_.slabs = &slabs_;
  }
  Prover(const Prover&) = delete;
  Prover& operator=(const Prover&) = delete;

  /// A bound of at most `target`; 0 where the words of contacts say nothing. Counts
  /// `nodes` down.
  double prove(double target, std::int64_t& nodes, const WordVisitor& visit = {}) const {
    if (laws_.empty()) return 0.0;
    const double wanted =
        (std::min(target, kGreatestTarget) - roll_) * (1.0 + kProofRounding);
    return roll_ +
           word_bound(scene_, question_, wanted, nodes, visit) * (1.0 - kProofRounding);
  }

 private:
  double roll_;
  SlabTravel slabs_;
  RunLaws laws_;
  WordScene scene_;
  WordQuestion question_;
};

}  // namespace

double distance_to_goal(const Model& model, const Grasp& start, const Goal& goal) {
  return GoalSet(model, start, goal).distance();
}

double trivial_bound(const Model& model, const Grasp& start, const Goal& goal) {
  const double distance = GoalSet(model, start, goal).distance();
  const double bound =
      roll_cost(model, start, goal) +
      (distance > 0.0 ? 1.0 + distance / longest_placement_length(model) : 0.0);
  return bound == 0.0 && !reaches(goal, start) ? 1.0 : bound;
}

Goal goal_itself(const Goal& goal) {
  constexpr double kShare = 1e-3;
  Goal itself = goal;
  itself.position_tolerance *= kShare;
  itself.angle_tolerance *= kShare;
  return itself;
}

double guide_bound(const Model& model, const Grasp& start, const Goal& goal) {
  const GoalSet set(model, start, goal);
  const double distance = set.distance();
  double bound = roll_cost(model, start, goal);
  if (distance > 0.0) bound += in_plane_bound(model, set, distance);
  return bound == 0.0 && !reaches(goal, start) ? 1.0 : bound;
}

LowerBound lower_bound(const Model& model, const Grasp& start, const Goal& goal,
                       double cost, const BoundOptions& options) {
  const std::int64_t nodes = options.nodes;
  LowerBound bound{.value = trivial_bound(model, start, goal)};
  if (!(bound.value < cost / kGapAsked)) return bound;
  const Prover prover(model, start, goal, options.margin);
  for (const double target : {cost / kGapAsked, cost}) {
    if (!(bound.value < target) || bound.nodes >= nodes) break;
    std::int64_t left = nodes - bound.nodes;
    double proved = prover.prove(target, left);
    const bool done = proved >= target * (1.0 - kAcceptance);
    if (!done) proved -= kToProveAgain * target;
    bound.nodes = nodes - left;
    if (proved > bound.value + kAccuracy) {
      bound.is_trivial = false;
      bound.value = proved;
    }
    if (!done) break;
  }
  return bound;
}

void visit_words(const Model& model, const Grasp& start, const Goal& goal, double target,
                 const Margin& margin, std::int64_t& nodes,
                 const std::function<void(const WordNode&)>& visit) {
  Prover(model, start, goal, margin).prove(target, nodes, visit);
}

bool bound_holds(const Model& model, const Grasp& start, const Goal& goal, double claimed,
                 const BoundOptions& options) {
  std::int64_t nodes = options.nodes;
  const double accepted = claimed * (1.0 - kAcceptance);
  return trivial_bound(model, start, goal) >= accepted ||
         Prover(model, start, goal, options.margin).prove(claimed, nodes) >= accepted;
}

}  // namespace prehensile
