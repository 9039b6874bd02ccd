#include "planner/walks/turning_loop.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "planner/walks/walk_rest.h"
#include "scene/constants.h"
#include "tests/planner/random_search.h"

namespace prehensile {
namespace {

/// A lattice over a random problem and the ways over it.
struct Case : testing::RandomLattice {
  explicit Case(std::uint64_t index)
      : RandomLattice(index),
        states(lattice, contacts),
        rest(rest_of_walks(lattice, contacts, limits, work)) {}

  const WalkEdge& edge(const WalkStep& step) {
    return lattice.edges_from(step.node, work)[step.edge];
  }

  bool is_on_way(int state) const {
    return states.node(state) < lattice.start() &&
           rest.after(states.node(state), states.contact(state)) < kInfinity;
  }

  double cost(int state, const WalkEdge& edge) const {
    return edge.cost + (edge.contact != states.contact(state) ? 1.0 : 0.0);
  }

  /// Whether turn beyond `ratio` times cost can be gained without end (Bellman, Ford).
  bool has_loop_above(double ratio, int side) {
    std::vector<double> most(static_cast<std::size_t>(states.count()), 0.0);
    bool grows = true;
    for (int round = 0; round <= states.count() && grows; ++round) {
      grows = false;
      for (int s = 0; s < states.count(); ++s) {
        if (!is_on_way(s)) continue;
        for (const WalkEdge& edge : lattice.edges_from(states.node(s), work)) {
          const int to = states.after(edge);
          if (edge.lo > edge.hi || !is_on_way(to)) continue;
          const double turn = side > 0 ? edge.hi : -edge.lo;
          const double gained = most[s] + turn - ratio * cost(s, edge);
          if (gained <= most[to] + 1e-13) continue;
          most[to] = gained;
          grows = true;
        }
      }
    }
    return grows;
  }

  WalkStates states;
  LeastRest rest;
};

/// It leads back to where it begins, turns as it says, and no loop turns more for its
/// cost, by another algorithm.
TEST(TurningLoop, TurnsMostForItsCost) {
  int loops = 0;
  int none = 0;
  for (std::uint64_t i = 0; i < 24; ++i) {
    Case c(i);
    for (const int side : {1, -1}) {
      const auto loop = turning_loop(c.lattice, c.states, c.rest, side, c.limits, c.work);
      if (!loop) {
        ++none;
        EXPECT_FALSE(c.has_loop_above(1e-4, side)) << i;
        continue;
      }
      ++loops;
      double turn = 0.0;
      double cost = 0.0;
      for (std::size_t k = 0; k < loop->steps.size(); ++k) {
        const WalkEdge& edge = c.edge(loop->steps[k]);
        EXPECT_EQ(c.states.node(loop->states[k]), loop->steps[k].node);
        EXPECT_EQ(c.states.after(edge), loop->states[(k + 1) % loop->states.size()]);
        EXPECT_TRUE(c.is_on_way(loop->states[k]));
        turn += side > 0 ? edge.hi : -edge.lo;
        cost += c.cost(loop->states[k], edge);
      }
      EXPECT_NEAR(turn, loop->turn, 1e-12);
      EXPECT_GT(turn, 0.0);
      EXPECT_FALSE(c.has_loop_above(1.001 * turn / cost, side)) << i;
      EXPECT_TRUE(c.has_loop_above(0.999 * turn / cost, side)) << i;
    }
  }
  EXPECT_GE(loops, 10);
  EXPECT_GE(none, 1);
}

TEST(TurningLoop, IsNoneWhereABudgetEnds) {
  Case c(0);
  c.work.budget = 0;
  EXPECT_FALSE(turning_loop(c.lattice, c.states, c.rest, 1, c.limits, c.work));
}

}  // namespace
}  // namespace prehensile
