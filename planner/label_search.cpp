#include "planner/label_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "planner/confines.h"
#include "planner/costs.h"

namespace prehensile {
namespace {

constexpr double kMostRotation = 15;  // [rad] to either side that buckets tell apart
constexpr int kBuckets = 100;
constexpr double kBucketsPerRadian = kBuckets / (2.0 * kMostRotation);
constexpr std::size_t kMostLabels = 200'000;           // without a plan
constexpr std::size_t kMostLabelsBeyondPlan = 10'000;  // in search of a better one
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr int kMostChecks = 2000;  // of whole chains with the real pad

/// One interval of one leg between two nodes.
struct Edge {
  int to = -1;
  double lo = 0.0, hi = 0.0;  ///< c dtheta that the leg can produce [m]
  double cost = 0.0;          ///< least path length in the flat space, over L
};

/// A leg from a node to a place of the goal.
struct LastLeg {
  int place = -1;
  Leg leg;
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
    buckets_per_metre_ = kBucketsPerRadian / search.model->c;
    ways_ = {search.model->c * window.low, search.model->c * window.high};
    nodes_.push_back(start.p_OF);
    rows_.resize(nodes_.size() * contacts_);
    row_known_.resize(nodes_.size() * contacts_, 0);
    usable_.assign(nodes_.size() * contacts_, -1);
    last_legs_.resize(nodes_.size());
    bucket_labels_.assign(nodes_.size() * contacts_ * kBuckets, -1);
    bucket_costs_.assign(bucket_labels_.size(), kFar);
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
    return rest / placement_length(*search_.model);
  }

  /// The start is the last node.
  Stop stop_at(int node) const {
    return {nodes_[node], node + 1 == static_cast<int>(nodes_.size())};
  }

  /// Lower bound of what a label still costs: the way to the goal, and the rotation that
  /// is still missing.
  double least_rest(const Label& label) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < goals_.count; ++i) {
      const GoalPlace& place = goals_.places[i];
      const double way = (place.p_OF - nodes_[label.node]).squaredNorm();
      for (int angle = 0; angle < place.count; ++angle) {
        const double wanted = search_.model->c * (place.theta[angle] - start_.theta);
        const double missing = std::max({0.0, wanted - label.hi, label.lo - wanted});
        least = std::min(least, way + missing * missing);
      }
    }
    return std::sqrt(least) / placement_length(*search_.model);
  }

  void push(const Label& label) {
    queue_.push({label.cost + least_rest(label), static_cast<int>(labels_.size())});
    labels_.push_back(label);
  }

  /// The first bucket of the node and contact of a label.
  std::size_t buckets_of(const Label& label) const {
    return static_cast<std::size_t>(label.node * contacts_ + label.contact) * kBuckets;
  }

  std::pair<int, int> bucket_range(const Label& label) const {
    const auto bucket = [&](double c_theta) {
      const double theta = c_theta / search_.model->c;
      return static_cast<int>(
          std::clamp((theta + kMostRotation) * kBucketsPerRadian, 0.0, kBuckets - 1.0));
    };
    return {bucket(label.lo), bucket(label.hi)};
  }

  bool alive(int index) const {
    const Label& label = labels_[index];
    if (label.contact < 0) return true;
    const int* const labels = &bucket_labels_[buckets_of(label)];
    const auto [low, high] = bucket_range(label);
    return std::find(labels + low, labels + high + 1, index) != labels + high + 1;
  }

  /// The first of the buckets [low, high] that a cost improves, or one more. Most of the
  /// search goes on here: whole blocks at a time, without branches.
  int first_improved(const float* costs, int low, int high, float cost) const {
    constexpr int kBlock = 8;
    int b = low;
    for (; b + kBlock <= high + 1; b += kBlock) {
      int improved = 0;
      for (int k = 0; k < kBlock; ++k) improved |= costs[b + k] > cost ? 1 : 0;
      if (improved != 0) break;
    }
    while (b <= high && costs[b] <= cost) ++b;
    return b;
  }

  /// Keeps the label if it is the cheapest for one of its buckets.
  void offer(const Label& label) {
    const std::size_t first = buckets_of(label);
    const auto [low, high] = bucket_range(label);
    const auto cost = static_cast<float>(label.cost);
    int b = first_improved(&bucket_costs_[first], low, high, cost);
    if (b > high) return;
    for (; b <= high; ++b) {
      if (bucket_costs_[first + b] <= cost) continue;
      bucket_costs_[first + b] = cost;
      bucket_labels_[first + b] = static_cast<int>(labels_.size());
    }
    push(label);
  }

  const std::vector<Edge>& edges(int node, int contact) {
    const int row = node * contacts_ + contact;
    if (!row_known_[row]) {
      row_known_[row] = 1;
      if (!usable(node, contact)) return rows_[row];
      for (int to = 0; to + 1 < static_cast<int>(nodes_.size()); ++to) {
        Leg leg;
        if (to == node || !usable(to, contact) ||
            !make_held_leg(steering_, contact, stop_at(node), stop_at(to), work_, leg)) {
          continue;
        }
        append_edges(leg, to, rows_[row]);
      }
    }
    return rows_[row];
  }

  /// Whether a push by the contact may begin and end there.
  bool usable(int node, int contact) {
    char& known = usable_[node * contacts_ + contact];
    if (known < 0) known = is_usable(node, contact) ? 1 : 0;
    return known > 0;
  }

  bool is_usable(int node, int contact) {
    if (!is_held(steering_.search, contact, stop_at(node))) {
      work_.stopped_by.add(PushConstraint::kGravity);
      return false;
    }
    return !search_.confines ||
           !is_blocked(steering_.search, contact, nodes_[node], work_);
  }

  /// All legs from a node into the goal.
  const std::vector<LastLeg>& last_legs(int node) {
    std::optional<std::vector<LastLeg>>& legs = last_legs_[node];
    if (legs) return *legs;
    legs.emplace();
    LastLeg last;
    for (last.place = 0; last.place < goals_.count; ++last.place) {
      const Stop goal{goals_.places[last.place].p_OF, true};
      for (int contact = 0; contact < contacts_; ++contact) {
        if (make_leg(steering_, contact, stop_at(node), goal, work_, last.leg)) {
          legs->push_back(last);
        }
      }
    }
    return *legs;
  }

  void append_edges(const Leg& leg, int to, std::vector<Edge>& edges) const {
    for (int i = 0; i < leg.kappas.count; ++i) {
      const auto [lo, hi] = leg.kappas.intervals[i];
      const double least = std::clamp(0.0, lo, hi);
      edges.push_back({to, leg.length * lo, leg.length * hi,
                       leg.length * std::sqrt(1.0 + least * least) /
                           placement_length(*search_.model)});
    }
  }

  /// Cost of a label and of a placement, where the contact is another.
  static double cost_with(const Label& label, int contact) {
    return label.cost + (contact != label.contact ? 1.0 : 0.0);
  }

  void expand(int index) {
    for (int contact = 0; contact < contacts_; ++contact) {
      const Label label = labels_[index];  // a copy: labels_ grows
      const double placed = cost_with(label, contact);
      for (const Edge& edge : edges(label.node, contact)) {
        const double cost = placed + edge.cost;
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
    for (const LastLeg& last : last_legs(label.node)) {
      try_last_leg(label, index, last.leg, last.place);
    }
  }

  void try_last_leg(const Label& label, int index, const Leg& leg, int place) {
    const GoalPlace& goal = goals_.places[place];
    ends_.clear();
    append_edges(leg, -1, ends_);
    for (int angle = 0; angle < goal.count; ++angle) {
      const double wanted = search_.model->c * (goal.theta[angle] - start_.theta);
      for (const Edge& end : ends_) {
        if (wanted < label.lo + end.lo || wanted > label.hi + end.hi) continue;
        const double cost = cost_with(label, leg.contact) + end.cost;
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
  double buckets_per_metre_ = 0.0;  // of c dtheta
  TurnWindow ways_;                 // limits of c dtheta after every leg [m]
  std::vector<double> rest_;
  std::vector<std::vector<Edge>> rows_;
  std::vector<char> row_known_;
  std::vector<char> usable_;  // by node and contact; -1: not known yet
  std::vector<std::optional<std::vector<LastLeg>>> last_legs_;  // by node
  std::vector<int> bucket_labels_;   // by node, contact and bucket of the rotation
  std::vector<float> bucket_costs_;  // of these labels
  std::vector<Label> labels_;
  std::priority_queue<QueueEntry> queue_;
  std::vector<Edge> ends_;
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
