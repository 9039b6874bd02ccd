/// One run: makes the problem, lets the planner loose on it, and verifies what it says.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/suite/problem_list.h"
#include "benchmarks/suite/run_record.h"
#include "planner/planner.h"

namespace prehensile::suite {

/// What stands behind a planner's name in a suite.
using Solve = std::function<Plan(const Model&, const PlanOptions&)>;
using PlannerTable = std::map<std::string, Solve>;

/// Every planner that `plan --planner` knows in this build.
PlannerTable planners_of_build();

std::vector<std::string> names(const PlannerTable& planners);

/// What the entry asks for, for a model and a seed.
PlanOptions plan_options(const PlannerEntry& entry, const Model& model, int seed);

/// Runs and verifies. Exceptions become statuses; what does not come back at all is the
/// business of worker_pool.h.
RunRecord run_one(const Suite& suite, const ProblemList& problems,
                  const PlannerTable& planners, const RunKey& key);

}  // namespace prehensile::suite
