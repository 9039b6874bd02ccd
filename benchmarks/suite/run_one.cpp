#include "benchmarks/suite/run_one.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <new>

#include "io/document.h"
#include "planner/checks/replay.h"
#include "primitives/uncertainty.h"

namespace prehensile::suite {
namespace {

/// [s] of this thread: what others do on the machine hardly counts in it.
double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_time() {
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string digest_of_pushes(const Plan& plan) {
  if (plan.pushes.empty()) return {};
  std::string text;
  const auto add = [&text](double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.17g ", value);
    text += buffer;
  };
  for (const PlannedPush& planned : plan.pushes) {
    text += std::to_string(planned.push.index()) + ' ';
    for (const Grasp& grasp : {planned.start, planned.end}) {
      for (const double value :
           {grasp.X_HO.x, grasp.X_HO.y, grasp.X_HO.theta, grasp.psi}) {
        add(value);
      }
    }
    add(planned.push_force);
  }
  return internal::digest_of(text);
}

void add_plan(const Plan& plan, const Model& model, RunRecord& record) {
  record.stick_tests = plan.stick_tests;
  record.transitions = plan.propagations;
  record.instants = plan.instants;
  record.bound = plan.lower_bound;
  record.message = plan.message;
  if (!plan.usable()) return;
  record.pushes = static_cast<std::int64_t>(plan.pushes.size());
  record.switches = static_cast<std::int64_t>(plan.placements);
  record.travel = plan.travel;
  record.cost = plan.cost;
  // A plan without pushes costs nothing and has no gap.
  record.gap = plan.pushes.empty() ? 0.0 : plan.gap();
  record.bound_at_goal = plan.bound_at_goal.value_or(kNothing);
  for (const PlannedPush& push : plan.pushes) {
    record.margin = std::fmin(record.margin, push.slack);
  }
  record.plan = digest_of_pushes(plan);
  record.part_of_margin = plan.promise == Promise::kPartOfMargin;
  record.nominal_only = plan.promise == Promise::kNominalOnly;
  if (plan.pushes.empty() && !reaches(*model.scene.goal, model.scene.start)) {
    record.message = "claims that there is nothing to do";
  }
}

/// The planner's word, put to code that it does not share.
void verify_plan(const Model& model, const Plan& plan, RunRecord& record) {
  const double begin = cpu_time();
  std::string why;
  switch (plan.status) {
    case PlanStatus::kReachedGoal: {
      const Replay done = replay(model, plan);
      record.certified = done.agrees;
      record.check_instants = done.instants;
      why = done.why;
      record.status = RunStatus::kSolved;
      break;
    }
    case PlanStatus::kNothingToDo:
      record.certified = reaches(*model.scene.goal, model.scene.start);
      why = "claims that there is nothing to do";
      record.status = RunStatus::kSolved;
      break;
    case PlanStatus::kInfeasible:
      record.certified = verify(model, plan.proof, &why);
      record.status = RunStatus::kInfeasible;
      break;
    case PlanStatus::kUnsupported:
      record.status = RunStatus::kUnsupported;
      break;
    case PlanStatus::kNotRun:
    case PlanStatus::kBudgetSpent:
    case PlanStatus::kStopped:
      record.status = RunStatus::kUndecided;
      break;
  }
  if (record.decided() && !record.certified) {
    record.status = RunStatus::kRefuted;
    record.message = why;
  }
  record.check_time = cpu_time() - begin;
}

/// What runs in which order; throws what the parts throw.
void run(const Suite& suite, const ProblemList& problems, const PlannerTable& planners,
         const RunKey& key, RunRecord& record) {
  double begin = cpu_time();
  record.status = RunStatus::kNoProblem;
  const Scene scene = problems.scene(key.family, key.problem);
  const Model model = prepare(scene);
  record.setup_time = cpu_time() - begin;
  record.scene = internal::digest_of(scene_to_yaml(scene));
  record.constructed = problems.is_constructed(key.family);

  record.status = RunStatus::kFault;
  const PlannerEntry& entry = suite.planners[static_cast<std::size_t>(key.planner)];
  PlanOptions options = plan_options(entry, model, key.seed);
  begin = cpu_time();
  options.progress = [&](const SearchProgress& progress) {
    record.progress.push_back({cpu_time() - begin, progress.best_cost});
  };
  const double begin_wall = wall_time();
  const Plan plan = planners.at(entry.planner)(model, options);
  record.time = cpu_time() - begin;
  record.wall_time = wall_time() - begin_wall;
  if (plan.usable()) record.progress.push_back({record.time, plan.cost});

  add_plan(plan, model, record);
  verify_plan(model, plan, record);
}

}  // namespace

PlannerTable planners_of_build() {
  PlannerTable planners;
  for (const std::string& name : planner_names()) planners[name] = plan_regrasp;
  return planners;
}

std::vector<std::string> names(const PlannerTable& planners) {
  std::vector<std::string> out;
  out.reserve(planners.size());
  for (const auto& [name, solve] : planners) out.push_back(name);
  return out;
}

PlanOptions plan_options(const PlannerEntry& entry, const Model& model, int seed) {
  PlanOptions options;
  options.planner = entry.planner;
  options.settings = entry.settings;
  options.seed = static_cast<std::uint64_t>(seed);
  options.budget = static_cast<std::int64_t>(entry.budget);
  options.time_limit = entry.time_limit;
  options.margin =
      entry.margin > 0.0 ? usual_margin(model).scaled(entry.margin) : Margin::none();
  options.improve = entry.until == SearchUntil::kBudget;
  options.polish = entry.polish;
  return options;
}

RunRecord run_one(const Suite& suite, const ProblemList& problems,
                  const PlannerTable& planners, const RunKey& key) {
  RunRecord record;
  record.host = host_name();
  try {
    run(suite, problems, planners, key, record);
  } catch (const std::bad_alloc&) {
    record.status = RunStatus::kOutOfMemory;
    record.certified = false;
    record.message = "the planner ran out of memory";
  } catch (const std::exception& fault) {
    record.certified = false;
    record.message = fault.what();  // the status says what was going on
  }
  return record;
}

}  // namespace prehensile::suite
