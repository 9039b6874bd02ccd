#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/pads/local_law.h"
#include "planner/pads/ring_pads.h"
#include "planner/pads/spread_pads.h"
#include "planner/proofs/barrier.h"
#include "planner/proofs/goal_cover.h"
#include "planner/proofs/turn_proof.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Squares that the object is covered with at first, along its longer side, and how often
/// each is cut into four.
constexpr int kSquaresPerSide = 16;
constexpr int kMostCuts = 9;

/// Ranges of directions at first, and how often each is halved.
constexpr int kRanges = 8;
constexpr int kMostHalvings = 10;

/// What a check may take: questions to the laws, and squares of the goal.
constexpr int kMostQuestions = 8'000'000;
constexpr int kMostGoalSquares = 800'000;

/// How often the square of the goal's places is cut into four.
constexpr int kMostGoalCuts = 8;

constexpr double kRounding = 1e-9;  // [m] of places

/// Squares of which it is told what breaks the bounds, at most.
constexpr std::size_t kMostBreaks = 60;

bool refuse(std::string* why, const char* text) {
  if (why) *why = text;
  return false;
}

struct Square {
  Vec2 middle;
  double half_edge;

  double reach() const { return std::numbers::sqrt2 * half_edge; }

  std::array<Vec2, 4> corners() const {
    const Vec2 x(half_edge, 0.0);
    const Vec2 y(0.0, half_edge);
    return {middle - x - y, middle + x - y, middle + x + y, middle - x + y};
  }

  Square quarter(int k) const {
    const double off = 0.5 * half_edge;
    return {middle + Vec2(k % 2 ? off : -off, k / 2 ? off : -off), off};
  }
};

/// Whether a test holds for all of a square, which is cut into four where it does not, at
/// most so often.
template <class Test>
bool holds_all_over(const Square& square, int cuts, const Test& test) {
  if (test(square)) return true;
  if (cuts == 0) return false;
  for (int k = 0; k < 4; ++k) {
    if (!holds_all_over(square.quarter(k), cuts - 1, test)) return false;
  }
  return true;
}

/// No way from the start to the goal comes to places up to `around` from this one.
bool is_out_of_reach(const Proof& proof, const Vec2& place, double around) {
  return (!proof.region.empty() && depth_in_region(proof.region, place) < -around) ||
         (!proof.turn->beyond.empty() &&
          depth_in_region(proof.turn->beyond, place) > around);
}

/// Whether no push breaks the bounds on the turn at the places between the regions.
class TurnLaw {
 public:
  TurnLaw(const Model& model, const Proof& proof)
      : model_(model),
        proof_(proof),
        start_(finger_in_object(model.scene.start.X_HO)),
        clips_(has_clipped_discs(model)),
        law_(clips_ ? LocalLaw::of_whole_discs(model) : LocalLaw(model)) {}

  bool is_known() const { return law_.is_known(); }

  /// `breaks` as of verify_turn.
  bool holds(TurnBreaks* breaks) {
    Vec2 low = model_.pad_face.front();
    Vec2 high = low;
    for (const Vec2& vertex : model_.pad_face) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
    const double half_edge = 0.5 * (high - low).maxCoeff() / kSquaresPerSide;
    bool all = true;
    for (int i = 0; i < kSquaresPerSide; ++i) {
      for (int j = 0; j < kSquaresPerSide; ++j) {
        const Vec2 middle = low + half_edge * Vec2(2 * i + 1, 2 * j + 1);
        const Square square{middle, half_edge};
        if (holds_all_over(square, kMostCuts,
                           [&](const Square& part) { return hold_in(part); })) {
          continue;
        }
        all = false;
        if (!breaks || !broken_ || breaks->pushes.size() == kMostBreaks) return false;
        breaks->pushes.push_back(*broken_);
        broken_.reset();
      }
    }
    return all;
  }

 private:
  bool hold_in(const Square& square) {
    return is_beside(square) ||
           (is_whole(square) && no_contact_breaks_them(square.corners()));
  }

  bool is_beside(const Square& square) const {
    return depth_inside(model_.pad_face, square.middle) < -square.reach() ||
           is_out_of_reach(proof_, square.middle, square.reach());
  }

  bool is_whole(const Square& square) const {
    return !clips_ || model_.region.whole_margin(pose_from_finger(square.middle, 0.0)) >=
                          square.reach();
  }

  bool no_contact_breaks_them(const std::array<Vec2, 4>& corners) {
    for (int k = 0; k < static_cast<int>(model_.contacts.size()); ++k) {
      for (int i = 0; i < kRanges; ++i) {
        const double half = 0.5 * kTurn / kRanges;
        if (!hold_for(k, corners, 2.0 * half * i, half, kMostHalvings)) return false;
      }
    }
    return true;
  }

  /// For one contact, and directions whose angle is within half_angle of `angle`.
  bool hold_for(int contact, const std::array<Vec2, 4>& corners, double angle,
                double half_angle, int halvings) {
    if (++asked_ > kMostQuestions) return false;
    const DirectionSpan directions{rotated(angle, Vec2(1.0, 0.0)), half_angle};
    const auto is_within = [&](const TurnRate& bound, double sense) {
      const double most = law_.most_turn(contact, corners, directions, sense);
      return std::ranges::all_of(corners, [&](const Vec2& corner) {
        const Vec2 rate = bound.at(corner - start_);
        return most <= sense * rate.dot(directions.middle) - half_angle * rate.norm();
      });
    };
    if (is_within(proof_.turn->most, 1.0) && is_within(proof_.turn->least, -1.0)) {
      return true;
    }
    if (halvings == 0) {
      broken_ = {0.5 * (corners[0] + corners[2]), directions,
                 law_.most_turn(contact, corners, directions, 1.0),
                 -law_.most_turn(contact, corners, directions, -1.0)};
      return false;
    }
    const double half = 0.5 * half_angle;
    return hold_for(contact, corners, angle - half, half, halvings - 1) &&
           hold_for(contact, corners, angle + half, half, halvings - 1);
  }

  const Model& model_;
  const Proof& proof_;
  Vec2 start_;
  bool clips_;
  LocalLaw law_;
  int asked_ = 0;
  std::optional<TurnBreaks::Push>
      broken_;  // where the bounds are, that was looked at last
};

/// Places of the goal at some angle, as squares about its own in the hand.
class GoalAngle {
 public:
  /// `looked_at` counts the squares.
  GoalAngle(const Model& model, const Proof& proof, double theta, double half_step,
            int& looked_at)
      : model_(model),
        proof_(proof),
        theta_(theta),
        half_step_(half_step),
        looked_at_(looked_at) {}

  bool excludes(const Square& square) {
    if (++looked_at_ > kMostGoalSquares) return false;
    const Goal& goal = *model_.scene.goal;
    const double around =
        square.reach() + half_step_ * Vec2(*goal.x, *goal.y).norm() + kRounding;
    const Vec2 place = goal_place(goal, theta_) + rotated(-theta_, square.middle);
    if (!is_allowed(place, around) || is_out_of_reach(proof_, place, around)) return true;
    allowed_ = place;
    return false;
  }

  /// The place that was not excluded last.
  const Vec2& allowed() const { return allowed_; }

 private:
  /// Whether the bounds allow the angle, some whole turns aside, up to `around` from a
  /// place.
  bool is_allowed(const Vec2& place, double around) const {
    const PlanarPose& start = model_.scene.start.X_HO;
    const Vec2 way = place - finger_in_object(start);
    const auto bound = [&](const TurnRate& rate, double sense) {
      const double steepest =
          rate.at(way).norm() + std::numbers::sqrt2 * around * rate.bend.norm();
      return (rate.along(way) + sense * around * steepest) / model_.c +
             sense * half_step_;
    };
    const double low = bound(proof_.turn->least, -1.0);
    const double high = bound(proof_.turn->most, 1.0);
    double wanted = theta_ - start.theta;
    if (model_.scene.goal->theta_is == ThetaMeaning::kAngle) {
      wanted += kTurn * std::ceil((low - wanted) / kTurn);
    }
    return wanted >= low && wanted <= high;
  }

  const Model& model_;
  const Proof& proof_;
  double theta_, half_step_;
  int& looked_at_;
  Vec2 allowed_ = Vec2::Zero();
};

/// Whether no pose of the goal set with a place between the regions has an angle that the
/// bounds allow.
bool turn_excludes_goal(const Model& model, const Proof& proof, TurnBreaks* breaks) {
  const Goal& goal = *model.scene.goal;
  int looked_at = 0;
  bool all = true;
  for_all_goal_angles(goal, [&](double theta, double half_step) {
    GoalAngle angle(model, proof, theta, half_step, looked_at);
    if (holds_all_over({Vec2::Zero(), goal.position_tolerance}, kMostGoalCuts,
                       [&](const Square& part) { return angle.excludes(part); })) {
      return true;
    }
    all = false;
    if (!breaks || looked_at > kMostGoalSquares) return false;
    breaks->ends.push_back(angle.allowed());
    return true;
  });
  return all;
}

}  // namespace

bool verify_turn(const Model& model, const Proof& proof, std::string* why,
                 TurnBreaks* breaks) {
  const Goal& goal = *model.scene.goal;
  if (!goal.x || !goal.y || !goal.theta) {
    return refuse(why, "the goal leaves a coordinate free");
  }
  if (!proof.turn) return refuse(why, "there are no bounds on the turn");
  const auto is_finite = [](const TurnRate& rate) {
    return rate.at_start.allFinite() && rate.bend.allFinite();
  };
  if (!is_finite(proof.turn->most) || !is_finite(proof.turn->least)) {
    return refuse(why, "a bound on the turn is not finite");
  }
  TurnLaw law(model, proof);
  if (!law.is_known()) {
    return refuse(why, "the friction of these pads is not known at every angle");
  }
  if (!proof.region.empty()) {
    if (!is_never_left(model, proof.region, why)) return false;
    const Vec2 start = finger_in_object(model.scene.start.X_HO);
    if (depth_in_region(proof.region, start) <= 0.0) {
      return refuse(why, "the start is not in the region");
    }
  }
  if (!proof.turn->beyond.empty()) {
    if (!is_never_left(model, proof.turn->beyond, why)) return false;
    if (!goal_is_outside(proof.turn->beyond, goal)) {
      return refuse(why, "a pose of the goal is in the region beyond");
    }
  }
  if (!turn_excludes_goal(model, proof, breaks)) {
    return refuse(why, "the bounds on the turn allow a pose of the goal");
  }
  return law.holds(breaks) ||
         refuse(why, "a push may turn the object by more, or by less");
}

}  // namespace prehensile
