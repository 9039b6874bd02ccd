/// Replays a plan with the exact mechanics, in space where a push needs that, knowing
/// nothing of the search that made it.
#pragma once

#include <string>
#include <vector>

#include "planner/plan.h"

namespace prehensile {

struct ReplayOptions {
  TransitionOptions transition{.max_step = 0.025};  ///< half the step of planning
  double position_tolerance = 1e-4;  ///< [m] agreement of each pose with the plan's
  double angle_tolerance = 1e-3;     ///< [rad]
};

struct ReplayedPush {
  Transition transition;
  double position_error = kNan;  ///< [m] end pose against the plan's
  double angle_error = kNan;     ///< [rad], roll included
  double force_error = kNan;     ///< relative, greatest push force against the plan's
  double slack = kNan;           ///< robust slack found along the push
  bool agrees = false;
  std::string why;  ///< empty if it agrees
};

struct Replay {
  std::vector<ReplayedPush> pushes;
  bool starts_right = false;  ///< the first push starts at the scene's start
  bool connected = false;     ///< each push starts where the one before ended
  bool reaches_goal = false;  ///< the replayed end pose satisfies the goal
  std::string confinement;    ///< which limit or obstacle is not kept to; empty: all are
  bool costs_right = false;   ///< S, T and J as recomputed from the pushes
  bool bound_right = false;   ///< the lower bounds are proved again
  bool agrees = false;        ///< all of the above and every push
  std::string why;
  Grasp end;
  std::int64_t instants = 0;
};

Replay replay(const Model& model, const Plan& plan, const ReplayOptions& options = {});

}  // namespace prehensile
