/// Plans as a robot executes them, by the exact mechanics alone: no code of the steering.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "planner/plan.h"
#include "planner/planner.h"
#include "primitives/transition.h"

namespace prehensile::testing {

inline double distance_between(const Grasp& a, const Grasp& b) {
  return std::hypot(a.X_HO.x - b.X_HO.x, a.X_HO.y - b.X_HO.y);
}

/// Why the push does not take the object from `start` to `end` sticking; empty if it
/// does.
inline std::string fault_in_execution(const Model& model, const Grasp& start,
                                      const Push& push, const Grasp& end) {
  const Transition done = apply(model, start, push);
  // Without a margin there may be a second motion; the exact check refuses such plans,
  // and it says nothing about directions.
  if (done.status == TransitionStatus::kAmbiguous) return {};
  if (!done.completed()) return std::string(name(done.status));
  if (std::holds_alternative<Roll>(push)) return {};
  if (done.slipped > 1e-6) return "slips";
  if (distance_between(done.end, end) > 1e-6) return "ends elsewhere";
  return std::abs(done.end.X_HO.theta - end.X_HO.theta) > 1e-4 ? "ends turned" : "";
}

/// How many pushes of a plan could also be done backwards, which tells how sharp the
/// test of directions is.
struct Directions {
  int pushes = 0;
  int reversible = 0;
};

/// Expects a chain of pushes, each done in its direction, from the start to the goal.
inline void expect_executable(const Model& model, const Plan& plan,
                              Directions& directions) {
  ASSERT_FALSE(plan.pushes.empty());
  Grasp at = model.scene.start;
  for (const PlannedPush& planned : plan.pushes) {
    EXPECT_LT(distance_between(at, planned.start), 1e-12);
    const std::string fault =
        fault_in_execution(model, planned.start, planned.push, planned.end);
    EXPECT_EQ(fault, "") << plan.planner << " seed " << plan.seed;
    at = planned.end;
    if (const auto* push = std::get_if<LinearPush>(&planned.push)) {
      LinearPush back = *push;
      back.e = -back.e;
      back.turn = -back.turn;
      ++directions.pushes;
      directions.reversible +=
          fault_in_execution(model, planned.end, back, planned.start).empty();
    }
  }
  EXPECT_TRUE(reaches(*model.scene.goal, at)) << plan.planner;
}

}  // namespace prehensile::testing
