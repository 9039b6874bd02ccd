#include "planner/walks/walk_lattice.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "tests/planner/planner_cases.h"
#include "tests/planner/random_search.h"

namespace prehensile {
namespace {

constexpr int kNodesPerSide = 12;

struct Case : testing::RandomSearch {
  using RandomSearch::RandomSearch;
  Work work{.budget = testing::kNoBudget};
};

std::vector<WalkEdge> all_edges(WalkLattice& lattice, Work& work) {
  std::vector<WalkEdge> all;
  for (int node = 0; node < lattice.nodes(); ++node) {
    const std::vector<WalkEdge>& edges = lattice.edges_from(node, work);
    all.insert(all.end(), edges.begin(), edges.end());
  }
  return all;
}

void expect_same(const std::vector<WalkEdge>& edges,
                 const std::vector<WalkEdge>& others) {
  ASSERT_EQ(edges.size(), others.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(edges[i].to, others[i].to);
    EXPECT_EQ(edges[i].contact, others[i].contact);
    EXPECT_EQ(edges[i].lo, others[i].lo);
    EXPECT_EQ(edges[i].hi, others[i].hi);
    EXPECT_EQ(edges[i].cost, others[i].cost);
  }
}

/// In rows along a heading, closer to each other than the nodes in them: two pushes from
/// a node along the rows differ little in heading, and lead between nodes on the object.
TEST(WalkLattice, LiesInRows) {
  int alike = 0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    Case c(i);
    const Rows rows{.heading = 0.3 + static_cast<double>(i), .closer = 12.0};
    WalkLattice lattice(c.search, c.start, c.goals, {6}, Steepness::kUsual, rows);
    const double spacing = lattice.spacing();
    for (int node = 0; node < lattice.start(); ++node) {
      EXPECT_GE(depth_inside(c.model.pad_face, lattice.place(node)), 0.0);
      for (const WalkEdge& edge : lattice.edges_from(node, c.work)) {
        if (edge.to >= lattice.start()) continue;
        const Vec2 step =
            rows.coordinates(lattice.place(edge.to) - lattice.place(node)) / spacing;
        EXPECT_NEAR((step - step.array().round().matrix()).norm(), 0.0, 1e-6);
        alike += std::lround(std::abs(step.x())) == 3;
      }
    }
    const Vec2 place(0.01, -0.02);
    EXPECT_NEAR((rows.place(rows.coordinates(place)) - place).norm(), 0.0, 1e-15);
    EXPECT_NEAR(rows.place({spacing, 0.0}).norm(), spacing, 1e-15);
    EXPECT_NEAR(rows.place({0.0, spacing}).norm(), spacing / 12.0, 1e-15);
  }
  EXPECT_GT(alike, 0);
}

/// The nearest node to a place at which the face clips the pads; if none, the place.
Vec2 clipped_beside(const Case& c, const WalkLattice& lattice, const Vec2& p_OF) {
  Vec2 nearest = p_OF;
  double least = std::numeric_limits<double>::infinity();
  for (int node = 0; node < lattice.start(); ++node) {
    const Vec2& place = lattice.place(node);
    const double distance = (place - p_OF).norm();
    if (PadsAtPlace::are_whole_at(c.model, place) || distance >= least) continue;
    least = distance;
    nearest = place;
  }
  return nearest;
}

/// Nothing of other ends stays, the pads there neither.
TEST(WalkLattice, OtherEndsHaveOtherPads) {
  int clipped = 0;
  for (std::uint64_t i = 0; i < 16; ++i) {
    Case c(i);
    WalkLattice first(c.search, c.start, c.goals, {kNodesPerSide}, Steepness::kUsual);
    const Vec2 one = clipped_beside(c, first, c.start.p_OF);
    const Vec2 other = clipped_beside(c, first, -one);
    clipped += !PadsAtPlace::are_whole_at(c.model, one) && one != other;
    const auto start_at = [&](const Vec2& p_OF) {
      return FlatState{0.98 * p_OF, c.start.theta};
    };
    const auto goal_at = [&](const Vec2& p_OF) {
      GoalPlaces goal = c.goals;
      goal.count = 1;
      goal.places[0].p_OF = 0.97 * p_OF;
      return goal;
    };
    first.set_ends(start_at(other), goal_at(other));
    all_edges(first, c.work);
    first.set_ends(start_at(one), goal_at(one));
    WalkLattice fresh(c.search, start_at(one), goal_at(one), {kNodesPerSide},
                      Steepness::kUsual);
    expect_same(all_edges(first, c.work), all_edges(fresh, c.work));
  }
  EXPECT_GT(clipped, 3);
}

/// Whatever was asked for before, and however its edges were narrowed.
TEST(WalkLattice, OtherEndsMakeItAnother) {
  std::size_t edges = 0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    Case c(i);
    FlatState elsewhere = c.start;
    elsewhere.p_OF *= 0.5;
    GoalPlaces one = c.goals;
    one.count = 1;
    one.places[0].p_OF *= 0.7;
    WalkLattice fresh(c.search, c.start, c.goals, {kNodesPerSide}, Steepness::kUsual);
    WalkLattice other(c.search, elsewhere, one, {kNodesPerSide}, Steepness::kUsual);
    for (const WalkEdge& edge : all_edges(other, c.work)) edges += edge.lo <= edge.hi;
    for (int node = 0; node < other.start(); ++node) {
      for (int k = 0; k < static_cast<int>(other.edges_from(node, c.work).size()); ++k) {
        other.narrow(node, k, 1.0, 0.0);
        other.narrow(node, k, 3.0, 2.0);
      }
    }
    other.set_ends(c.start, c.goals);
    expect_same(all_edges(other, c.work), all_edges(fresh, c.work));
  }
  EXPECT_GT(edges, 500);
}

/// An edge is the same whether the step back was asked for before it or after.
TEST(WalkLattice, EdgesHaveNoOrder) {
  for (std::uint64_t i = 0; i < 4; ++i) {
    Case c(i);
    WalkLattice forwards(c.search, c.start, c.goals, {kNodesPerSide}, Steepness::kUsual);
    WalkLattice backwards(c.search, c.start, c.goals, {kNodesPerSide}, Steepness::kUsual);
    for (int node = backwards.nodes() - 1; node >= 0; --node) {
      backwards.edges_from(node, c.work);
    }
    expect_same(all_edges(backwards, c.work), all_edges(forwards, c.work));
  }
}

TEST(WalkLattice, IsKeptForOtherEndsOfTheSameSearch) {
  Case c(0);
  Case d(1);
  WalkLattices lattices;
  const auto work_on = [&](Case& of, int per_side, Steepness steepness) {
    Work work{.budget = testing::kNoBudget};
    all_edges(lattices.between(of.search, of.start, of.goals, {per_side}, steepness),
              work);
    return work.done();
  };
  const std::int64_t first = work_on(c, kNodesPerSide, Steepness::kUsual);
  EXPECT_LT(4 * work_on(c, kNodesPerSide, Steepness::kUsual), first);
  EXPECT_GT(work_on(c, 2 * kNodesPerSide, Steepness::kUsual), first);
  EXPECT_LT(4 * work_on(c, kNodesPerSide, Steepness::kUsual), first);
  EXPECT_EQ(work_on(c, kNodesPerSide, Steepness::kSteep), first);
  const std::int64_t of_other = work_on(d, kNodesPerSide, Steepness::kSteep);
  EXPECT_LT(4 * work_on(d, kNodesPerSide, Steepness::kSteep), of_other);
}

}  // namespace
}  // namespace prehensile
