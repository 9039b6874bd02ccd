/// For users of OMPL: a regrasp as a state space, a space information with propagator,
/// samplers and validators, a problem definition, and our push planner, all of them
/// ordinary OMPL objects. The only public header that needs OMPL; present where OMPL is
/// built in.
///
///   const Model model = prepare(scene);
///   const SearchModel search = prepare_search(model, Margin{});
///   Work work{.budget = 1'000'000};
///   const PushProblem problem(search, scene.start, *scene.goal, work);
///   ompl::control::PDST planner(problem.space_information());  // or PushPlanner
///   planner.setProblemDefinition(problem.definition());
///   planner.setup();
///   planner.solve(ompl::base::timedPlannerTerminationCondition(1.0));
///   if (problem.definition()->hasExactSolution()) {
///     auto pushes = pushes_along(problem, *problem.definition()->getSolutionPath());
///   }
#pragma once

#include "planner/ompl/push_planner.h"
#include "planner/ompl/push_problem.h"
#include "planner/ompl/solution.h"
