/// Planners after others, with our mechanics, steering, work counts and checks, to
/// compare with and to fall back on. They need no third party. Internal to the planner.
#pragma once

#include <optional>
#include <vector>

#include "planner/catalogue.h"
#include "planner/steering/limits.h"
#include "planner/steering/push_steps.h"

namespace prehensile {

/// What a baseline is asked: from the start to the goal, which fixes no roll angle.
struct BaselineQuestion {
  const SearchModel& search;
  const Grasp& start;
  const Goal& goal;
  const PlannerKind& kind;
  const PlannerSettings& settings;
  std::uint64_t seed;

  double setting(const char* option) const {
    return prehensile::setting(kind, settings, option);
  }
};

/// Motion-cone tree (Chavan-Dafle, Holladay, Rodriguez, "In-Hand Manipulation via Motion
/// Cones", RSS 2018): a tree from the start, extended by steps of equal length towards
/// random poses. A step in no motion cone is projected on the closest; a transition test
/// (T-RRT: Jaillet, Cortes, Simeon 2010) prefers poses near the goal; parents are chosen,
/// and neighbours rewired, by the published cost, 0.1 for a push by the parent's pusher
/// and 1 otherwise. Known from the publication: loop, unit step, projection, cost; its
/// step length, metric, constants of the test, and whether it rewires: not, they are
/// options. Ends with the first plan. Moves are in order; nothing where a limit ends it.
std::optional<std::vector<Move>> grow_cone_tree(const BaselineQuestion& question,
                                                const Limits& limits, Work& work);

/// Random shooting: sequences of random pushes from the start; before each push the goal
/// is tried. Ends with the first plan.
std::optional<std::vector<Move>> shoot_at_random(const BaselineQuestion& question,
                                                 const Limits& limits, Work& work);

/// Two trees, one from the start along pushes and one from the goals against them: random
/// pushes towards random poses, and every new pose joined with those of the other tree by
/// one push (after RRT-Connect: Kuffner, LaValle 2000; no push is ever reversed). Ends
/// with the first plan.
std::optional<std::vector<Move>> grow_two_trees(const BaselineQuestion& question,
                                                const Limits& limits, Work& work);

/// Runs the baseline that the options name and adds a roll where the goal wants one.
/// Status as of search_pushes. Pushes are not checked with the exact mechanics yet.
Plan search_by_baseline(const SearchModel& search, const Grasp& start, const Goal& goal,
                        const PlanOptions& options, Work& work);

}  // namespace prehensile
