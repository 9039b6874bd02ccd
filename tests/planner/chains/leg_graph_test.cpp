#include "planner/chains/leg_graph.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "planner/chains/lattice.h"
#include "tests/planner/planner_cases.h"
#include "tests/planner/random_search.h"

namespace prehensile {
namespace {

struct Case : testing::RandomSearch {
  explicit Case(std::uint64_t index)
      : RandomSearch(index),
        work{.budget = testing::kNoBudget},
        steering{search},
        nodes(lattice_nodes(search, 60)),
        graph(steering, search, nodes, start, goals, work) {}

  /// Edges from a node to another by a contact.
  int edges_to(int node, int contact, int to) {
    int count = 0;
    for (const LegEdge& edge : graph.edges(node, contact)) count += edge.to == to ? 1 : 0;
    return count;
  }

  Work work;
  Steering steering;
  std::vector<Vec2> nodes;
  LegGraph graph;
};

TEST(LegGraph, EdgesAreIntervalsOfLegs) {
  int edges = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    Case c(i);
    ASSERT_EQ(c.graph.start(), static_cast<int>(c.nodes.size()));
    EXPECT_EQ(c.graph.place(c.graph.start()), c.start.p_OF);
    for (int node = 0; node < c.graph.goal(); node += 7) {
      for (int contact = 0; contact < c.graph.contacts(); ++contact) {
        const Stop from{c.graph.place(node), node == c.graph.start()};
        for (int to = 0; to < c.graph.start(); ++to) {
          Leg leg;
          const bool is_leg = to != node && make_leg(c.steering, contact, from,
                                                     {c.nodes[to]}, c.work, leg);
          ASSERT_EQ(c.edges_to(node, contact, to), is_leg ? leg.kappas.count : 0);
          edges += is_leg ? 1 : 0;
        }
        EXPECT_EQ(c.edges_to(node, contact, c.graph.start()), 0);
      }
      for (const LastLeg& last : c.graph.last_legs(node)) {
        EXPECT_EQ(last.leg.to, c.goals.places[last.place].p_OF);
        EXPECT_EQ(static_cast<int>(last.edges.size()), last.leg.kappas.count);
        for (const LegEdge& edge : last.edges) EXPECT_EQ(edge.to, c.graph.goal());
      }
    }
  }
  EXPECT_GT(edges, 1000);
}

TEST(LegGraph, RemembersNarrowedLegs) {
  int narrowed = 0;
  int lost = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    Case c(i);
    for (int node = 0; node < c.graph.goal(); node += 5) {
      for (int contact = 0; contact < c.graph.contacts(); ++contact) {
        if (c.graph.edges(node, contact).empty()) continue;
        const int to = c.graph.edges(node, contact).front().to;
        Leg leg;
        ASSERT_TRUE(c.graph.make(contact, node, to, leg));
        const bool all = (node + contact) % 2 == 0;
        if (all) {
          leg.kappas.count = 0;
        } else {
          leg.kappas.intervals[0].hi = leg.kappas.intervals[0].lo;
        }
        c.graph.narrow(leg, node, to);
        c.graph.renew();
        Leg again;
        EXPECT_EQ(c.graph.make(contact, node, to, again), !all);
        EXPECT_EQ(again.kappas.count, leg.kappas.count);
        EXPECT_EQ(c.edges_to(node, contact, to), leg.kappas.count);
        (all ? lost : narrowed) += 1;
      }
      if (c.graph.last_legs(node).empty()) continue;
      LastLeg last = c.graph.last_legs(node).front();
      last.leg.kappas.count = 0;
      c.graph.narrow_last(last.leg, node, last.place);
      c.graph.renew();
      EXPECT_TRUE(c.graph.last_legs(node).front().edges.empty());
    }
  }
  EXPECT_GT(narrowed, 20);
  EXPECT_GT(lost, 20);
}

/// What real pads allow is measured once, and is as much work each time.
TEST(LegGraph, ALegMadeAgainIsTheSameForTheSameWork) {
  int legs = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    Case c(i);
    c.steering.real_pads = true;
    const int node = c.graph.start();
    for (int contact = 0; contact < c.graph.contacts(); ++contact) {
      const std::vector<LegEdge> edges = c.graph.edges(node, contact);
      for (const LegEdge& edge : edges) {
        const auto made = [&] {
          Leg leg;
          const std::int64_t before = c.work.stick_tests;
          EXPECT_TRUE(c.graph.make(contact, node, edge.to, leg));
          return std::pair(leg, c.work.stick_tests - before);
        };
        const auto [first, work] = made();
        const auto [again, same_work] = made();
        EXPECT_EQ(again.length, first.length);
        ASSERT_EQ(again.kappas.count, first.kappas.count);
        for (int k = 0; k < first.kappas.count; ++k) {
          EXPECT_EQ(again.kappas.intervals[k].lo, first.kappas.intervals[k].lo);
          EXPECT_EQ(again.kappas.intervals[k].hi, first.kappas.intervals[k].hi);
        }
        EXPECT_EQ(same_work, work);
        EXPECT_GT(work, 20);  // trials of many kappas
        ++legs;
      }
    }
  }
  EXPECT_GT(legs, 50);
}

}  // namespace
}  // namespace prehensile
