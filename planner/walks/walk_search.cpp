#include "planner/walks/walk_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "planner/chains/shorten.h"
#include "planner/steering/chain.h"
#include "planner/steering/confines.h"
#include "planner/walks/walk_lattice.h"
#include "planner/walks/walk_rest.h"
#include "planner/walks/walk_turns.h"

namespace prehensile {
namespace {

/// Of the lattices that are tried, over the longer side of the object.
constexpr std::array kNodesPerSide = {24, 48};
constexpr int kFinestNodesPerSide = 96;

constexpr int kMostStates = 20'000;  // nodes x contacts of a lattice

/// Turns to either side [rad], and the buckets that tell them apart.
constexpr double kMostTurn = 15.0;
constexpr int kBuckets = 400;

constexpr std::size_t kMostLabels = 400'000;

/// As many labels are offered, and buckets compared, in the time of a stick test, about.
constexpr int kEdgesPerTest = 16;
constexpr int kBucketsPerTest = 400;

/// Walks of which some push turns out not to stick; its edge is cut, and another walk
/// looked for.
constexpr int kMostRepairs = 100;

/// By this, and a share of its turns, an edge loses more than what does not stick [m].
constexpr double kLeastTurn = 1e-6;
constexpr double kShareOfTurns = 0.5;

constexpr float kFar = std::numeric_limits<float>::infinity();

struct Label {
  Turned turned;  ///< so far
  double cost = 0.0;
  int node = -1, contact = -1;
  int parent = -1, edge = -1;  ///< the label before, and the edge of its node
};

/// At a node, the cheapest label for each bucket of turns. In columns: most labels are
/// offered in vain, which is seen several buckets at once.
struct Kept {
  std::vector<float> costs;
  std::vector<int> labels;

  void clear() {
    std::ranges::fill(costs, kFar);
    std::ranges::fill(labels, -1);
  }

  void make_room(int buckets) {
    costs.resize(static_cast<std::size_t>(buckets), kFar);
    labels.resize(static_cast<std::size_t>(buckets), -1);
  }

  /// Whether a label is the cheapest for some bucket from `low` to `high`.
  bool has(int label, int low, int high) const {
    int found = 0;
    for (int b = low; b <= high; ++b) found |= labels[b] == label ? 1 : 0;
    return found != 0;
  }

  /// Puts it into those where it is cheaper; false if there are none.
  bool put(int label, float cost, int low, int high) {
    int dearer = 0;
    for (int b = low; b <= high; ++b) dearer |= costs[b] > cost ? 1 : 0;
    if (dearer == 0) return false;
    for (int b = low; b <= high; ++b) {
      const int replaced = costs[b] > cost ? -1 : 0;  // all bits or none
      labels[b] ^= (labels[b] ^ label) & replaced;
    }
    for (int b = low; b <= high; ++b) costs[b] = std::min(costs[b], cost);
    return true;
  }
};

struct QueueEntry {
  double estimate;
  int label;
  bool operator<(const QueueEntry& other) const {  // priority_queue pops the greatest
    return estimate != other.estimate ? estimate > other.estimate : label > other.label;
  }
};

/// Where a walk ends: a label at a place of the goal, and the angle of that goal.
struct WalkEnd {
  int label = -1;
  double theta = 0.0;
};

class WalkSearch {
 public:
  WalkSearch(const SearchModel& search, WalkLattice& lattice, const FlatState& start,
             const GoalPlaces& goals, double to_beat, const Limits& limits, Work& work)
      : search_(search),
        lattice_(lattice),
        start_(start),
        goals_(goals),
        to_beat_(to_beat),
        limits_(limits),
        work_(work),
        c_(search.model->c),
        rest_(rest_of_walks(lattice, static_cast<int>(search.contacts.size()), limits,
                            work)) {
    const TurnWindow window = turns_from(search, start.theta);
    window_ = {c_ * std::max(window.low, -kMostTurn),
               c_ * std::min(window.high, kMostTurn)};
    kept_.resize(static_cast<std::size_t>(lattice.nodes()));
  }

  std::optional<std::vector<Move>> run() {
    for (int i = 0; i < kMostRepairs && !limits_.reached(); ++i) {
      const std::optional<WalkEnd> end = cheapest_walk();
      if (!end) return std::nullopt;
      std::vector<Move> moves = moves_to(*end);
      if (!moves.empty()) return moves;
    }
    return std::nullopt;
  }

 private:
  std::optional<WalkEnd> cheapest_walk() {
    labels_.clear();
    queue_ = {};
    for (Kept& kept : kept_) kept.clear();
    offer({.node = lattice_.start()});
    while (!queue_.empty() && !limits_.reached() && labels_.size() < kMostLabels) {
      const int next = queue_.top().label;
      queue_.pop();
      if (!is_alive(next)) continue;
      if (const auto theta = goal_met_by(labels_[next])) return WalkEnd{next, *theta};
      expand(next);
    }
    return std::nullopt;
  }

  std::optional<double> goal_met_by(const Label& label) const {
    const int index = lattice_.goal_at(label.node);
    if (index < 0) return std::nullopt;
    const GoalPlace& goal = goals_.places[static_cast<std::size_t>(index)];
    return angle_between(*search_.model, goal, start_.theta + label.turned.lo / c_,
                         start_.theta + label.turned.hi / c_);
  }

  void expand(int index) {
    const Label label = labels_[index];  // a copy: labels_ grows
    const std::vector<WalkEdge>& edges = lattice_.edges_from(label.node, work_);
    work_.other += 1 + static_cast<std::int64_t>(edges.size()) / kEdgesPerTest;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const WalkEdge& edge = edges[i];
      const Turned turned = turned_after(label.turned, edge, window_);
      if (turned.lo > turned.hi || edge.lo > edge.hi) continue;
      const double placed = edge.contact != label.contact ? 1.0 : 0.0;
      offer({turned, label.cost + edge.cost + placed, edge.to, edge.contact, index,
             static_cast<int>(i)});
    }
  }

  std::pair<int, int> buckets_of(const Label& label) const {
    const auto bucket = [&](double c_theta) {
      const double share = 0.5 * (c_theta / (c_ * kMostTurn) + 1.0);
      return std::clamp(static_cast<int>(share * kBuckets), 0, kBuckets - 1);
    };
    return {bucket(label.turned.lo), bucket(label.turned.hi)};
  }

  bool is_alive(int index) const {
    const Label& label = labels_[index];
    const auto [low, high] = buckets_of(label);
    return kept_[label.node].has(index, low, high);
  }

  /// Keeps the label if it is the cheapest for some bucket of its angles.
  void offer(const Label& label) {
    const double estimate = label.cost + rest_.after(label.node, label.contact);
    if (estimate >= to_beat_) return;
    const auto [low, high] = buckets_of(label);
    buckets_compared_ += 1 + high - low;
    work_.other += buckets_compared_ / kBucketsPerTest;
    buckets_compared_ %= kBucketsPerTest;
    Kept& kept = kept_[label.node];
    kept.make_room(kBuckets);
    const int index = static_cast<int>(labels_.size());
    if (!kept.put(index, static_cast<float>(label.cost), low, high)) return;
    queue_.push({estimate, index});
    labels_.push_back(label);
  }

  /// From the end backwards, each push as deep in what it may turn as the whole walk is.
  /// None if some do not stick with the real pads along their way: these are cut.
  std::vector<Move> moves_to(const WalkEnd& end) {
    std::vector<Move> moves;
    bool all_stick = true;
    double turned = c_ * (end.theta - start_.theta);
    for (int i = end.label; labels_[i].parent >= 0; i = labels_[i].parent) {
      const Label& label = labels_[i];
      const Label& before = labels_[label.parent];
      const WalkEdge& edge = lattice_.edges_from(before.node, work_)[label.edge];
      const double turned_by_then =
          turned_before(before.turned, edge, label.turned, turned);
      moves.push_back(
          {edge.contact, state(before.node, turned_by_then), state(label.node, turned)});
      if (!move_passes(search_, moves.back(), work_)) {
        cut(before.node, label.edge, edge, turned - turned_by_then);
        all_stick = false;
      }
      turned = turned_by_then;
    }
    if (!all_stick) return {};
    std::ranges::reverse(moves);
    return moves;
  }

  FlatState state(int node, double c_turned) const {
    return {lattice_.place(node), start_.theta + c_turned / c_};
  }

  /// Leaves the longer part beside a turn that does not stick.
  void cut(int node, int index, const WalkEdge& edge, double turn) {
    const double aside = kShareOfTurns * (edge.hi - edge.lo) + kLeastTurn;
    if (edge.hi - turn > turn - edge.lo) {
      lattice_.narrow(node, index, turn + aside, edge.hi);
    } else {
      lattice_.narrow(node, index, edge.lo, turn - aside);
    }
  }

  const SearchModel& search_;
  WalkLattice& lattice_;
  const FlatState start_;
  const GoalPlaces& goals_;
  const double to_beat_;
  const Limits& limits_;
  Work& work_;
  const double c_;     // [m]
  TurnWindow window_;  // of c dtheta [m]
  LeastRest rest_;
  int buckets_compared_ = 0;  // and not yet counted as work
  std::vector<Kept> kept_;    // by node; room where one is reached
  std::vector<Label> labels_;
  std::priority_queue<QueueEntry> queue_;
};

/// The finest lattice takes seconds, and finds ways too narrow for a margin.
std::vector<int> nodes_per_side(const SearchModel& search) {
  std::vector<int> nodes(kNodesPerSide.begin(), kNodesPerSide.end());
  if (search.margin.is_none()) nodes.push_back(kFinestNodesPerSide);
  return nodes;
}

}  // namespace

bool is_for_walks(const SearchModel& search) {
  const Model& model = *search.model;
  return !model.scene.obstacles && model.F > 0.0 && model.c > 0.0 &&
         std::none_of(
             model.contacts.begin(), model.contacts.end(),
             [&](const PushContact& contact) { return model.needs_space(contact); });
}

std::optional<std::vector<Move>> search_walks(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals, double to_beat,
                                              WalkLattices& lattices,
                                              const Limits& limits, Work& work) {
  if (!is_for_walks(search)) return std::nullopt;
  for (const int per_side : nodes_per_side(search)) {
    WalkLattice& lattice =
        lattices.between(search, start, goals, {per_side}, Steepness::kUsual);
    const auto contacts = static_cast<int>(search.contacts.size());
    if (lattice.nodes() * contacts > kMostStates) break;
    const auto moves =
        WalkSearch(search, lattice, start, goals, to_beat, limits, work).run();
    if (moves) return shortened(search, joined_moves(search, *moves), limits, work);
  }
  return std::nullopt;
}

}  // namespace prehensile
