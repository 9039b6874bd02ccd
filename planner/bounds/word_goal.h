/// The goal set in pieces of its end angle, for lower bounds. Internal to the planner.
#pragma once

#include "planner/bounds/run_bound.h"
#include "planner/bounds/word_node.h"

namespace prehensile {

/// The goal set as the bound sees it: both coordinates fixed.
struct WordGoal {
  Vec2 place_H = Vec2::Zero();             ///< (x, y) of X_HO [m]
  double turn_low = 0.0, turn_high = 0.0;  ///< [rad] of the angle of O in H, one winding
  bool any_turn = false;                   ///< the goal leaves the angle free
  bool one_winding = false;                ///< no other winding is a goal
  /// [m] greatest distance of the goal's place from place_H, and what of it is lost per
  /// radian off the middle of the turns.
  double place_slack = 0.0, slack_per_turn = 0.0;
};

class SlabTravel;

struct WordQuestion {
  Vec2 p_OF = Vec2::Zero();  ///< start [m]
  double theta = 0.0;        ///< [rad]
  WordGoal goal;
  double straight = 0.0;  ///< [m] least travel to the goal set whatever the contacts
  SlabTravel* slabs = nullptr;  ///< knows more of that, after some milliseconds
};

inline constexpr double kNarrowestTurn = 1e-3;  ///< [rad] of a piece that is halved

/// Puts the goal's place at the end of the node's chain, for turns in between.
void set_goal(const WordQuestion& question, double turn_low, double turn_high,
              WordNode& node);

/// The goal's places for these turns, as a run sees them.
GoalArc goal_arc(const WordQuestion& question, double turn_low, double turn_high);

/// All of the goal's places, whatever the winding, in short arcs.
std::vector<GoalArc> goal_arcs(const WordQuestion& question);

/// Ends of the pieces of every winding of the goal whose turn alone costs no more than
/// `travel` [m].
struct TurnPiece {
  double low = 0.0, high = 0.0;  ///< [rad]
};
std::vector<TurnPiece> goal_pieces(const WordScene& scene, const WordQuestion& question,
                                   double travel);

}  // namespace prehensile
