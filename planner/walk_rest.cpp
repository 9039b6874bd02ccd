#include "planner/walk_rest.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

WalkRest::WalkRest(WalkLattice& lattice, int contacts, const Limits& limits, Work& work)
    : contacts_(contacts),
      rest_(
          static_cast<std::size_t>(lattice.nodes()) * static_cast<std::size_t>(contacts),
          kInfinity),
      of_start_(kInfinity) {
  EdgesTo edges(static_cast<std::size_t>(lattice.nodes()));
  std::vector<bool> seen(edges.size());
  std::vector<int> open = {lattice.start()};
  seen[lattice.start()] = true;
  while (!open.empty()) {
    if (limits.reached()) return;
    const int node = open.back();
    open.pop_back();
    for (const WalkEdge& edge : lattice.edges_from(node, work)) {
      if (edge.lo > edge.hi) continue;
      edges[edge.to].push_back({node, edge.contact, edge.cost});
      if (!seen[edge.to]) open.push_back(edge.to);
      seen[edge.to] = true;
    }
  }
  settle(lattice, edges);
}

/// From the goals backwards, the nearest first. A push by another contact than the one
/// before is one placement more.
void WalkRest::settle(const WalkLattice& lattice, const EdgesTo& edges) {
  using Entry = std::pair<double, std::pair<int, int>>;  // rest, node, contact
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto offer = [&](int node, int contact, double rest) {
    double& least = rest_[state(node, contact)];
    if (rest >= least) return;
    least = rest;
    open.push({rest, {node, contact}});
  };
  for (int node = 0; node < lattice.nodes(); ++node) {
    if (lattice.goal_at(node) < 0) continue;
    for (int k = 0; k < contacts_; ++k) offer(node, k, 0.0);
  }
  while (!open.empty()) {
    const auto [rest, at] = open.top();
    const auto [node, contact] = at;
    open.pop();
    if (rest > rest_[state(node, contact)]) continue;
    for (const EdgeTo& edge : edges[node]) {
      if (edge.contact != contact) continue;
      const double before = rest + edge.cost;
      if (edge.from == lattice.start()) of_start_ = std::min(of_start_, before + 1.0);
      for (int k = 0; k < contacts_; ++k) {
        offer(edge.from, k, before + (k != contact ? 1.0 : 0.0));
      }
    }
  }
}

}  // namespace prehensile
