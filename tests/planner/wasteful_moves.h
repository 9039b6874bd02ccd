/// Sequences of pushes that stick and lead nowhere: food for what makes plans cheaper.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include "planner/steering/chain.h"
#include "planner/steering/goal.h"
#include "problems/random_stream.h"
#include "tests/planner/planner_cases.h"

namespace prehensile::testing {

/// Up to `count` pushes from the start of the scene, each a few millimetres long.
inline std::vector<Move> wasteful_moves(const SearchModel& search, std::uint64_t seed,
                                        std::size_t count) {
  constexpr int kTries = 4000;
  RandomStream random(seed);
  Work work{.budget = testing::kNoBudget};
  std::vector<Move> moves;
  FlatState at = flat_state(search.model->scene.start);
  for (int i = 0; i < kTries && moves.size() < count; ++i) {
    const auto contact = static_cast<int>(i % std::ssize(search.contacts));
    const double angle = random.in(-3.2, 3.2);
    const double length = random.in(0.001, 0.006);
    FlatState to = at;
    to.p_OF += length * Vec2(std::cos(angle), std::sin(angle));
    to.theta += random.in(-1.0, 1.0) * length / search.model->c;
    const Move move{contact, at, to};
    if (!move_passes(search, move, work)) continue;
    moves.push_back(move);
    at = to;
  }
  return moves;
}

/// Whether moves lead from where others begin to where they end, each from where the one
/// before ends.
inline bool is_detour_of(const std::vector<Move>& moves,
                         const std::vector<Move>& others) {
  const auto same = [](const FlatState& a, const FlatState& b) {
    return a.p_OF == b.p_OF && a.theta == b.theta;
  };
  for (std::size_t i = 1; i < moves.size(); ++i) {
    if (!same(moves[i - 1].to, moves[i].from)) return false;
  }
  return same(moves.front().from, others.front().from) &&
         same(moves.back().to, others.back().to);
}

}  // namespace prehensile::testing
