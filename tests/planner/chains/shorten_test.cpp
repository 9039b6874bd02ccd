#include "planner/chains/shorten.h"

#include <gtest/gtest.h>

#include "planner/chains/direct_push.h"
#include "problems/random_fixtures.h"
#include "tests/planner/planner_cases.h"
#include "tests/planner/wasteful_moves.h"

namespace prehensile {
namespace {

using Shorten = std::vector<Move> (*)(const SearchModel&, const std::vector<Move>&,
                                      const Limits&, Work&);

Scene random_scene(std::uint64_t index) {
  const FixtureRange range{.object = static_cast<FixtureObject>(index % 4),
                           .goals = GoalsFrom::kRandom};
  return random_fixture(range, 3, index)->scene;
}

/// Sums of J over many sequences, before and after.
struct Costs {
  double before = 0.0, after = 0.0;
};

/// Expects sequences with the same ends that cost no more, each push of which sticks.
Costs shorten_many(Shorten shorten, std::size_t moves_each, std::uint64_t scenes) {
  const PlanOptions options;
  Costs costs;
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Model model = prepare(random_scene(i));
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = testing::wasteful_moves(search, i, moves_each);
    if (moves.size() < 3) continue;
    Work work{.budget = testing::kNoBudget};
    const auto shorter = shorten(search, moves, Limits(options, work), work);
    EXPECT_TRUE(testing::is_detour_of(shorter, moves)) << i;
    for (const Move& move : shorter) EXPECT_TRUE(move_passes(search, move, work)) << i;
    const double before = cost_of(search, moves);
    const double after = cost_of(search, shorter);
    EXPECT_LE(after, before + 1e-9) << i;
    costs.before += before;
    costs.after += after;
  }
  return costs;
}

TEST(Shorten, KeepsTheEndsAndNeverCostsMore) {
  const Costs costs = shorten_many(&shortened, 12, 40);
  EXPECT_LT(costs.after, 0.6 * costs.before);
}

TEST(Shorten, ManyPushesBecomeFew) {
  const Costs costs = shorten_many(&shortened, 150, 4);
  EXPECT_LT(costs.after, 0.1 * costs.before);
}

TEST(Shorten, OverALatticeToo) {
  const Costs costs = shorten_many(&shortened_over_lattice, 30, 16);
  EXPECT_LT(costs.after, 0.3 * costs.before);
}

/// What is done already stays when the work is spent, wherever that is.
TEST(Shorten, EndsWithItsBudget) {
  constexpr int kParts = 40;
  const Model model = prepare(random_scene(0));
  const SearchModel search = prepare_search(model, Margin::none());
  const PlanOptions options;
  const auto moves = testing::wasteful_moves(search, 1, 60);
  ASSERT_EQ(moves.size(), 60U);
  Work whole{.budget = testing::kNoBudget};
  shortened_over_lattice(search, moves, Limits(options, whole), whole);
  for (int i = 0; i < kParts; ++i) {
    Work work{.budget = whole.done() * i / kParts};
    const auto shorter =
        shortened_over_lattice(search, moves, Limits(options, work), work);
    EXPECT_TRUE(testing::is_detour_of(shorter, moves)) << i;
    EXPECT_LT(work.done(), work.budget + 20'000) << i;
  }
}

TEST(Shorten, OnePushDoesWhatManyDidInALine) {
  const Scene scene = random_among_walls(true, RegraspRange::kWide, false, 3, 1);
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = testing::kNoBudget};
  const PlanOptions options;
  const Limits limits(options, work);
  // Away from the wall in small steps of one contact, which one push can do.
  std::vector<Move> moves;
  const Vec2 n = search.contacts[0].stick.n;
  for (int k = 0; k < 10; ++k) {
    const Vec2 from = -1e-3 * k * n;
    moves.push_back({0, {from, 0.0}, {from - 1e-3 * n, 0.0}});
    ASSERT_TRUE(move_passes(search, moves.back(), work));
  }
  const std::vector<Move> shorter = shortened(search, moves, limits, work);
  ASSERT_EQ(shorter.size(), 1u);
  EXPECT_EQ(shorter.front().from.p_OF, moves.front().from.p_OF);
  EXPECT_EQ(shorter.back().to.p_OF, moves.back().to.p_OF);
  EXPECT_LE(cost_of(search, shorter), cost_of(search, moves) + 1e-12);
}

/// Unit steps along a straight line are one push in the end.
TEST(Shorten, StraightStepsAreJoined) {
  const Model model = prepare(published_square(3));
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = testing::kNoBudget};
  const FlatState start = flat_state(model.scene.start);
  const GoalPlaces goals = goal_places(model, *model.scene.goal, start);
  const auto push = direct_push(search, start, goals, work);
  ASSERT_TRUE(push);
  std::vector<Move> steps;
  for (int i = 0; i < 7; ++i) {
    const auto at = [&](double s) {
      return FlatState{start.p_OF + s * (push->to.p_OF - start.p_OF),
                       start.theta + s * (push->to.theta - start.theta)};
    };
    steps.push_back({push->contact, at(i / 7.0), at((i + 1) / 7.0)});
  }
  EXPECT_EQ(joined_moves(search, steps).size(), 1U);
  steps.resize(3);
  std::swap(steps[0], steps[2]);  // no way from one to the next
  EXPECT_GT(joined_moves(search, steps).size(), 1U);
}

}  // namespace
}  // namespace prehensile
