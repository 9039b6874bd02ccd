#include "planner/chains/turn_ahead.h"

#include <cmath>
#include <deque>
#include <optional>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr double kL = 0.1;  // [m]

/// A made-up lattice whose last node is the goal.
struct Graph {
  explicit Graph(Random& random)
      : nodes(3 + random.below(8)), contacts(1 + random.below(3)) {
    for (int k = 6 * nodes; k > 0; --k) {
      const double low = random.in(-4.0, 3.0);
      costs.push_back(
          turn_cost(random.in(0.001, 0.03), {low, low + random.in(0.0, 3.0)}));
      pushes.push_back({random.below(nodes - 1), random.below(contacts),
                        random.below(nodes), &costs.back()});
    }
  }

  int nodes, contacts;
  std::deque<TurnCost> costs;
  std::vector<TurningPush> pushes;
};

/// A walk to the goal at random; nothing where it gets lost.
std::optional<std::vector<int>> random_walk(const Graph& graph, int from,
                                            Random& random) {
  std::vector<int> walk;
  for (int at = from; at != graph.nodes - 1;) {
    if (walk.size() > 12) return std::nullopt;
    std::vector<int> ways;
    for (int k = 0; k < static_cast<int>(graph.pushes.size()); ++k) {
      if (graph.pushes[k].from == at) ways.push_back(k);
    }
    if (ways.empty()) return std::nullopt;
    walk.push_back(ways[random.below(static_cast<int>(ways.size()))]);
    at = graph.pushes[walk.back()].to;
  }
  return walk;
}

/// Walks cost at least what is said ahead of each of their nodes, for turns that they can
/// make.
TEST(TurnAhead, BoundsEveryWalk) {
  Random random(1);
  int walks = 0;
  double nearest = 1e9;
  for (int i = 0; i < 300; ++i) {
    const Graph graph(random);
    const TurnAhead ahead(graph.pushes, graph.nodes, graph.contacts, graph.nodes - 1, kL);
    const int start = random.below(graph.nodes - 1);
    const auto walk = random_walk(graph, start, random);
    if (!walk || walk->empty()) continue;
    ++walks;
    TurnCost whole;
    int placements = 0;
    int contact = -1;
    for (const int k : *walk) {
      whole += *graph.pushes[k].cost;
      placements += graph.pushes[k].contact != contact ? 1 : 0;
      contact = graph.pushes[k].contact;
    }
    for (int point = 0; point < TurnCost::kCount; ++point) {
      const double turn = whole.turn[point];
      const double cost = placements + whole.travel[point] / kL;
      TurnCost paid;
      int before = 0;
      contact = -1;
      for (const int k : *walk) {
        const TurningPush& push = graph.pushes[k];
        const double least =
            before + ahead.least_cost(paid, push.from, contact, turn, turn);
        EXPECT_LE(least, cost + 1e-5);
        EXPECT_LE(before + ahead.after(push.from, contact), cost + 1e-5);
        nearest = std::min(nearest, cost - least);
        EXPECT_LE(ahead.least_cost(paid, push.from, contact, turn - 0.1, turn + 0.1),
                  ahead.least_cost(paid, push.from, contact, turn, turn) + 1e-5);
        paid += *push.cost;
        before += push.contact != contact ? 1 : 0;
        contact = push.contact;
      }
      const double at_goal = ahead.least_cost(paid, graph.nodes - 1, contact, turn, turn);
      EXPECT_LE(at_goal, paid.least_travel(turn) / kL + 1e-9);
      EXPECT_GE(at_goal, 0.8 * paid.least_travel(turn) / kL);
    }
  }
  EXPECT_GT(walks, 100);
  EXPECT_LT(nearest, 1e-3);  // of the shortest ones it is all
}

TEST(TurnAhead, IsInfiniteWhereNoWayLeads) {
  const TurnCost cost = turn_cost(0.01, {0.0, 1.0});
  const TurnAhead ahead({{0, 0, 2, &cost}}, 3, 1, 2, kL);
  EXPECT_NEAR(ahead.after(0, -1), 1.1, 1e-6);
  EXPECT_GT(ahead.least_cost({}, 1, -1, 0.0, 0.0), 1e9);
}

}  // namespace
}  // namespace prehensile
