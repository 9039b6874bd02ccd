#include "planner/baselines/baselines.h"

#include "planner/chains/shorten.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

std::optional<std::vector<Move>> moves_by(const BaselineQuestion& question,
                                          const Limits& limits, Work& work) {
  if (question.search.contacts.empty()) return std::nullopt;
  const std::string& algorithm = question.kind.algorithm;
  if (algorithm == "random-shooting") return shoot_at_random(question, limits, work);
  if (algorithm == "two-trees") return grow_two_trees(question, limits, work);
  return grow_cone_tree(question, limits, work);
}

}  // namespace

Plan search_by_baseline(const SearchModel& search, const Grasp& start, const Goal& goal,
                        const PlanOptions& options, Work& work) {
  Plan plan = blank_plan(search, start, options);
  const Limits limits(options, work);
  const Goal planar = planar_goal(goal);
  const PlannerKind& kind = *find_planner(options.planner);
  bool in_plane = reaches(planar, start);
  if (!in_plane) {
    const auto moves = moves_by(
        {search, start, planar, kind, options.settings, options.seed}, limits, work);
    in_plane = moves.has_value();
    if (moves) {
      for (const Move& move : joined_moves(search, *moves)) {
        append_move(search, move, plan);
      }
    }
  }
  conclude_search(search, goal, options, in_plane, limits, plan);
  plan.stick_tests = work.stick_tests;
  plan.propagations = work.propagations;
  return plan;
}

}  // namespace prehensile
