#include "planner/walks/walk_ways.h"

#include <algorithm>
#include <cstdint>
#include <functional>

#include "scene/constants.h"

namespace prehensile {
namespace {

/// As many edges are followed in the time of a stick test, about.
constexpr int kEdgesPerTest = 16;

double placed(const WalkEdge& edge, int contact_before) {
  return edge.contact != contact_before ? 1.0 : 0.0;
}

}  // namespace

WalkWays::WalkWays(WalkLattice& lattice, const WalkStates& states, const LeastRest& rest,
                   Work& work)
    : lattice_(lattice),
      states_(states),
      rest_(rest),
      work_(work),
      costs_(static_cast<std::size_t>(states.count()), kInfinity),
      steps_(costs_.size()),
      before_(costs_.size(), -1) {
  expand(lattice.start(), -1, -1, 0.0);
  while (!open_.empty()) {
    std::ranges::pop_heap(open_, std::greater<>());
    const auto [cost, state] = open_.back();
    open_.pop_back();
    if (cost > costs_[state]) continue;
    if (lattice.goal_at(states.node(state)) >= 0) continue;
    expand(states.node(state), states.contact(state), state, cost);
  }
}

void WalkWays::expand(int node, int contact, int state, double cost) {
  const std::vector<WalkEdge>& edges = lattice_.edges_from(node, work_);
  work_.other += 1 + static_cast<std::int64_t>(edges.size()) / kEdgesPerTest;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const WalkEdge& edge = edges[i];
    if (edge.lo > edge.hi || rest_.after(edge.to, edge.contact) == kInfinity) continue;
    const double total = cost + edge.cost + placed(edge, contact);
    const int to = states_.after(edge);
    if (total >= costs_[to]) continue;
    costs_[to] = total;
    steps_[to] = {node, static_cast<int>(i)};
    before_[to] = state;
    open_.push_back({total, to});
    std::ranges::push_heap(open_, std::greater<>());
  }
}

double WalkWays::cost_over(int state) const {
  return costs_[state] + rest_.after(states_.node(state), states_.contact(state));
}

std::vector<WalkStep> WalkWays::way_to(int state) const {
  std::vector<WalkStep> way;
  for (int at = state; at >= 0; at = before_[at]) way.push_back(steps_[at]);
  std::ranges::reverse(way);
  return way;
}

std::pair<std::vector<WalkStep>, int> WalkWays::way_on_from(int state) const {
  std::vector<WalkStep> way;
  int node = state < 0 ? lattice_.start() : states_.node(state);
  int contact = state < 0 ? -1 : states_.contact(state);
  while (lattice_.goal_at(node) < 0) {
    const std::vector<WalkEdge>& edges = lattice_.edges_from(node, work_);
    WalkStep next{node, -1};
    double least = kInfinity;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const WalkEdge& edge = edges[i];
      if (edge.lo > edge.hi) continue;
      const double rest =
          edge.cost + placed(edge, contact) + rest_.after(edge.to, edge.contact);
      if (rest >= least) continue;
      least = rest;
      next.edge = static_cast<int>(i);
    }
    way.push_back(next);
    node = edges[next.edge].to;
    contact = edges[next.edge].contact;
  }
  return {std::move(way), states_.of(node, contact)};
}

}  // namespace prehensile
