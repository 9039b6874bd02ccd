#include "planner/chains/least_rest.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "scene/constants.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

struct Edge {
  int from, to, contact;
  double cost;
};

/// Asking every edge until nothing changes any more.
std::vector<double> by_turns(const std::vector<Edge>& edges, int nodes, int contacts,
                             int end) {
  std::vector<double> rest(static_cast<std::size_t>(nodes * contacts), kInfinity);
  for (int k = 0; k < contacts; ++k) rest[end * contacts + k] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& edge : edges) {
      const double after = edge.cost + rest[edge.to * contacts + edge.contact];
      for (int k = 0; k < contacts; ++k) {
        double& before = rest[edge.from * contacts + k];
        const double one = after + (k != edge.contact ? 1.0 : 0.0);
        if (one < before - 1e-12) {
          before = one;
          changed = true;
        }
      }
    }
  }
  return rest;
}

TEST(LeastRest, IsThatOfTheShortestWay) {
  testing::Random random(1);
  int reached = 0;
  int lost = 0;
  for (int i = 0; i < 50; ++i) {
    const int nodes = 2 + random.below(20);
    const int contacts = 1 + random.below(3);
    const int end = random.below(nodes);
    std::vector<Edge> edges;
    PushesTo pushes(static_cast<std::size_t>(nodes * contacts));
    for (int k = random.below(4 * nodes); k >= 0; --k) {
      const Edge edge{random.below(nodes), random.below(nodes), random.below(contacts),
                      random.in(0.0, 2.0)};
      edges.push_back(edge);
      pushes[edge.to * contacts + edge.contact].push_back({edge.from, edge.cost});
    }
    const LeastRest rest(pushes, contacts, std::array{end});
    const std::vector<double> expected = by_turns(edges, nodes, contacts, end);
    for (int node = 0; node < nodes; ++node) {
      double first = kInfinity;
      for (int k = 0; k < contacts; ++k) {
        const double other = expected[node * contacts + k];
        first = std::min(first, other);
        (other < kInfinity ? reached : lost) += 1;
        if (other < kInfinity) {
          EXPECT_NEAR(rest.after(node, k), other, 1e-9);
        } else {
          EXPECT_EQ(rest.after(node, k), kInfinity);
        }
      }
      if (node != end && first < kInfinity) {
        EXPECT_NEAR(rest.after(node, -1), first + 1.0, 1e-9);
      }
    }
  }
  EXPECT_GT(reached, 100);
  EXPECT_GT(lost, 100);
}

TEST(LeastRest, IsInfiniteWithoutEnds) {
  const PushesTo pushes = {{{1, 0.5}}, {{0, 0.5}}};
  const LeastRest rest(pushes, 1, {});
  EXPECT_EQ(rest.after(0, 0), kInfinity);
  EXPECT_EQ(rest.after(1, -1), kInfinity);
}

}  // namespace
}  // namespace prehensile
