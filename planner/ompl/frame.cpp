#include "planner/frame.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "planner/ompl/push_planner.h"
#include "planner/ompl/solution.h"
#include "planner/ompl/stock_planners.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;

using Clock = std::chrono::steady_clock;

/// A planner that improves until stopped gets this many times the work of its first
/// solution, and at least so many propagations.
constexpr std::int64_t kImprovement = 10;
constexpr std::int64_t kLeastImprovement = 10'000;

/// So many questions whether to end, without a single propagation between them, mean
/// that the planner will never push anything.
constexpr std::int64_t kMostIdleTurns = 10'000;

/// OMPL's seeds are never 0 and have 32 bits; neighbouring seeds give unrelated streams.
std::uint_fast32_t ompl_seed(std::uint64_t seed) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32) | 1U;
}

/// While it lives, OMPL's random numbers follow from the seed and its log is quiet.
///
/// Both belong to the whole process in OMPL, so one random planner runs at a time. Every
/// generator that OMPL makes takes its seed from one sequence; `setSeed` starts that
/// sequence again. Once a generator exists OMPL also logs an error saying that this is
/// useless, which holds for generators that exist already: here all of them are made
/// later.
class SeededRun {
 public:
  explicit SeededRun(std::uint64_t seed)
      : lock_(one_at_a_time()), log_(ompl::msg::getOutputHandler()) {
    ompl::msg::noOutputHandler();
    ompl::RNG::setSeed(ompl_seed(seed));
  }
  ~SeededRun() { ompl::msg::useOutputHandler(log_); }
  SeededRun(const SeededRun&) = delete;
  SeededRun& operator=(const SeededRun&) = delete;

 private:
  static std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  ompl::msg::OutputHandler* log_;
};

/// Ends a planner of OMPL: by work, by the stop flag, and by the clock only if the
/// options set a time limit.
class Ending {
 public:
  Ending(const PushProblem& problem, const PlanOptions& options)
      : problem_(problem),
        options_(options),
        improves_(improves_until_stopped(options.planner)),
        deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(options.time_limit))) {
  }

  bool operator()() {
    return problem_.work().spent() || is_stopped() || is_late() || is_improved() ||
           is_idle();
  }

  bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }

 private:
  bool is_late() const { return options_.time_limit > 0.0 && Clock::now() >= deadline_; }

  bool is_improved() const {
    const std::int64_t first = problem_.goal()->first_reached_at();
    return improves_ && first >= 0 &&
           problem_.work().propagations >=
               std::max(kImprovement * first, first + kLeastImprovement);
  }

  bool is_idle() {
    const bool progressed = std::exchange(seen_, problem_.work().propagations) !=
                            problem_.work().propagations;
    idle_turns_ = progressed ? 0 : idle_turns_ + 1;
    return idle_turns_ > kMostIdleTurns;
  }

  const PushProblem& problem_;
  const PlanOptions& options_;
  bool improves_;
  Clock::time_point deadline_;
  std::int64_t seen_ = -1;
  std::int64_t idle_turns_ = 0;
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
    return explain(
        "no exact solution after " + std::to_string(plan.propagations) + " propagations",
        ending.is_stopped() ? PlanStatus::kStopped : PlanStatus::kBudgetSpent, plan);
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
  const SeededRun seeded(options.seed);
  const PushProblem problem(search, start, goal, work);
  const ob::PlannerPtr planner = make_stock_planner(options.planner, problem);
  if (!planner) {
    explain("no such planner", PlanStatus::kUnsupported, plan);
    return plan;
  }
  if (reaches(goal, start)) {
    explain("the start is a goal", PlanStatus::kNothingToDo, plan);
    return plan;
  }
  const std::int64_t before = work.propagations;
  Ending ending(problem, options);
  planner->solve(ob::PlannerTerminationCondition([&ending] { return ending(); }));
  plan.propagations = work.propagations - before;
  conclude(problem, ending, plan);
  return plan;
}

}  // namespace

bool frame_is_built() { return true; }

std::vector<std::string> frame_planners() {
  std::vector<std::string> names = stock_planner_names();
  names.insert(names.begin(), "push");
  return names;
}

Plan solve_in_frame(const SearchModel& search, const Grasp& start, const Goal& goal,
                    const PlanOptions& options, Work& work) {
  return options.planner == "push" ? run_own(search, start, goal, options, work)
                                   : run_stock(search, start, goal, options, work);
}

}  // namespace prehensile
