/// The search frame: OMPL's planners, and our own as one of them, where OMPL is built in.
/// Names nothing of OMPL.
#pragma once

#include <string>
#include <vector>

#include "planner/planner.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// Whether OMPL is built in.
bool frame_is_built();

/// Names of the planners that the frame runs (catalogue.h): "push", our own, and OMPL's.
/// Empty if not built.
std::vector<std::string> frame_planners();

/// Runs the planner of `options` in OMPL's frame. The plan holds pushes with their start
/// and end poses, status and work; it is not checked with the exact mechanics yet.
Plan solve_in_frame(const SearchModel& search, const Grasp& start, const Goal& goal,
                    const PlanOptions& options, Work& work);

}  // namespace prehensile
