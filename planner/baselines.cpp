#include "planner/baselines.h"

#include <limits>

#include "planner/chain.h"
#include "planner/push_search.h"

namespace prehensile {
namespace {

/// Directions in (p_OF, c theta) closer than this are one [rad].
constexpr double kSameDirection = 1e-9;

Vec3 direction_of(const SearchModel& search, const Move& move) {
  const Vec2 dp = move.to.p_OF - move.from.p_OF;
  const double turn = search.model->c * (move.to.theta - move.from.theta);
  return Vec3(dp.x(), dp.y(), turn).normalized();
}

bool is_one_move(const SearchModel& search, const Move& first, const Move& second) {
  return first.contact == second.contact &&
         (direction_of(search, first) - direction_of(search, second)).norm() <
             kSameDirection;
}

std::optional<std::vector<Move>> moves_by(const BaselineQuestion& question,
                                          const Limits& limits, Work& work) {
  if (question.search.contacts.empty()) return std::nullopt;
  const std::string& algorithm = question.kind.algorithm;
  if (algorithm == "random-shooting") return shoot_at_random(question, limits, work);
  if (algorithm == "two-trees") return grow_two_trees(question, limits, work);
  return grow_cone_tree(question, limits, work);
}

}  // namespace

std::vector<Move> joined_moves(const SearchModel& search,
                               const std::vector<Move>& moves) {
  Work uncounted{.budget = std::numeric_limits<std::int64_t>::max()};
  std::vector<Move> result;
  for (const Move& move : moves) {
    if (!result.empty() && is_one_move(search, result.back(), move)) {
      const Move whole{move.contact, result.back().from, move.to};
      if (move_sticks(search, whole.contact, whole.from, whole.to, uncounted) &&
          move_passes(search, whole, uncounted)) {
        result.back() = whole;
        continue;
      }
    }
    result.push_back(move);
  }
  return result;
}

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
