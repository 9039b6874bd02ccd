#include "planner/walks/walk_rest.h"

#include <vector>

namespace prehensile {

LeastRest rest_of_walks(WalkLattice& lattice, int contacts, const Limits& limits,
                        Work& work) {
  PushesTo pushes(static_cast<std::size_t>(lattice.nodes() * contacts));
  std::vector<bool> seen(static_cast<std::size_t>(lattice.nodes()));
  std::vector<int> open = {lattice.start()};
  seen[lattice.start()] = true;
  while (!open.empty()) {
    if (limits.reached()) return {pushes, contacts, {}};
    const int node = open.back();
    open.pop_back();
    for (const WalkEdge& edge : lattice.edges_from(node, work)) {
      if (edge.lo > edge.hi) continue;
      pushes[edge.to * contacts + edge.contact].push_back({node, edge.cost});
      if (!seen[edge.to]) open.push_back(edge.to);
      seen[edge.to] = true;
    }
  }
  std::vector<int> goals;
  for (int node = 0; node < lattice.nodes(); ++node) {
    if (lattice.goal_at(node) >= 0) goals.push_back(node);
  }
  return {pushes, contacts, goals};
}

}  // namespace prehensile
