#include "planner/bounds/word_goal.h"

#include <algorithm>
#include <cmath>

#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kShortArc = 0.03;   // [rad]
constexpr double kWidestTurn = 0.5;  // [rad] of a first goal piece

/// Greatest distance of the goal's place from the nominal one at these turns [m].
double place_slack(const WordQuestion& question, double turn_low, double turn_high) {
  const WordGoal& goal = question.goal;
  const bool nearly_any = goal.turn_high - goal.turn_low > kPi;
  if (goal.slack_per_turn == 0.0 || nearly_any) return goal.place_slack;
  const double middle = 0.5 * (goal.turn_low + goal.turn_high) - question.theta;
  const double from = std::remainder(turn_low - middle, 2.0 * kPi);
  const double to = from + turn_high - turn_low;
  const double off = std::max({0.0, from, -to});
  return std::max(0.0, goal.place_slack - goal.slack_per_turn * off);
}

}  // namespace

// The finger axis ends in O at -R(-theta) place_H, an arc.
void set_goal(const WordQuestion& question, double turn_low, double turn_high,
              WordNode& node) {
  node.turn_low = turn_low;
  node.turn_high = turn_high;
  const double theta = question.theta + 0.5 * (turn_low + turn_high);
  const double half = 0.5 * (turn_high - turn_low);
  const Vec2 place = -rotated(-theta, question.goal.place_H);
  const Vec2 tangent = -perp(place);  // of the arc, per radian
  const double radius = place.norm();
  PointBox& box = node.box[node.points - 1];
  box.centre = place;
  node.goal_arc = half > kNarrowestTurn ? Vec2(half * tangent) : Vec2(Vec2::Zero());
  const double slack = place_slack(question, turn_low, turn_high);
  const double along = radius * half + slack;
  const double across = 0.5 * radius * half * half + slack;
  const Vec2 u = radius > 0.0 ? Vec2(tangent / radius) : Vec2(1.0, 0.0);
  box.half = {along * u, across * perp(u)};
}

GoalArc goal_arc(const WordQuestion& question, double turn_low, double turn_high) {
  const WordGoal& goal = question.goal;
  const double theta = question.theta + 0.5 * (turn_low + turn_high);
  const double half = 0.5 * (turn_high - turn_low);
  GoalArc arc;
  arc.centre = -rotated(-theta, goal.place_H);
  arc.arc = -half * perp(arc.centre);
  const double bulge = 0.5 * arc.centre.norm() * half * half;
  arc.slack.fill(bulge + goal.place_slack);
  if (goal.slack_per_turn == 0.0 || goal.turn_high - goal.turn_low > kPi) return arc;
  // What the angle is off is taken from what the place may be off.
  const double off =
      std::remainder(theta - 0.5 * (goal.turn_low + goal.turn_high), 2.0 * kPi);
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1.0 : 1.0;
    arc.slack[i] += side * goal.slack_per_turn * off;
    arc.slope[i] = side * goal.slack_per_turn * half;
  }
  return arc;
}

std::vector<GoalArc> goal_arcs(const WordQuestion& question) {
  const WordGoal& goal = question.goal;
  const double low = goal.any_turn ? -kPi : goal.turn_low - question.theta;
  const double high = goal.any_turn ? kPi : goal.turn_high - question.theta;
  const int count = 1 + static_cast<int>(std::min(2.0 * kPi, high - low) / kShortArc);
  std::vector<GoalArc> arcs;
  arcs.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    arcs.push_back(goal_arc(question, low + (high - low) * i / count,
                            low + (high - low) * (i + 1) / count));
  }
  return arcs;
}

std::vector<TurnPiece> goal_pieces(const WordScene& scene, const WordQuestion& question,
                                   double travel) {
  const double most = travel / scene.c;
  std::vector<TurnPiece> result;
  const auto add_pieces = [&](double low, double high) {
    low = std::max(low, -most);
    high = std::min(high, most);
    if (low > high) return;
    const int count = 1 + static_cast<int>((high - low) / kWidestTurn);
    for (int i = 0; i < count; ++i) {
      result.push_back(
          {low + (high - low) * i / count, low + (high - low) * (i + 1) / count});
    }
  };
  if (question.goal.any_turn) {
    add_pieces(-most, most);
    return result;
  }
  const double low = question.goal.turn_low - question.theta;
  const double high = question.goal.turn_high - question.theta;
  const int first = question.goal.one_winding
                        ? 0
                        : static_cast<int>(std::ceil((-most - high) / (2.0 * kPi)));
  const int last = question.goal.one_winding
                       ? 0
                       : static_cast<int>(std::floor((most - low) / (2.0 * kPi)));
  for (int k = first; k <= last; ++k)
    add_pieces(low + 2.0 * kPi * k, high + 2.0 * kPi * k);
  return result;
}

}  // namespace prehensile
