#include "planner/chains/shorten.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "planner/chains/chain_search.h"
#include "planner/costs.h"

namespace prehensile {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kFewerPushes = 1e-9;  // of two ways that cost the same, the one of fewer
constexpr std::size_t kWidestSingle = 120;  // moves that one push may replace
constexpr std::size_t kWidestPair = 200;    // and two pushes

/// Of sequences up to so long every part is tried; of longer ones parts of lengths that
/// grow by a quarter; and of still longer ones few.
constexpr std::size_t kFewMoves = 40;
constexpr std::size_t kSomeMoves = 120;

/// Relative gain for which a sequence is gone through again.
constexpr double kWorthAnother = 1e-3;

using Moves = std::vector<Move>;

/// Directions in (p_OF, c theta) closer than this are one [rad].
constexpr double kSameDirection = 1e-9;

Vec3 direction_of(const SearchModel& search, const Move& move) {
  const Vec2 dp = move.to.p_OF - move.from.p_OF;
  const double turn = search.model->c * (move.to.theta - move.from.theta);
  return Vec3(dp.x(), dp.y(), turn).normalized();
}

bool is_one_move(const SearchModel& search, const Move& first, const Move& second) {
  return first.contact == second.contact &&
         (direction_of(search, first) - direction_of(search, second)).norm() <
             kSameDirection;
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

using ChainFinder = std::optional<FoundChain> (*)(const SearchModel&, const FlatState&,
                                                  const GoalPlaces&, const Limits&,
                                                  Work&);

std::optional<FoundChain> search_any_crossing(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals,
                                              const Limits& limits, Work& work) {
  return search_crossings(search, start, goals, kFar, limits, work);
}

std::optional<FoundChain> search_nodes(const SearchModel& search, const FlatState& start,
                                       const GoalPlaces& goals, const Limits& limits,
                                       Work& work) {
  constexpr double kNoBound = 0.0;
  return search_chains(search, start, goals, kNoBound, limits, work);
}

std::optional<Moves> two_pushes(ChainFinder find, const SearchModel& search,
                                const FlatState& from, const FlatState& to,
                                const Limits& limits, Work& work) {
  GoalPlaces goal;
  goal.count = 1;
  goal.places[0] = {.p_OF = to.p_OF, .count = 1, .theta = {to.theta}};
  // What is found between two states is no plan to report.
  ProgressMeter* const meter = std::exchange(work.meter, nullptr);
  const auto found = find(search, from, goal, limits, work);
  work.meter = meter;
  if (!found) return std::nullopt;
  Moves moves = moves_of(search, from, found->chain);
  moves.back().to = to;
  return moves;
}

/// The cheapest way by parts of all lengths.
Moves by_any_two_pushes(ChainFinder find, const SearchModel& search, const Moves& moves,
                        const Limits& limits, Work& work) {
  const bool few = moves.size() <= kFewMoves;
  const auto next = [few](std::size_t count) {
    return few ? count + 1 : count + count / 4 + 1;
  };
  Shortcut shortcut(search, moves);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    shortcut.offer(i, i + 1, {moves[i]});
    for (std::size_t count = 3; i + count <= moves.size(); count = next(count)) {
      if (limits.reached()) break;
      const std::size_t j = i + count;
      const auto pushes =
          two_pushes(find, search, shortcut.state(i), shortcut.state(j), limits, work);
      if (pushes) shortcut.offer(i, j, *pushes);
    }
  }
  return shortcut.best();
}

/// From the start on, the longest part that two pushes can replace, then on from its end.
Moves by_far_two_pushes(ChainFinder find, const SearchModel& search, const Moves& moves,
                        const Limits& limits, Work& work) {
  Moves shorter;
  const auto is_replaced = [&](std::size_t i, std::size_t count) {
    const Moves part(moves.begin() + i, moves.begin() + i + count);
    const auto pushes =
        two_pushes(find, search, part.front().from, part.back().to, limits, work);
    if (!pushes || cost_of(search, *pushes) >= cost_of(search, part)) return false;
    shorter.insert(shorter.end(), pushes->begin(), pushes->end());
    return true;
  };
  for (std::size_t i = 0; i < moves.size();) {
    std::size_t replaced = 0;
    for (std::size_t count = std::min(kWidestPair, moves.size() - i);
         replaced == 0 && count > 2 && !limits.reached(); count = count * 2 / 3) {
      if (is_replaced(i, count)) replaced = count;
    }
    if (replaced == 0) shorter.push_back(moves[i]);
    i += std::max<std::size_t>(1, replaced);
  }
  return shorter;
}

/// Goes through a sequence for as long as that makes it cheaper.
Moves by_two_pushes(ChainFinder find, const SearchModel& search, Moves moves,
                    const Limits& limits, Work& work) {
  double before = kFar;
  for (double cost = cost_of(search, moves);
       cost < before * (1.0 - kWorthAnother) && moves.size() > 2 && !limits.reached();) {
    before = cost;
    const auto pass = moves.size() > kSomeMoves ? by_far_two_pushes : by_any_two_pushes;
    moves = pass(find, search, moves, limits, work);
    cost = cost_of(search, moves);
  }
  return moves;
}

}  // namespace

std::vector<Move> joined_moves(const SearchModel& search,
                               const std::vector<Move>& moves) {
  Work uncounted{.budget = std::numeric_limits<std::int64_t>::max()};
  std::vector<Move> result;
  for (const Move& move : moves) {
    if (!result.empty() && is_one_move(search, result.back(), move)) {
      const Move whole{move.contact, result.back().from, move.to};
      if (move_sticks(search, whole.contact, whole.from, whole.to, uncounted) &&
          move_passes(search, whole, uncounted)) {
        result.back() = whole;
        continue;
      }
    }
    result.push_back(move);
  }
  return result;
}

double cost_of(const SearchModel& search, const std::vector<Move>& moves) {
  double length = 0.0;
  int placements = 0;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    length += flat_distance(*search.model, moves[k].from, moves[k].to);
    const int before = k > 0 ? moves[k - 1].contact : -1;
    if (is_placed_anew(search, moves[k].contact, before)) ++placements;
  }
  return placements + length / placement_length(*search.model);
}

std::vector<Move> shortened(const SearchModel& search, const std::vector<Move>& moves,
                            const Limits& limits, Work& work) {
  return by_two_pushes(&search_any_crossing, search,
                       by_single_pushes(search, moves, limits, work), limits, work);
}

std::vector<Move> shortened_over_lattice(const SearchModel& search,
                                         const std::vector<Move>& moves,
                                         const Limits& limits, Work& work) {
  return by_two_pushes(&search_nodes, search,
                       by_single_pushes(search, moves, limits, work), limits, work);
}

}  // namespace prehensile
