/// The planner: from a prepared scene to a certified plan, or a proof, or an honest "not
/// found within the budget".
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/plan.h"
#include "planner/progress.h"

namespace prehensile {

/// Options of a planner by name (catalogue.h); those that are not set have their default.
using PlannerSettings = std::map<std::string, double>;

struct PlanOptions {
  std::string planner = "push";  ///< see planner_names(); "push" is our own
  PlannerSettings settings;      ///< of this planner
  std::uint64_t seed = 1;
  std::int64_t budget =
      20'000'000;           ///< stick tests, and propagations of the other planners
  double time_limit = 0.0;  ///< [s]; 0: none. The only way in which the clock decides
  /// Plan for this box, doubled once if the exact check fails; unset: usual_margin().
  std::optional<Margin> margin;
  Promise promise = Promise::kMargin;  ///< what the margin is, for the plan's record
  /// Where no plan survives the margin, look for one that has none, then for one that
  /// survives a part of it, and say so. The usual margin, and each part, then have a
  /// quarter of the budget, or five million if that is more.
  bool nominal_if_needed = true;
  bool improve = false;  ///< search on, with the whole budget, after the first plan;
                         ///< of the others, those that can
  bool prove = true;     ///< look for a barrier where no plan survives the margin
  bool polish = true;    ///< shorten the plan found with NLopt, where built
  /// Share of its cost, >= 0, that a polished plan with a margin may cost more to lie off
  /// the border of that margin (NLopt, where built); 0: the cheapest, which mostly lies
  /// on it.
  double ease = 0.01;
  /// With a margin: end beside the goal, within its tolerances, where that is cheaper.
  /// Fewer members of the box then end at the goal. Without a margin plans always may.
  bool beside_goal = false;
  TransitionOptions transition;  ///< of the exact check
  /// Set by a signal handler: give up cleanly, with the best plan found so far.
  const std::atomic<bool>* stop = nullptr;
  ProgressCallback progress;  ///< told now and then how far the search is; may be empty
};

/// Names that PlanOptions::planner accepts in this build.
std::vector<std::string> planner_names();

/// Plans from the scene's start to its goal.
Plan plan_regrasp(const Model& model, const PlanOptions& options = {});

/// Whether a grasp satisfies the goal.
bool reaches(const Goal& goal, const Grasp& grasp);

/// Distance to the goal: 0 inside; per-coordinate test: worst ratio to its tolerance
/// minus 1; weighted sum: excess [m].
double goal_excess(const Goal& goal, const Grasp& grasp);

/// Verifies a proof of infeasibility from the model alone; shares no code with the
/// search. On false `why` says what does not hold.
bool verify(const Model& model, const Proof& proof, std::string* why = nullptr);

}  // namespace prehensile
