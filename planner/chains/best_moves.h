/// The cheapest of what stages of a search find. Internal to the planner.
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "planner/chains/shorten.h"

namespace prehensile {

class BestMoves {
 public:
  /// `search` must outlive it.
  explicit BestMoves(const SearchModel& search) : search_(search) {}

  const SearchModel& search() const { return search_; }
  bool any() const { return moves_.has_value(); }
  double cost() const { return cost_; }  ///< J; infinity: none yet

  /// Keeps moves that cost less than this share of the best so far.
  void offer(std::vector<Move> moves, double worth = 1.0) {
    const double cost = cost_of(search_, moves);
    if (!(cost < worth * cost_)) return;
    cost_ = cost;
    moves_ = std::move(moves);
  }

  /// None if nothing was offered; to be asked for last.
  std::optional<std::vector<Move>> take() { return std::move(moves_); }

 private:
  const SearchModel& search_;
  double cost_ = std::numeric_limits<double>::infinity();
  std::optional<std::vector<Move>> moves_;
};

}  // namespace prehensile
