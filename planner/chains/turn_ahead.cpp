#include "planner/chains/turn_ahead.h"

#include <algorithm>

#include "planner/chains/least_rest.h"

namespace prehensile {

TurnAhead::TurnAhead(const std::vector<TurningPush>& pushes, int nodes, int contacts,
                     int end, double L)
    : contacts_(contacts),
      L_(L),
      rests_(static_cast<std::size_t>(nodes * (contacts + 1))) {
  PushesTo edges(static_cast<std::size_t>(nodes * contacts));
  for (const TurningPush& push : pushes) {
    edges[push.to * contacts + push.contact].push_back({push.from, 0.0});
  }
  std::vector<std::size_t> next(edges.size());
  for (int k = 0; k < kPrices; ++k) {
    std::ranges::fill(next, 0);
    for (const TurningPush& push : pushes) {
      const int into = push.to * contacts + push.contact;
      const double worth = kTurnPrices[k + 1] * push.cost->turn[k + 1];
      edges[into][next[into]++].cost = (push.cost->travel[k + 1] - worth) / L;
    }
    const LeastRest rest(edges, contacts, std::array{end});
    for (int node = 0; node < nodes; ++node) {
      for (int contact = -1; contact < contacts; ++contact) {
        rests_[node * (contacts + 1) + contact + 1][k] =
            static_cast<float>(rest.after(node, contact));
      }
    }
  }
}

double TurnAhead::least_cost(const TurnCost& paid, int node, int contact, double low,
                             double high) const {
  const Rests& rest = rests(node, contact);
  double most = 0.0;
  for (int k = 0; k < kPrices; ++k) {
    const double price = kTurnPrices[k + 1];
    const double turn = price > 0.0 ? low : high;
    const double travel = paid.travel[k + 1] + price * (turn - paid.turn[k + 1]);
    most = std::max(most, travel / L_ + rest[k]);
  }
  return most;
}

}  // namespace prehensile
