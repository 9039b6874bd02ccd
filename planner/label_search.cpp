#include "planner/label_search.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "planner/confines.h"

namespace prehensile {
namespace {

constexpr double kBucket = 0.3;       // [rad]
constexpr double kMostRotation = 15;  // [rad] to either side that buckets tell apart
constexpr int kBuckets = 100;
constexpr std::size_t kMostLabels = 200'000;           // without a plan
constexpr std::size_t kMostLabelsBeyondPlan = 10'000;  // in search of a better one
constexpr int kMostChecks = 2000;  // of whole chains with the real pad

/// One interval of one leg between two nodes.
struct Edge {
  int to = -1;
  double lo = 0.0, hi = 0.0;  ///< c dtheta that the leg can produce [m]
  double travel = 0.0;        ///< least path length in the flat space [m]
};

struct Label {
  double lo = 0.0, hi = 0.0;  ///< c dtheta produced so far [m]
  double cost = 0.0;          ///< lower bound of J so far
  int node = -1, contact = -1, parent = -1, depth = 0;
};

struct QueueEntry {
  double estimate;
  int label;
  bool operator<(const QueueEntry& other) const {  // priority_queue pops the greatest
    return estimate != other.estimate ? estimate > other.estimate : label > other.label;
  }
};

class LabelSearch {
 public:
  LabelSearch(const Steering& steering, const SearchModel& search,
              const std::vector<Vec2>& nodes, const FlatState& start,
              const GoalPlaces& goals, double to_beat, const Limits& limits, Work& work)
      : steering_(steering),
        search_(search),
        nodes_(nodes),
        start_(start),
        goals_(goals),
        to_beat_(to_beat),
        limits_(limits),
        work_(work),
        contacts_(static_cast<int>(search.contacts.size())) {
    const TurnWindow window = turns_from(search, start.theta);
    ways_ = {search.model->c * window.low, search.model->c * window.high};
    nodes_.push_back(start.p_OF);
    rows_.resize(nodes_.size() * contacts_);
    row_known_.resize(nodes_.size() * contacts_, 0);
    if (search.confines) blocked_.assign(nodes_.size() * contacts_, -1);
    buckets_.assign(nodes_.size() * contacts_ * kBuckets, -1);
    for (const Vec2& node : nodes_) rest_.push_back(least_rest(node));
  }

  std::optional<FoundChain> run() {
    push({0.0, 0.0, 0.0, static_cast<int>(nodes_.size()) - 1, -1, -1, 0});
    const std::size_t most =
        std::isinf(to_beat_) || limits_.improves() ? kMostLabels : kMostLabelsBeyondPlan;
    while (!queue_.empty() && !limits_.reached() && labels_.size() < most &&
           checks_ < kMostChecks) {
      const QueueEntry next = queue_.top();
      queue_.pop();
      if (next.estimate >= to_beat_) break;
      if (!alive(next.label)) continue;
      try_goals(next.label);
      if (labels_[next.label].depth < Chain::kMaxLegs - 1) expand(next.label);
    }
    return best_;
  }

 private:
  double least_rest(const Vec2& node) const {
    double rest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < goals_.count; ++i) {
      rest = std::min(rest, (goals_.places[i].p_OF - node).norm());
    }
    return rest / search_.model->L;
  }

  /// The start is the last node.
  Stop stop_at(int node) const {
    return {nodes_[node], node + 1 == static_cast<int>(nodes_.size())};
  }

  void push(const Label& label) {
    queue_.push({label.cost + rest_[label.node], static_cast<int>(labels_.size())});
    labels_.push_back(label);
  }

  int* buckets_of(const Label& label) {
    return &buckets_[(label.node * contacts_ + label.contact) * kBuckets];
  }

  std::pair<int, int> bucket_range(const Label& label) const {
    const auto bucket = [&](double c_theta) {
      const double theta =
          std::clamp(c_theta / search_.model->c, -kMostRotation, kMostRotation - 1e-9);
      return static_cast<int>((theta + kMostRotation) / kBucket);
    };
    return {bucket(label.lo), bucket(label.hi)};
  }

  bool alive(int index) {
    const Label& label = labels_[index];
    if (label.contact < 0) return true;
    const int* buckets = buckets_of(label);
    const auto [low, high] = bucket_range(label);
    for (int b = low; b <= high; ++b) {
      if (buckets[b] == index) return true;
    }
    return false;
  }

  /// Keeps the label if it is the cheapest for one of its buckets.
  void offer(const Label& label) {
    int* buckets = buckets_of(label);
    const auto [low, high] = bucket_range(label);
    bool improves = false;
    for (int b = low; b <= high; ++b) {
      if (buckets[b] >= 0 && labels_[buckets[b]].cost <= label.cost) continue;
      buckets[b] = static_cast<int>(labels_.size());
      improves = true;
    }
    if (improves) push(label);
  }

  const std::vector<Edge>& edges(int node, int contact) {
    const int row = node * contacts_ + contact;
    if (!row_known_[row]) {
      row_known_[row] = 1;
      if (blocked(node, contact)) return rows_[row];
      for (int to = 0; to + 1 < static_cast<int>(nodes_.size()); ++to) {
        Leg leg;
        if (to == node || blocked(to, contact) ||
            !make_leg(steering_, contact, stop_at(node), stop_at(to), work_, leg)) {
          continue;
        }
        append_edges(leg, to, rows_[row]);
      }
    }
    return rows_[row];
  }

  bool blocked(int node, int contact) {
    if (!search_.confines) return false;
    char& known = blocked_[node * contacts_ + contact];
    if (known < 0) {
      known = is_blocked(steering_.search, contact, nodes_[node], work_) ? 1 : 0;
    }
    return known > 0;
  }

  static void append_edges(const Leg& leg, int to, std::vector<Edge>& edges) {
    for (int i = 0; i < leg.kappas.count; ++i) {
      const auto [lo, hi] = leg.kappas.intervals[i];
      const double least = std::clamp(0.0, lo, hi);
      edges.push_back({to, leg.length * lo, leg.length * hi,
                       leg.length * std::sqrt(1.0 + least * least)});
    }
  }

  double cost_after(const Label& label, int contact, double travel) const {
    return label.cost + (contact != label.contact ? 1.0 : 0.0) +
           travel / search_.model->L;
  }

  void expand(int index) {
    for (int contact = 0; contact < contacts_; ++contact) {
      const Label label = labels_[index];  // a copy: labels_ grows
      for (const Edge& edge : edges(label.node, contact)) {
        const double cost = cost_after(label, contact, edge.travel);
        if (cost + rest_[edge.to] >= to_beat_) continue;
        const double lo = std::max(label.lo + edge.lo, ways_.low);
        const double hi = std::min(label.hi + edge.hi, ways_.high);
        if (lo > hi) continue;
        offer({lo, hi, cost, edge.to, contact, index, label.depth + 1});
      }
    }
  }

  void try_goals(int index) {
    const Label label = labels_[index];
    for (int place = 0; place < goals_.count; ++place) {
      for (int contact = 0; contact < contacts_; ++contact) {
        Leg leg;
        if (make_leg(steering_, contact, stop_at(label.node),
                     {goals_.places[place].p_OF, true}, work_, leg)) {
          try_last_leg(label, index, leg, place);
        }
      }
    }
  }

  void try_last_leg(const Label& label, int index, const Leg& leg, int place) {
    const GoalPlace& goal = goals_.places[place];
    std::vector<Edge> ends;
    append_edges(leg, -1, ends);
    for (int angle = 0; angle < goal.count; ++angle) {
      const double wanted = search_.model->c * (goal.theta[angle] - start_.theta);
      for (const Edge& end : ends) {
        if (wanted < label.lo + end.lo || wanted > label.hi + end.hi) continue;
        const double cost = cost_after(label, leg.contact, end.travel);
        if (cost < to_beat_) try_chain(index, leg, place, angle);
      }
    }
  }

  void try_chain(int index, const Leg& last, int place, int angle) {
    scratch_.count = labels_[index].depth + 1;
    scratch_.legs[scratch_.count - 1] = last;
    for (int i = index; labels_[i].parent >= 0; i = labels_[i].parent) {
      const Label& label = labels_[i];
      make_leg(steering_, label.contact, stop_at(labels_[label.parent].node),
               stop_at(label.node), work_, scratch_.legs[label.depth - 1]);
    }
    const double dtheta = goals_.places[place].theta[angle] - start_.theta;
    if (!solve_chain(search_, dtheta, scratch_, turns_from(search_, start_.theta))) {
      work_.stopped_by.add(PushConstraint::kRotation);
      return;
    }
    if (scratch_.cost >= to_beat_) return;
    ++checks_;
    if (!make_chain_stick(search_, start_.theta, dtheta, scratch_, work_)) {
      return;
    }
    if (scratch_.cost >= to_beat_) return;
    best_ = {scratch_, place, angle};
    to_beat_ = scratch_.cost;
    if (work_.meter) work_.meter->found(scratch_.cost);
  }

  const Steering& steering_;
  const SearchModel& search_;
  std::vector<Vec2> nodes_;
  const FlatState& start_;
  const GoalPlaces& goals_;
  double to_beat_;
  const Limits& limits_;
  Work& work_;
  int contacts_;
  TurnWindow ways_;  // limits of c dtheta after every leg [m]
  std::vector<double> rest_;
  std::vector<std::vector<Edge>> rows_;
  std::vector<char> row_known_;
  std::vector<char> blocked_;  // by node and contact; -1: not known yet
  std::vector<int> buckets_;
  std::vector<Label> labels_;
  std::priority_queue<QueueEntry> queue_;
  Chain scratch_;
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
