#include "planner/chains/label_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "planner/chains/leg_graph.h"
#include "planner/chains/narrow_chain.h"
#include "planner/chains/turn_ahead.h"
#include "planner/chains/turn_buckets.h"
#include "planner/costs.h"

namespace prehensile {
namespace {

/// Labels of a search for a first plan, and with a margin, where there often is none; in
/// search of a better one, and for as long as it may take.
constexpr std::size_t kMostLabels = 30'000;
constexpr std::size_t kMostLabelsWithMargin = 12'000;
constexpr std::size_t kMostLabelsBeyondPlan = 1000;
constexpr std::size_t kMostLabelsToImprove = 200'000;

constexpr int kMostNodesAhead = 500;  // all of whose edges are found
constexpr double kRounding = 1e-7;    // [m] of costs

/// What is known to be paid still counts so many times where the next label is chosen:
/// that finds a plan soon, and what cannot be cheaper than it is left out from then on.
constexpr double kHaste = 5.0;

/// [J] that a way to a node must save to be looked at besides others.
constexpr float kLeastGain = 0.05F;
constexpr float kLeastGainOfSlowLegs = 0.25F;

constexpr int kMostChecks = 2000;  // of whole chains with the real pad

struct Label {
  TurnCost paid;       ///< so far
  int placements = 0;  ///< so far
  int node = -1, contact = -1, parent = -1, depth = 0;
};

struct QueueEntry {
  double rank;
  double least;  ///< J of plans that begin like this, from below
  int label;
  bool operator<(const QueueEntry& other) const {  // priority_queue pops the greatest
    return rank != other.rank ? rank > other.rank : label > other.label;
  }
};

class LabelSearch {
 public:
  LabelSearch(const Steering& steering, const SearchModel& search,
              const std::vector<Vec2>& nodes, const FlatState& start,
              const GoalPlaces& goals, double to_beat, const Limits& limits, Work& work)
      : search_(search),
        start_(start),
        goals_(goals),
        to_beat_(to_beat),
        limits_(limits),
        work_(work),
        graph_(steering, search, nodes, start, goals, work),
        has_slow_legs_(steering.real_pads && !steering.envelope),
        looks_ahead_(graph_.goal() <= kMostNodesAhead && !has_slow_legs_),
        L_(placement_length(*search.model)),
        buckets_(graph_.goal() * graph_.contacts(), search.model->c, L_) {
    const TurnWindow window = turns_from(search, start.theta);
    ways_ = {search.model->c * window.low, search.model->c * window.high};
    for (int node = 0; node < graph_.goal(); ++node) {
      way_.push_back(least_way(graph_.place(node)));
    }
    find_wanted();
  }

  std::optional<FoundChain> run() {
    if (looks_ahead_) look_ahead();
    const Label begin{.node = graph_.start()};
    least_ = estimate(begin);
    if (least_ >= to_beat_) return std::nullopt;
    push(begin, least_);
    const std::size_t most = most_labels();
    while (!queue_.empty() && !limits_.reached() && labels_.size() < most &&
           checks_ < kMostChecks) {
      const QueueEntry next = queue_.top();
      queue_.pop();
      if (next.least >= to_beat_ || !alive(next.label)) continue;
      try_goals(next.label);
      if (labels_[next.label].depth < Chain::kMaxLegs - 1) expand(next.label);
    }
    return best_;
  }

 private:
  std::size_t most_labels() const {
    if (limits_.improves()) return kMostLabelsToImprove;
    if (!std::isinf(to_beat_)) return kMostLabelsBeyondPlan;
    return search_.margin.is_none() ? kMostLabels : kMostLabelsWithMargin;
  }

  /// By the angles of a place, which are whole turns apart: what the goals ask for.
  void find_wanted() {
    wanted_.fill({1.0, 0.0});
    for (int i = 0; i < goals_.count; ++i) {
      const GoalPlace& place = goals_.places[i];
      for (int angle = 0; angle < place.count; ++angle) {
        const double turn = turn_to(place, angle);
        TurnWindow& window = wanted_[angle];
        if (window.low > window.high) window = {turn, turn};
        window = {std::min(window.low, turn), std::max(window.high, turn)};
      }
    }
  }

  /// [m] of c dtheta.
  double turn_to(const GoalPlace& place, int angle) const {
    return search_.model->c * (place.theta[angle] - start_.theta);
  }

  /// All edges, and what is to be paid from every node.
  void look_ahead() {
    std::vector<TurningPush> pushes;
    for (int node = 0; node < graph_.goal(); ++node) {
      if (limits_.reached()) return;
      for (int contact = 0; contact < graph_.contacts(); ++contact) {
        for (const LegEdge& edge : graph_.edges(node, contact)) {
          pushes.push_back({node, contact, edge.to, &edge.paid});
        }
      }
      for (const LastLeg& last : graph_.last_legs(node)) {
        for (const LegEdge& edge : last.edges) {
          pushes.push_back({node, last.leg.contact, edge.to, &edge.paid});
        }
      }
    }
    const int nodes = graph_.goal() + 1;
    ahead_.emplace(pushes, nodes, graph_.contacts(), graph_.goal(), L_);
  }

  /// Lower bound of what a node still costs after a push by a contact.
  double rest(int node, int contact) const {
    return ahead_ ? ahead_->after(node, contact) : way_[node];
  }

  double least_way(const Vec2& node) const {
    double rest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < goals_.count; ++i) {
      rest = std::min(rest, (goals_.places[i].p_OF - node).norm());
    }
    return rest / L_;
  }

  /// J of a label, for the turn that costs least.
  double cost(const Label& label) const {
    return label.placements + label.paid.travel[TurnCost::kFree] / L_;
  }

  /// J of the best plan that begins as a label does, from below.
  double estimate(const Label& label) const {
    double least = std::numeric_limits<double>::infinity();
    for (const TurnWindow& wanted : wanted_) {
      if (wanted.low > wanted.high) continue;
      least = std::min(least,
                       ahead_ ? ahead_->least_cost(label.paid, label.node, label.contact,
                                                   wanted.low, wanted.high)
                              : straight_cost(label, wanted));
    }
    return label.placements + least;
  }

  /// The straight way to the goal, and the turn that is still missing.
  double straight_cost(const Label& label, const TurnWindow& wanted) const {
    const double missing =
        std::max({0.0, wanted.low - label.paid.high(), label.paid.low() - wanted.high});
    return label.paid.travel[TurnCost::kFree] / L_ +
           std::hypot(way_[label.node], missing / L_);
  }

  void push(const Label& label, double least) {
    const double paid = cost(label);
    const double haste = looks_ahead_ ? kHaste : 1.0;
    queue_.push({paid + haste * (least - paid), least, static_cast<int>(labels_.size())});
    labels_.push_back(label);
  }

  int state_of(const Label& label) const {
    return label.node * graph_.contacts() + label.contact;
  }

  bool alive(int index) const {
    const Label& label = labels_[index];
    return label.contact < 0 || buckets_.holds(state_of(label), label.paid, index);
  }

  /// Keeps the label if it may lead to a cheaper plan.
  void offer(const Label& label) {
    const double least = estimate(label);
    if (least >= to_beat_) return;
    if (buckets_.offer(state_of(label), label.paid, label.placements,
                       has_slow_legs_ ? kLeastGainOfSlowLegs : kLeastGain,
                       static_cast<int>(labels_.size()))) {
      push(label, least);
    }
  }

  /// A label, and a push that leads to `node`; false if that turns the object too far.
  bool extend(const Label& label, int index, int contact, int node, const TurnCost& push,
              Label& next) const {
    next = {label.paid,
            label.placements + (is_placed_anew(search_, contact, label.contact) ? 1 : 0),
            node,
            contact,
            index,
            label.depth + 1};
    next.paid += push;
    return next.paid.confine(static_cast<float>(ways_.low),
                             static_cast<float>(ways_.high));
  }

  void expand(int index) {
    Label next;
    for (int contact = 0; contact < graph_.contacts(); ++contact) {
      const Label label = labels_[index];  // a copy: labels_ grows
      const double paid =
          cost(label) + (is_placed_anew(search_, contact, label.contact) ? 1 : 0);
      for (const LegEdge& edge : graph_.edges(label.node, contact)) {
        if (paid + edge.cost + rest(edge.to, contact) >= to_beat_) continue;
        if (extend(label, index, contact, edge.to, edge.paid, next)) offer(next);
      }
    }
  }

  void try_goals(int index) {
    const Label label = labels_[index];
    for (const LastLeg& last : graph_.last_legs(label.node)) {
      try_last_leg(label, index, last);
    }
    graph_.renew();
  }

  void try_last_leg(const Label& label, int index, const LastLeg& last) {
    const GoalPlace& goal = goals_.places[last.place];
    Label whole;
    for (const LegEdge& end : last.edges) {
      if (!extend(label, index, last.leg.contact, end.to, end.paid, whole)) continue;
      for (int angle = 0; angle < goal.count; ++angle) {
        const double turn = turn_to(goal, angle);
        if (turn < whole.paid.low() - kRounding || turn > whole.paid.high() + kRounding) {
          continue;
        }
        const double least = whole.placements + whole.paid.least_travel(turn) / L_;
        if (least < to_beat_) try_chain(index, last.leg, last.place, angle);
      }
    }
  }

  void try_chain(int index, const Leg& last, int place, int angle) {
    if (!make_chain(index, last)) return;
    const double dtheta = goals_.places[place].theta[angle] - start_.theta;
    ++checks_;
    NarrowedChain result;
    if (has_slow_legs_) {
      result.sticks = make_chain_stick(search_, start_.theta, dtheta, chain_, work_);
    } else {
      result =
          narrow_until_it_sticks(search_, start_.theta, dtheta, to_beat_, chain_, work_);
    }
    learn(index, place, result);
    if (!result.sticks || chain_.cost >= to_beat_) return;
    best_ = {chain_, place, angle, least_};
    to_beat_ = chain_.cost;
    if (work_.meter) work_.meter->found(chain_.cost);
  }

  /// The legs that lead to a label, and the last one.
  bool make_chain(int index, const Leg& last) {
    chain_.count = labels_[index].depth + 1;
    chain_.legs[chain_.count - 1] = last;
    for (int i = index; labels_[i].parent >= 0; i = labels_[i].parent) {
      const Label& label = labels_[i];
      const int from = labels_[label.parent].node;
      Leg& leg = chain_.legs[label.depth - 1];
      if (!graph_.make(label.contact, from, label.node, leg)) return false;
    }
    return true;
  }

  /// What legs are found not to be able to do is no part of further chains.
  void learn(int index, int place, const NarrowedChain& result) {
    const int last = chain_.count - 1;
    if (result.narrowed[last]) {
      graph_.narrow_last(chain_.legs[last], labels_[index].node, place);
    }
    for (int i = index; labels_[i].parent >= 0; i = labels_[i].parent) {
      const int leg = labels_[i].depth - 1;
      if (!result.narrowed[leg]) continue;
      graph_.narrow(chain_.legs[leg], labels_[labels_[i].parent].node, labels_[i].node);
    }
  }

  const SearchModel& search_;
  const FlatState& start_;
  const GoalPlaces& goals_;
  double to_beat_;
  const Limits& limits_;
  Work& work_;
  LegGraph graph_;
  bool has_slow_legs_;  // those of cans, which take long to make and to check
  bool looks_ahead_;
  double L_;
  TurnBuckets buckets_;
  TurnWindow ways_;                   // limits of c dtheta after every leg [m]
  std::array<TurnWindow, 3> wanted_;  // [m] of c dtheta; low > high: none
  std::vector<double> way_;           // straight to the nearest goal, by node, over L
  std::optional<TurnAhead> ahead_;    // where it pays to look
  double least_ = 0.0;                // J of any plan, from below
  std::vector<Label> labels_;
  std::priority_queue<QueueEntry> queue_;
  Chain chain_;
  int checks_ = 0;
  std::optional<FoundChain> best_;
};

}  // namespace

std::optional<FoundChain> search_labels(const Steering& steering,
                                        const SearchModel& search,
                                        const std::vector<Vec2>& nodes,
                                        const FlatState& start, const GoalPlaces& goals,
                                        double to_beat, const Limits& limits,
                                        Work& work) {
  return LabelSearch(steering, search, nodes, start, goals, to_beat, limits, work).run();
}

}  // namespace prehensile
