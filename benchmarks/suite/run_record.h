/// One row of the results: what one planner did with one problem.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace prehensile::suite {

/// How a run ended. "Verified" is the word of code that the planner does not share: a
/// replay with the exact mechanics at half the step, or the check of a proof.
enum class RunStatus {
  kSolved,       ///< a plan, verified
  kInfeasible,   ///< no plan exists, verified
  kUndecided,    ///< neither, within the budget or the planner's own time limit
  kUnsupported,  ///< the planner does not do what the scene asks for
  kRefuted,      ///< the planner claims a plan or a proof that does not verify
  kTimeout,      ///< killed at the time limit of the suite
  kOutOfMemory,  ///< ended at the memory limit of the suite
  kCrashed,      ///< ended by a signal, or without a word
  kFault,        ///< ended by an exception
  kNoProblem     ///< the suite gives no problem here; the planner did not run
};
inline constexpr std::array<std::string_view, 10> kRunStatusNames = {
    "solved",  "infeasible",    "undecided", "unsupported", "refuted",
    "timeout", "out_of_memory", "crashed",   "fault",       "no_problem"};
inline std::string_view name(RunStatus status) {
  return kRunStatusNames[static_cast<std::size_t>(status)];
}

/// Which run: indices as in the suite, `seed` and `repetition` from 1.
struct RunKey {
  int family = 0;
  int problem = 0;
  int planner = 0;
  int seed = 1;
  int repetition = 1;

  friend bool operator==(const RunKey&, const RunKey&) = default;
  friend bool operator<(const RunKey& a, const RunKey& b) {
    return std::tie(a.family, a.problem, a.planner, a.seed, a.repetition) <
           std::tie(b.family, b.problem, b.planner, b.seed, b.repetition);
  }
};

/// The best known at a time of the search.
struct ProgressPoint {
  double time = 0.0;       ///< [s] processor time since the search began
  double best_cost = 0.0;  ///< J; NaN: none yet
};

inline constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// NaN and -1: not known.
struct RunRecord {
  RunStatus status = RunStatus::kCrashed;
  bool certified = false;            ///< its plan or its proof is verified
  bool constructed = false;          ///< a plan is known to exist
  bool part_of_margin = false;       ///< solved, with a part of the margin asked for
  bool nominal_only = false;         ///< solved, with none of it
  double time = kNothing;            ///< [s] processor time of planning
  double wall_time = kNothing;       ///< [s] of planning
  double setup_time = kNothing;      ///< [s] processor time of making the problem
  double check_time = kNothing;      ///< [s] processor time of verifying
  std::int64_t stick_tests = -1;     ///< work of our planner
  std::int64_t transitions = -1;     ///< work of OMPL's planners
  std::int64_t instants = -1;        ///< exact mechanics calls of the planner
  std::int64_t check_instants = -1;  ///< likewise of verifying
  std::int64_t pushes = -1;
  std::int64_t switches = -1;       ///< pusher placements
  double travel = kNothing;         ///< [m]
  double cost = kNothing;           ///< J
  double bound = kNothing;          ///< on J
  double gap = kNothing;            ///< (J - bound) / bound
  double bound_at_goal = kNothing;  ///< of plans that end at the goal itself, as this one
  double margin = kNothing;         ///< least slack over all pushes
  double memory = kNothing;         ///< [MB] most that the process had
  int signal = 0;                   ///< that ended it; 0: none
  std::string message;  ///< of the planner, the verifier or the system; one line
  std::string scene;    ///< digest of the problem
  std::string plan;     ///< digest of the plan's pushes
  std::string host;
  std::vector<ProgressPoint> progress;

  bool solved() const { return status == RunStatus::kSolved; }
  bool decided() const { return solved() || status == RunStatus::kInfeasible; }
};

/// The columns of a record: f(name, member). The one list from which table, pipe, log and
/// CSV are made. `status` and the progress are not in it.
template <typename Record, typename F>
void visit_columns(Record& r, F&& f) {
  f("certified", r.certified);
  f("constructed", r.constructed);
  f("part_of_margin", r.part_of_margin);
  f("nominal_only", r.nominal_only);
  f("time", r.time);
  f("wall_time", r.wall_time);
  f("setup_time", r.setup_time);
  f("check_time", r.check_time);
  f("stick_tests", r.stick_tests);
  f("transitions", r.transitions);
  f("instants", r.instants);
  f("check_instants", r.check_instants);
  f("pushes", r.pushes);
  f("switches", r.switches);
  f("travel", r.travel);
  f("cost", r.cost);
  f("bound", r.bound);
  f("gap", r.gap);
  f("bound_at_goal", r.bound_at_goal);
  f("margin", r.margin);
  f("memory", r.memory);
  f("signal", r.signal);
  f("message", r.message);
  f("scene", r.scene);
  f("plan", r.plan);
  f("host", r.host);
}

/// Columns that differ from run to run of the same thing.
inline bool is_measurement(std::string_view column) {
  return column.ends_with("time") || column == "memory" || column == "host";
}

/// Of this machine, for `host`.
std::string host_name();

/// A record as text, for a pipe; reading back gives the same record.
std::string to_text(const RunRecord& record);

/// False, and the record is not to be used, unless the text is a whole record.
bool from_text(const std::string& text, RunRecord& record);

}  // namespace prehensile::suite
