#include "planner/walks/walk_rest.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/constants.h"
#include "tests/planner/random_search.h"

namespace prehensile {
namespace {

/// A lattice over a random problem, and what its walks cost.
struct Case : testing::RandomLattice {
  explicit Case(std::uint64_t index, std::int64_t budget = 5'000'000)
      : RandomLattice(index, budget),
        rest(rest_of_walks(lattice, contacts, limits, work)) {}

  /// By the edges of a node.
  double least_over_edges(int node, int contact) {
    double least = kInfinity;
    for (const WalkEdge& edge : lattice.edges_from(node, work)) {
      if (edge.lo > edge.hi) continue;
      const double placed = edge.contact != contact ? 1.0 : 0.0;
      least = std::min(least, edge.cost + placed + rest.after(edge.to, edge.contact));
    }
    return least;
  }

  LeastRest rest;
};

void expect_same(double rest, double other) {
  if (rest == kInfinity || other == kInfinity) {
    EXPECT_EQ(rest, other);
  } else {
    EXPECT_NEAR(rest, other, 1e-9);
  }
}

/// At each node that a way from the start leads to it is that of the best edge.
TEST(WalkRest, IsThatOfTheBestEdge) {
  int reached = 0;
  int lost = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    Case c(i);
    expect_same(c.rest.after(c.lattice.start(), -1),
                c.least_over_edges(c.lattice.start(), -1));
    for (int node = 0; node < c.lattice.nodes(); ++node) {
      for (int k = 0; k < c.contacts; ++k) {
        const double rest = c.rest.after(node, k);
        if (c.lattice.goal_at(node) >= 0) {
          EXPECT_EQ(rest, 0.0);
        } else if (rest == kInfinity) {
          ++lost;
        } else {
          ++reached;
          expect_same(rest, c.least_over_edges(node, k));
        }
      }
    }
  }
  EXPECT_GT(reached, 500);
  EXPECT_GT(lost, 500);
}

TEST(WalkRest, IsInfiniteWhereABudgetEnds) {
  Case c(0, 1);
  EXPECT_EQ(c.rest.after(c.lattice.start(), -1), kInfinity);
}

}  // namespace
}  // namespace prehensile
