#include "planner/walks/walk_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace prehensile {
namespace {

using Neighbours = std::vector<std::vector<int>>;  // by node

/// The nodes that a way leads to from some of them, these first.
std::vector<int> reached_from(std::vector<int> nodes, const Neighbours& next) {
  std::vector<char> seen(next.size());
  for (const int node : nodes) seen[node] = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int to : next[nodes[i]]) {
      if (seen[to]) continue;
      seen[to] = 1;
      nodes.push_back(to);
    }
  }
  return nodes;
}

}  // namespace

std::optional<WalkGap> walk_gap(WalkLattice& lattice, const Limits& limits, Work& work) {
  const auto count = static_cast<std::size_t>(lattice.nodes());
  Neighbours after(count);
  Neighbours before(count);
  for (int node = 0; node <= lattice.start(); ++node) {
    if (limits.reached()) return std::nullopt;
    for (const WalkEdge& edge : lattice.edges_from(node, work)) {
      if (edge.lo > edge.hi) continue;
      after[node].push_back(edge.to);
      before[edge.to].push_back(node);
    }
  }
  std::vector<int> goals;
  for (int node = 0; node < lattice.nodes(); ++node) {
    if (lattice.goal_at(node) >= 0) goals.push_back(node);
  }
  const std::vector<int> from_start = reached_from({lattice.start()}, after);
  const std::vector<int> to_goal = reached_from(goals, before);
  WalkGap gap{.spacings = std::numeric_limits<double>::infinity()};
  for (const int one : from_start) {
    for (const int other : to_goal) {
      const Vec2& from = lattice.place(one);
      const Vec2& to = lattice.place(other);
      const double spacings = (from - to).norm() / lattice.spacing();
      if (spacings < gap.spacings) gap = {spacings, from, to};
    }
  }
  return gap;
}

}  // namespace prehensile
