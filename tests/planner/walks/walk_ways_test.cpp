#include "planner/walks/walk_ways.h"

#include <vector>

#include <gtest/gtest.h>

#include "planner/walks/walk_rest.h"
#include "scene/constants.h"
#include "tests/planner/random_search.h"

namespace prehensile {
namespace {

struct Case : testing::RandomLattice {
  explicit Case(std::uint64_t index)
      : RandomLattice(index),
        states(lattice, contacts),
        rest(rest_of_walks(lattice, contacts, limits, work)),
        ways(lattice, states, rest, work) {}

  /// J of steps from a state, and the state after them; they have to be connected.
  std::pair<double, int> follow(const std::vector<WalkStep>& steps, int state) {
    double cost = 0.0;
    for (const WalkStep& step : steps) {
      EXPECT_EQ(step.node, state < 0 ? lattice.start() : states.node(state));
      const WalkEdge& edge = lattice.edges_from(step.node, work)[step.edge];
      EXPECT_LE(edge.lo, edge.hi);
      const bool goes_on = state >= 0 && states.contact(state) == edge.contact;
      cost += edge.cost + (goes_on ? 0.0 : 1.0);
      state = states.after(edge);
    }
    return {cost, state};
  }

  WalkStates states;
  LeastRest rest;
  WalkWays ways;
};

/// To each state that is on a way from the start to a goal there is one, and one on from
/// there to a goal; together they cost what the state is said to. None is cheaper than
/// the rest from the start, and the cheapest way has that cost.
TEST(WalkWays, LeadFromTheStartOverAStateToAGoal) {
  int on_ways = 0;
  for (std::uint64_t i = 0; i < 16; ++i) {
    Case c(i);
    const double least = c.rest.after(c.lattice.start(), -1);
    if (least == kInfinity) continue;
    double cheapest = kInfinity;
    for (int s = 0; s < c.states.count(); ++s) {
      const double cost = c.ways.cost_over(s);
      if (cost == kInfinity) continue;
      ++on_ways;
      EXPECT_GE(cost, least - 1e-9);
      cheapest = std::min(cheapest, cost);
      const auto [to_it, there] = c.follow(c.ways.way_to(s), -1);
      EXPECT_EQ(there, s);
      const auto [steps, end] = c.ways.way_on_from(s);
      const auto [from_it, last] = c.follow(steps, s);
      EXPECT_EQ(last, end);
      EXPECT_GE(c.lattice.goal_at(c.states.node(end)), 0);
      EXPECT_NEAR(to_it + from_it, cost, 1e-9);
    }
    EXPECT_NEAR(cheapest, least, 1e-9);
    const auto [steps, end] = c.ways.way_on_from(-1);
    EXPECT_NEAR(c.follow(steps, -1).first, least, 1e-9);
  }
  EXPECT_GT(on_ways, 500);
}

}  // namespace
}  // namespace prehensile
