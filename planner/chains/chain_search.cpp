#include "planner/chains/chain_search.h"

#include <array>
#include <limits>

#include "planner/chains/lattice.h"

namespace prehensile {
namespace {

/// Margins of the closed form, in units of the plan's, for pads that are not isotropic.
constexpr std::array<double, 3> kSteeringMargins = {3.0, 1.75, 1.0};

/// Lattice nodes over the object, and by the side of the lattice around start and goal.
struct Fineness {
  int nodes, local_nodes_per_side;
};
constexpr double kNoPlan = std::numeric_limits<double>::infinity();
constexpr Fineness kCoarse = {200, 12};
constexpr Fineness kFine = {500, 14};  // in search of better plans
constexpr Fineness kFew = {90, 7};     // the first where plans of two pushes fail
constexpr Fineness kMedium = {140, 7};
constexpr Fineness kMore = {170, 7};
constexpr Fineness kSparse = {50, 7};  // for rotations of the real pads, which cost most

class ChainSearch {
 public:
  ChainSearch(const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
              double bound, const Limits& limits, Work& work)
      : search_(search),
        start_(start),
        goals_(goals),
        bound_(bound),
        limits_(limits),
        work_(work) {
    if (search.exact_everywhere) {
      steering_.push_back({search});
      return;
    }
    for (const double scale : kSteeringMargins) {
      steering_.push_back({with_margin(search, search.margin.scaled(scale))});
    }
  }

  std::optional<FoundChain> run_crossings(double to_beat) {
    for (const Steering& steering : steering_) {
      try_crossings(steering, to_beat);
      if (good_enough() || limits_.reached()) return found_;
    }
    return found_;
  }

  std::optional<FoundChain> run() {
    run_crossings(kNoPlan);
    if (good_enough() || limits_.reached()) return found_;
    for (const Steering& steering : steering_) {
      try_nodes(steering, kCoarse, kNoPlan);
      if (good_enough() || limits_.reached()) return found_;
    }
    return found_;
  }

  std::optional<FoundChain> run_real_pads(const PadEnvelope* envelope, double to_beat) {
    if (limits_.reached()) return found_;
    const Steering steering{search_, true, envelope};
    try_nodes(steering, kSparse, to_beat);
    if (!envelope && !found_ && !limits_.reached()) {
      try_labels(steering, kSparse, to_beat);
    }
    return found_;
  }

  /// Fewer nodes first: the time goes with the square of their number.
  std::optional<FoundChain> run_exact_labels() {
    const Steering& steering = steering_.back();
    if (!limits_.reached()) try_labels(steering, kFew, kNoPlan);
    if (!limits_.reached() && (!found_ || found_->is_near_least())) {
      try_labels(steering, kMedium, kNoPlan);
    }
    if (!limits_.reached() && !found_) try_labels(steering, kCoarse, kNoPlan);
    return found_;
  }

  std::optional<FoundChain> run_labels(const PadEnvelope* envelope, double to_beat) {
    for (const Steering& steering : steering_) {
      if (is_enough() || limits_.reached()) return found_;
      try_labels(steering, to_beat < kNoPlan ? kMore : kCoarse, to_beat);
    }
    if (envelope && !is_enough() && !limits_.reached()) {
      try_labels({search_, true, envelope}, kSparse, to_beat);
    }
    if (limits_.improves() && !is_enough() && !limits_.reached()) {
      try_labels(steering_.back(), kFine, to_beat);
    }
    return found_;
  }

 private:
  bool good_enough() const {
    return found_ && found_->chain.cost <= kGoodEnough * bound_;
  }

  /// Any plan is enough unless better ones are wanted.
  bool is_enough() const { return found_ && (!limits_.improves() || good_enough()); }

  void keep(std::optional<FoundChain> found) {
    if (found && (!found_ || found->chain.cost < found_->chain.cost)) {
      found_ = std::move(found);
      if (work_.meter) work_.meter->found(found_->chain.cost);
    }
  }

  std::vector<Vec2> nodes(const Fineness& fineness) const {
    std::vector<Vec2> nodes = lattice_nodes(search_, fineness.nodes);
    add_local_nodes(search_, start_.p_OF, goals_.places[0].p_OF,
                    fineness.local_nodes_per_side, nodes);
    return nodes;
  }

  std::optional<FoundChain> chain_through(const Steering& steering,
                                          const WayPoint& point) {
    FoundChain found{{}, point.place, point.angle};
    const GoalPlace& goal = goals_.places[point.place];
    Chain& chain = found.chain;
    chain.count = 2;
    const double dtheta = goal.theta[point.angle] - start_.theta;
    const bool sticks = make_leg(steering, point.first, {start_.p_OF, true}, {point.p_OF},
                                 work_, chain.legs[0]) &&
                        make_leg(steering, point.second, {point.p_OF}, {goal.p_OF, true},
                                 work_, chain.legs[1]) &&
                        make_chain_stick(search_, start_.theta, dtheta, chain, work_);
    return sticks ? std::optional(found) : std::nullopt;
  }

  /// Keeps the cheapest of the way-points whose two pushes stick with the real pad.
  void keep_first_that_sticks(const Steering& steering, const BestWayPoints& points) {
    for (int i = 0; i < points.count(); ++i) {
      if (auto found = chain_through(steering, points[i])) return keep(std::move(found));
    }
  }

  /// Dearer plans than what there is are not looked at.
  double least_of(double to_beat) const {
    return found_ ? std::min(to_beat, found_->chain.cost) : to_beat;
  }

  void try_crossings(const Steering& steering, double to_beat) {
    BestWayPoints points(least_of(to_beat));
    for (int place = 0; place < goals_.count && !limits_.reached(); ++place) {
      add_crossings(steering, start_, goals_, place, work_, points);
    }
    keep_first_that_sticks(steering, points);
  }

  void try_nodes(const Steering& steering, const Fineness& fineness, double to_beat) {
    BestWayPoints points(least_of(to_beat));
    add_nodes(steering, nodes(fineness), start_, goals_, work_, points);
    keep_first_that_sticks(steering, points);
  }

  void try_labels(const Steering& steering, const Fineness& fineness, double to_beat) {
    keep(search_labels(steering, search_, nodes(fineness), start_, goals_,
                       least_of(to_beat), limits_, work_));
  }

  const SearchModel& search_;
  const FlatState& start_;
  const GoalPlaces& goals_;
  double bound_;
  const Limits& limits_;
  Work& work_;
  std::vector<Steering> steering_;
  std::optional<FoundChain> found_;
};

}  // namespace

std::optional<FoundChain> search_crossings(const SearchModel& search,
                                           const FlatState& start,
                                           const GoalPlaces& goals, double to_beat,
                                           const Limits& limits, Work& work) {
  if (goals.count == 0) return std::nullopt;
  return ChainSearch(search, start, goals, 0.0, limits, work).run_crossings(to_beat);
}

std::optional<FoundChain> search_exact_chains(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals,
                                              const Limits& limits, Work& work) {
  if (!search.exact_everywhere || goals.count == 0) return std::nullopt;
  return ChainSearch(search, start, goals, 0.0, limits, work).run_exact_labels();
}

std::optional<FoundChain> search_long_chains(const SearchModel& search,
                                             const FlatState& start,
                                             const GoalPlaces& goals,
                                             const PadEnvelope* envelope, double to_beat,
                                             const Limits& limits, Work& work) {
  if (goals.count == 0) return std::nullopt;
  return ChainSearch(search, start, goals, 0.0, limits, work)
      .run_labels(envelope, to_beat);
}

std::optional<FoundChain> search_chains_of_real_pads(
    const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
    const PadEnvelope* envelope, double to_beat, const Limits& limits, Work& work) {
  if (goals.count == 0) return std::nullopt;
  return ChainSearch(search, start, goals, 0.0, limits, work)
      .run_real_pads(envelope, to_beat);
}

std::optional<FoundChain> search_chains(const SearchModel& search, const FlatState& start,
                                        const GoalPlaces& goals, double bound,
                                        const Limits& limits, Work& work) {
  if (goals.count == 0) return std::nullopt;
  return ChainSearch(search, start, goals, bound, limits, work).run();
}

}  // namespace prehensile
