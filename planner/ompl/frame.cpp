#include "planner/search/frame.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "planner/ompl/push_planner.h"
#include "planner/ompl/seeded_run.h"
#include "planner/ompl/solution.h"
#include "planner/ompl/stock_planners.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;

using Clock = std::chrono::steady_clock;

constexpr const char* kOwn = "push";

/// A planner that improves its plans gets this many times the work of its first
/// solution, and at least so many propagations.
constexpr std::int64_t kImprovement = 10;
constexpr std::int64_t kLeastImprovement = 2'000;

/// So many questions whether to end, without a single propagation between them, mean that
/// the planner will never push anything. (Some look through thousands of edges between
/// two motions, FMT* draws up to a hundred thousand states before its first.) Nor may it
/// ask more often than this for each propagation of its budget: AIT* may search for
/// milliseconds before it tries one motion.
constexpr std::int64_t kMostIdleTurns = 500'000;
constexpr std::int64_t kTurnsPerPropagation = 2;
constexpr std::int64_t kFreeTurns = 1000;
constexpr std::int64_t kMostBudget = std::int64_t{1} << 60;

/// A planner that has a plan and draws so many states without finding a motion worth a
/// look will find none.
constexpr std::int64_t kMostIdleStates = 3'000;

/// Ends a planner of OMPL: by work, by the stop flag, and by the clock only if the
/// options set a time limit.
class Ending {
 public:
  Ending(const PushProblem& problem, const PlannerKind& kind, const PlanOptions& options)
      : problem_(problem),
        options_(options),
        ends_after_first_(kind.improves && !options.improve),
        tells_by_goal_(kind.algorithm == "SST" || kind.algorithm == "LBTRRT"),
        most_turns_(kFreeTurns +
                    kTurnsPerPropagation * std::min(left(problem.work()), kMostBudget)),
        deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(options.time_limit))) {
    // Some tell of a solution when they have one, some put it into the problem, and two
    // keep it for themselves until the end.
    problem.definition()->setIntermediateSolutionCallback(
        [this](const ob::Planner*, const std::vector<const ob::State*>&, ob::Cost cost) {
          note_solution();
          if (ProgressMeter* meter = problem_.work().meter) meter->found(cost.value());
        });
  }
  ~Ending() { problem_.definition()->setIntermediateSolutionCallback({}); }
  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;

  bool operator()() {
    const Work& work = problem_.work();
    if (work.meter) work.meter->tick(work.done());
    return work.spent() || is_stopped() || is_late() || is_improved() || is_idle();
  }

  /// Ended because it went on without pushing anything.
  bool was_idle() const { return idle_; }

  bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }

 private:
  static std::int64_t left(const Work& work) { return work.budget - work.done(); }

  bool is_late() const { return options_.time_limit > 0.0 && Clock::now() >= deadline_; }

  void note_solution() {
    if (first_ < 0) first_ = problem_.work().propagations;
  }

  bool is_improved() {
    if (!ends_after_first_) return false;
    if (tells_by_goal_) {
      first_ = problem_.goal()->first_reached_at();
    } else if (first_ < 0 && problem_.definition()->hasExactSolution()) {
      note_solution();
    }
    return first_ >= 0 && problem_.work().propagations >=
                              std::max(kImprovement * first_, first_ + kLeastImprovement);
  }

  bool is_idle() {
    const std::int64_t states = problem_.steps()->states_seen();
    if (std::exchange(seen_, problem_.work().propagations) !=
        problem_.work().propagations) {
      idle_turns_ = 0;
      states_before_ = states;
    }
    idle_ = ++idle_turns_ > kMostIdleTurns || ++turns_ > most_turns_ ||
            (first_ >= 0 && states - states_before_ > kMostIdleStates);
    return idle_;
  }

  const PushProblem& problem_;
  const PlanOptions& options_;
  bool ends_after_first_;
  bool tells_by_goal_;
  std::int64_t most_turns_;
  std::int64_t turns_ = 0;
  Clock::time_point deadline_;
  std::int64_t first_ = -1;  // propagations at the first solution
  std::int64_t seen_ = -1;
  std::int64_t idle_turns_ = 0;
  std::int64_t states_before_ = 0;
  bool idle_ = false;
};

Plan run_own(const SearchModel& search, const Grasp& start, const Goal& goal,
             const PlanOptions& options, Work& work) {
  const PushProblem problem(search, start, goal, work);
  PushPlanner planner(problem, options);
  planner.setProblemDefinition(problem.definition());
  planner.setup();
  planner.solve_within_options();
  return planner.plan();
}

void explain(const std::string& why, PlanStatus status, Plan& plan) {
  plan.status = status;
  plan.message = plan.planner + ": " + why;
}

/// Takes over the exact solution, if there is one; an approximate one is none.
void conclude(const PushProblem& problem, const Ending& ending, Plan& plan) {
  const ob::ProblemDefinition& definition = *problem.definition();
  if (!definition.hasExactSolution()) {
    const std::string why = ending.was_idle() ? ", and it tried no more" : "";
    return explain("no exact solution after " + std::to_string(plan.propagations) +
                       " propagations" + why,
                   ending.is_stopped() ? PlanStatus::kStopped : PlanStatus::kBudgetSpent,
                   plan);
  }
  auto pushes = pushes_along(problem, *definition.getSolutionPath());
  if (!pushes) {
    return explain("its path did not stand the second look", PlanStatus::kBudgetSpent,
                   plan);
  }
  plan.pushes = std::move(*pushes);
  plan.status = plan.pushes.empty() ? PlanStatus::kNothingToDo : PlanStatus::kReachedGoal;
  if (!plan.pushes.empty()) plan.goal = plan.pushes.back().end;
}

Plan run_stock(const SearchModel& search, const Grasp& start, const Goal& goal,
               const PlanOptions& options, Work& work) {
  Plan plan{.start = start,
            .goal = start,
            .margin = search.margin,
            .planner = options.planner,
            .seed = options.seed};
  const PlannerKind* kind = find_planner(options.planner);
  if (kind == nullptr || !kind->needs_ompl()) {
    explain("no such planner", PlanStatus::kUnsupported, plan);
    return plan;
  }
  const SeededRun seeded(options.seed);
  const PushProblem problem(search, start, goal, work, meaning_for(kind->family));
  const ob::PlannerPtr planner = make_stock_planner(*kind, options.settings, problem);
  if (reaches(goal, start)) {
    explain("the start is a goal", PlanStatus::kNothingToDo, plan);
    return plan;
  }
  if (kind->family == PlannerFamily::kGeometric &&
      problem.goal()->maxSampleCount() == 0) {
    explain("no place of the goal is valid", PlanStatus::kBudgetSpent, plan);
    return plan;
  }
  const std::int64_t before = work.propagations;
  Ending ending(problem, *kind, options);
  planner->solve(ob::PlannerTerminationCondition([&ending] { return ending(); }));
  plan.propagations = work.propagations - before;
  conclude(problem, ending, plan);
  return plan;
}

/// A prism rolls from side to side: no coordinate to sample, but one push more, for a
/// plan in the pad plane.
Plan run_stock_and_roll(const SearchModel& search, const Grasp& start, const Goal& goal,
                        const PlanOptions& options, Work& work) {
  if (!search.model->prism || roll_needed(goal, start.psi) == 0.0) {
    return run_stock(search, start, goal, options, work);
  }
  Plan plan = run_stock(search, start, planar_goal(goal), options, work);
  if (plan.status == PlanStatus::kReachedGoal ||
      plan.status == PlanStatus::kNothingToDo) {
    plan.message.clear();
    conclude_search(search, goal, options, true, Limits(options, work), plan);
  }
  return plan;
}

}  // namespace

bool frame_is_built() { return true; }

std::vector<std::string> frame_planners() {
  std::vector<std::string> names = {kOwn};
  for (const PlannerKind& kind : planner_catalogue()) {
    if (kind.needs_ompl()) names.push_back(kind.name);
  }
  return names;
}

Plan solve_in_frame(const SearchModel& search, const Grasp& start, const Goal& goal,
                    const PlanOptions& options, Work& work) {
  return options.planner == kOwn ? run_own(search, start, goal, options, work)
                                 : run_stock_and_roll(search, start, goal, options, work);
}

}  // namespace prehensile
