/// Lower bounds from branch and bound over the words of contacts and their switch points.
/// Internal to the planner.
#pragma once

#include <cstdint>

#include "planner/word_node.h"

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

struct WordQuestion {
  Vec2 p_OF = Vec2::Zero();  ///< start [m]
  double theta = 0.0;        ///< [rad]
  WordGoal goal;
  double straight = 0.0;  ///< [m] least travel to the goal set whatever the contacts
};

/// A bound on J over all plans in the pad plane that is at most `target`: equal to it if
/// that is proved. `nodes` counts down; no more work is done at 0, and what is left open
/// counts with the bound that it has.
double word_bound(const WordScene& scene, const WordQuestion& question, double target,
                  std::int64_t& nodes);

/// The scene of a model; `laws` must outlive it.
WordScene word_scene(const Model& model, const RunLaws& laws);

}  // namespace prehensile
