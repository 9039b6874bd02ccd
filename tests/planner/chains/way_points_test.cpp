#include "planner/chains/way_points.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "planner/chains/lattice.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::kNoBudget;
using testing::Random;

TEST(BestWayPoints, KeepsTheCheapestInOrder) {
  Random random(1);
  BestWayPoints best;
  std::vector<double> costs;
  for (int i = 0; i < 500; ++i) {
    const double cost = random.in(1.0, 5.0);
    costs.push_back(cost);
    best.add({.cost = cost});
    best.add({.cost = kNan});
  }
  std::sort(costs.begin(), costs.end());
  ASSERT_EQ(best.count(), BestWayPoints::kCapacity);
  for (int i = 0; i < best.count(); ++i) EXPECT_EQ(best[i].cost, costs[i]);
}

/// A regrasp whose start and goal lie in the bar and the stem of the T.
struct Regrasp {
  explicit Regrasp(Random& random, bool tee)
      : model(prepare(tee ? published_tee(0) : published_square(0))),
        search(prepare_search(model, Margin{})),
        start{{random.in(-0.04, 0.02), random.in(-0.01, 0.01)}, 0.0},
        end(random.in(-0.045, 0.02), random.in(-0.01, 0.01)),
        goal(goal_at(end, random.in(-1.0, 1.0))),
        places(goal_places(model, goal, start)) {}

  Model model;
  SearchModel search;
  FlatState start;
  Vec2 end;
  Goal goal;
  GoalPlaces places;
};

TEST(WayPoints, CrossingsAreChainsOfTheirCost) {
  Random random(2);
  int crossings = 0;
  for (int i = 0; i < 60; ++i) {
    const Regrasp regrasp(random, i % 2 == 0);
    const SearchModel& search = regrasp.search;
    Work work{.budget = kNoBudget};
    BestWayPoints best;
    add_crossings({search}, regrasp.start, regrasp.places, 0, work, best);
    crossings += best.count() > 0;
    for (int k = 0; k < best.count(); ++k) {
      const WayPoint& point = best[k];
      const double dtheta = regrasp.places.places[0].theta[point.angle];
      Chain chain;
      chain.count = 2;
      ASSERT_TRUE(make_leg({search}, point.first, {regrasp.start.p_OF, true},
                           {point.p_OF}, work, chain.legs[0]));
      ASSERT_TRUE(make_leg({search}, point.second, {point.p_OF}, {regrasp.end, true},
                           work, chain.legs[1]));
      ASSERT_TRUE(solve_chain(search, dtheta, chain));
      EXPECT_NEAR(chain.cost, point.cost, 1e-12);
    }
  }
  EXPECT_GT(crossings, 30);
}

/// Crossings take fewer tests than a lattice and are seldom much worse.
TEST(WayPoints, CrossingsAreNearlyAsGoodAsALattice) {
  Random random(3);
  int solved = 0;
  int as_good = 0;
  for (int i = 0; i < 60; ++i) {
    const Regrasp regrasp(random, i % 2 == 0);
    Work work{.budget = kNoBudget};
    BestWayPoints crossings, nodes;
    add_crossings({regrasp.search}, regrasp.start, regrasp.places, 0, work, crossings);
    const std::int64_t tests = work.stick_tests;
    add_nodes({regrasp.search}, lattice_nodes(regrasp.search, 300), regrasp.start,
              regrasp.places, work, nodes);
    EXPECT_GT(work.stick_tests - tests, tests);
    if (nodes.count() == 0) continue;
    ++solved;
    as_good += crossings.count() > 0 && crossings[0].cost < nodes[0].cost + 0.1;
  }
  EXPECT_GT(solved, 30);
  EXPECT_GT(as_good, solved / 2);
}

/// What could not be kept anyway gets no legs, and what is kept is the same.
TEST(WayPoints, NodesTooFarOffCostNothing) {
  Random random(4);
  int compared = 0;
  double saved = 0.0;
  for (int i = 0; i < 60; ++i) {
    const Regrasp regrasp(random, i % 2 == 0);
    const std::vector<Vec2> lattice = lattice_nodes(regrasp.search, 300);
    Work of_all{.budget = kNoBudget}, of_cheap{.budget = kNoBudget};
    BestWayPoints all;
    add_nodes({regrasp.search}, lattice, regrasp.start, regrasp.places, of_all, all);
    if (all.count() < 3) continue;
    ++compared;
    const double to_beat = all[all.count() / 2].cost;
    BestWayPoints cheap(to_beat);
    add_nodes({regrasp.search}, lattice, regrasp.start, regrasp.places, of_cheap, cheap);
    int expected = 0;
    while (all[expected].cost < to_beat) ++expected;
    ASSERT_EQ(cheap.count(), expected) << i;
    for (int k = 0; k < expected; ++k) {
      EXPECT_EQ(cheap[k].cost, all[k].cost) << i;
      EXPECT_EQ(cheap[k].p_OF, all[k].p_OF) << i;
    }
    EXPECT_LE(of_cheap.stick_tests, of_all.stick_tests) << i;
    saved += 1.0 - static_cast<double>(of_cheap.stick_tests) /
                       static_cast<double>(of_all.stick_tests);
  }
  std::printf("%.0f %% of the tests saved in %d cases\n", 100.0 * saved / compared,
              compared);
  EXPECT_GT(compared, 30);
  EXPECT_GT(saved, 0.25 * compared);
}

TEST(Lattice, NodesLieOnTheObject) {
  const Model model = prepare(published_tee(0));
  const SearchModel search = prepare_search(model, Margin{});
  std::vector<Vec2> nodes = lattice_nodes(search, 200);
  EXPECT_GT(nodes.size(), 100U);
  EXPECT_LT(nodes.size(), 260U);
  const std::size_t before = nodes.size();
  add_local_nodes(search, {-0.03, 0.04}, {-0.03, 0.02}, 12, nodes);
  EXPECT_GT(nodes.size(), before + 20);
  for (const Vec2& node : nodes) EXPECT_GT(depth_inside(model.outline, node), 0.0);
}

}  // namespace
}  // namespace prehensile
