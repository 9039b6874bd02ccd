/// Which planners there are, what can be set of each, and which of OMPL's are refused.
/// The same in every build: what is not built in is known and said to be absent.
///
/// Names: `push` is our own; `motion-cone-tree`, `random-shooting` and `two-trees` are
/// ours, after others; `geometric::X` are OMPL's planners over places with exact steering
/// for their local planner, `control::X` its control planners with samplers that steer,
/// and `blind::X` the same with uniform random controls.
#pragma once

#include <string>
#include <vector>

#include "planner/planner.h"

namespace prehensile {

/// A number that can be set of a planner; of OMPL's planners mostly a parameter of the
/// same name.
struct PlannerOption {
  const char* name;
  double least, most;  ///< range of allowed values
  double value;        ///< unless set; found by bench_baselines --tune
  const char* about;
  bool whole = false;  ///< whole numbers only; 0 and 1 stand for no and yes
  bool in_L = false;   ///< a length as a multiple of L, longer side of the object
};

enum class PlannerFamily {
  kOwn,
  kBaseline,   ///< ours, after others; in every build
  kGeometric,  ///< OMPL's
  kControl,    ///< OMPL's, samplers that steer
  kBlind,      ///< OMPL's, uniform random controls
};

struct PlannerKind {
  std::string name;
  PlannerFamily family;
  std::string algorithm;  ///< name in OMPL, or the name
  std::vector<PlannerOption> options;
  /// Searches on after its first plan, until it has done ten times that work.
  bool improves = false;

  bool needs_ompl() const { return family >= PlannerFamily::kGeometric; }
};

/// All planners, our own first.
const std::vector<PlannerKind>& planner_catalogue();

/// nullptr if unknown.
const PlannerKind* find_planner(const std::string& name);

/// Why a planner cannot be used, or not with these settings, in one sentence that says
/// what can; empty if it can. Also knows those of OMPL that are refused.
std::string planner_fault(const std::string& planner, const PlannerSettings& settings);

/// The value of an option that the planner has, in its own unit.
double setting(const PlannerKind& kind, const PlannerSettings& settings,
               const std::string& option);

}  // namespace prehensile
