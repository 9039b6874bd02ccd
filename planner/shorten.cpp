#include "planner/shorten.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "planner/chain_search.h"
#include "planner/costs.h"

namespace prehensile {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kFewerPushes = 1e-9;  // of two ways that cost the same, the one of fewer
constexpr std::size_t kMostMovesForCrossings = 40;
constexpr std::size_t kWidestSingle = 120;  // moves that one push may replace

using Moves = std::vector<Move>;

double flat_length(const SearchModel& search, const Move& move) {
  return std::hypot((move.to.p_OF - move.from.p_OF).norm(),
                    search.model->c * (move.to.theta - move.from.theta));
}

/// Shortest path over the states between the moves of a sequence; a node of the graph is
/// a state and the contact that came there.
class Shortcut {
 public:
  Shortcut(const SearchModel& search, const Moves& moves)
      : search_(search),
        moves_(moves),
        contacts_(static_cast<int>(search.contacts.size())),
        nodes_((moves.size() + 1) * (contacts_ + 1)) {
    nodes_[index(0, -1)].cost = 0.0;
  }

  std::size_t states() const { return moves_.size() + 1; }
  FlatState state(std::size_t i) const {
    return i < moves_.size() ? moves_[i].from : moves_.back().to;
  }

  /// Offers a replacement of the moves from state i to state j.
  void offer(std::size_t i, std::size_t j, const Moves& replacement) {
    const double cost = cost_of(search_, replacement) +
                        kFewerPushes * static_cast<double>(replacement.size());
    for (int last = -1; last < contacts_; ++last) {
      const Node& from = nodes_[index(i, last)];
      if (from.cost == kFar) continue;
      const double total =
          from.cost + cost - (replacement.front().contact == last ? 1.0 : 0.0);
      Node& to = nodes_[index(j, replacement.back().contact)];
      if (total < to.cost) to = {total, i, last, replacement};
    }
  }

  Moves best() const {
    std::size_t at = moves_.size();
    int contact = -1;
    for (int c = 0; c < contacts_; ++c) {
      if (nodes_[index(at, c)].cost < nodes_[index(at, contact)].cost) contact = c;
    }
    std::vector<const Moves*> parts;
    while (at != 0) {
      const Node& node = nodes_[index(at, contact)];
      parts.push_back(&node.moves);
      at = node.from;
      contact = node.from_contact;
    }
    Moves moves;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      moves.insert(moves.end(), (*part)->begin(), (*part)->end());
    }
    return moves;
  }

 private:
  struct Node {
    double cost = kFar;
    std::size_t from = 0;
    int from_contact = -1;
    Moves moves;
  };

  std::size_t index(std::size_t state, int contact) const {
    return state * (contacts_ + 1) + contact + 1;
  }

  const SearchModel& search_;
  const Moves& moves_;
  int contacts_;
  std::vector<Node> nodes_;
};

Moves by_single_pushes(const SearchModel& search, const Moves& moves,
                       const Limits& limits, Work& work) {
  Shortcut shortcut(search, moves);
  const int contacts = static_cast<int>(search.contacts.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    shortcut.offer(i, i + 1, {moves[i]});
    for (std::size_t j = i + 2; j < shortcut.states() && j <= i + kWidestSingle; ++j) {
      if (limits.reached()) break;
      for (int contact = 0; contact < contacts; ++contact) {
        const Move move{contact, shortcut.state(i), shortcut.state(j)};
        if (move_passes(search, move, work)) shortcut.offer(i, j, {move});
      }
    }
  }
  return shortcut.best();
}

Moves moves_of(const SearchModel& search, const Chain& chain, const FlatState& from) {
  Moves moves;
  double theta = from.theta;
  for (int k = 0; k < chain.count; ++k) {
    moves.push_back(move_of(search, chain, k, theta));
    theta = moves.back().to.theta;
  }
  return moves;
}

std::optional<Moves> two_pushes(const SearchModel& search, const FlatState& from,
                                const FlatState& to, const Limits& limits, Work& work) {
  GoalPlaces goal;
  goal.count = 1;
  goal.places[0] = {.p_OF = to.p_OF, .count = 1, .theta = {to.theta}};
  const auto found = search_crossings(search, from, goal, limits, work);
  if (!found) return std::nullopt;
  Moves moves = moves_of(search, found->chain, from);
  moves.back().to = to;
  return moves;
}

Moves by_two_pushes(const SearchModel& search, const Moves& moves, const Limits& limits,
                    Work& work) {
  Shortcut shortcut(search, moves);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    shortcut.offer(i, i + 1, {moves[i]});
    for (std::size_t j = i + 3; j < shortcut.states(); ++j) {
      if (limits.reached()) break;
      const auto pushes =
          two_pushes(search, shortcut.state(i), shortcut.state(j), limits, work);
      if (pushes) shortcut.offer(i, j, *pushes);
    }
  }
  return shortcut.best();
}

}  // namespace

double cost_of(const SearchModel& search, const std::vector<Move>& moves) {
  double length = 0.0;
  int placements = 0;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    length += flat_length(search, moves[k]);
    if (k == 0 || moves[k].contact != moves[k - 1].contact) ++placements;
  }
  return placements + length / placement_length(*search.model);
}

std::vector<Move> shortened(const SearchModel& search, const std::vector<Move>& moves,
                            const Limits& limits, Work& work) {
  Moves shorter = by_single_pushes(search, moves, limits, work);
  for (std::size_t before = shorter.size() + 1;
       shorter.size() < before && shorter.size() > 2 &&
       shorter.size() <= kMostMovesForCrossings && !limits.reached();) {
    before = shorter.size();
    shorter = by_two_pushes(search, shorter, limits, work);
  }
  return shorter;
}

}  // namespace prehensile
