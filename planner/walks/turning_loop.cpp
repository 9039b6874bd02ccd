#include "planner/walks/turning_loop.h"

#include <algorithm>
#include <cstdint>

#include "scene/constants.h"

namespace prehensile {
namespace {

/// Rounds of policy iteration; a handful are the rule, and what the last one has is a
/// loop, too.
constexpr int kMostRounds = 100;

/// What counts as better, of c times an angle [m], and the least turn of a loop.
constexpr double kGain = 1e-10;
constexpr double kLeastTurn = 1e-7;

/// As many edges are looked at in the time of a stick test, about.
constexpr int kEdgesPerTest = 16;

class Howard {
 public:
  Howard(WalkLattice& lattice, const WalkStates& states, const LeastRest& rest, int side,
         Work& work)
      : lattice_(lattice),
        states_(states),
        side_(side),
        work_(work),
        in_(static_cast<std::size_t>(states.count())),
        policy_(in_.size(), -1),
        next_(in_.size(), -1),
        values_(in_.size(), 0.0),
        best_(static_cast<std::size_t>(states.contacts())) {
    for (int s = 0; s < states.count(); ++s) {
      const int node = states.node(s);
      in_[s] = node < lattice.start() && rest.after(node, states.contact(s)) < kInfinity;
    }
    drop_dead_ends();
  }

  std::optional<TurningLoop> run(const Limits& limits) {
    for (int round = 0; round < kMostRounds; ++round) {
      if (limits.reached()) return std::nullopt;
      find_best_cycle();
      if (on_cycle_ < 0) return std::nullopt;
      set_values();
      if (!improve()) break;
    }
    find_best_cycle();
    TurningLoop loop = cycle();
    if (loop.turn < kLeastTurn) return std::nullopt;
    return loop;
  }

 private:
  double turn(const WalkEdge& edge) const { return side_ > 0 ? edge.hi : -edge.lo; }
  double cost(int state, const WalkEdge& edge) const {
    return edge.cost + (edge.contact != states_.contact(state) ? 1.0 : 0.0);
  }
  bool is_usable(const WalkEdge& edge) const {
    return edge.lo <= edge.hi && in_[states_.after(edge)];
  }
  bool has_state_in(int node) const {
    const auto first = in_.begin() + states_.of(node, 0);
    return std::any_of(first, first + states_.contacts(), [](char in) { return in; });
  }
  const std::vector<WalkEdge>& edges_from(int node) {
    const std::vector<WalkEdge>& edges = lattice_.edges_from(node, work_);
    work_.other += 1 + static_cast<std::int64_t>(edges.size()) / kEdgesPerTest;
    return edges;
  }
  const WalkEdge& chosen(int state) {
    return lattice_.edges_from(states_.node(state), work_)[policy_[state]];
  }

  /// States from which no edge leads to another one; the others begin with their first
  /// edge.
  void drop_dead_ends() {
    for (bool changed = true; changed;) {
      changed = false;
      for (int node = 0; node < lattice_.start(); ++node) {
        if (!has_state_in(node)) continue;
        const std::vector<WalkEdge>& edges = edges_from(node);
        const auto first =
            std::ranges::find_if(edges, [&](const WalkEdge& e) { return is_usable(e); });
        const bool is_dead = first == edges.end();
        for (int k = 0; k < states_.contacts(); ++k) {
          const int s = states_.of(node, k);
          if (is_dead && in_[s] != 0) {
            in_[s] = 0;
            changed = true;
          }
          policy_[s] = static_cast<int>(first - edges.begin());
        }
      }
    }
  }

  /// The best of the cycles that the policy runs into.
  void find_best_cycle() {
    for (int s = 0; s < states_.count(); ++s) {
      if (in_[s]) next_[s] = states_.after(chosen(s));
    }
    ratio_ = -kInfinity;
    on_cycle_ = -1;
    std::vector<int> found_by(in_.size(), -1);
    for (int s = 0; s < states_.count(); ++s) {
      if (!in_[s] || found_by[s] >= 0) continue;
      int at = s;
      for (; found_by[at] < 0; at = next_[at]) found_by[at] = s;
      if (found_by[at] != s) continue;  // runs into an earlier one
      double turned = 0.0;
      double spent = 0.0;
      int around = at;
      do {
        turned += turn(chosen(around));
        spent += cost(around, chosen(around));
        around = next_[around];
      } while (around != at);
      if (turned / spent > ratio_) {
        ratio_ = turned / spent;
        on_cycle_ = at;
      }
    }
  }

  /// Of the states that the policy leads to the best cycle, from there backwards.
  void set_values() {
    std::vector<int> first(in_.size(), -1);  // of the states that come to one; a list
    std::vector<int> other(in_.size(), -1);
    for (int s = 0; s < states_.count(); ++s) {
      if (!in_[s] || s == on_cycle_) continue;
      other[s] = first[next_[s]];
      first[next_[s]] = s;
    }
    std::vector<int> open = {on_cycle_};
    while (!open.empty()) {
      const int to = open.back();
      open.pop_back();
      for (int s = first[to]; s >= 0; s = other[s]) {
        values_[s] = turn(chosen(s)) - ratio_ * cost(s, chosen(s)) + values_[to];
        open.push_back(s);
      }
    }
  }

  /// Whether some state has a better edge than that of the policy.
  bool improve() {
    bool is_better = false;
    for (int node = 0; node < lattice_.start(); ++node) {
      if (!has_state_in(node)) continue;
      find_best_edges(node);
      for (int k = 0; k < states_.contacts(); ++k) {
        const int s = states_.of(node, k);
        if (!in_[s]) continue;
        for (int by = 0; by < states_.contacts(); ++by) {
          const double value = best_[by].value - (by != k ? ratio_ : 0.0);
          if (value <= values_[s] + kGain) continue;
          values_[s] = value;
          policy_[s] = best_[by].edge;
          is_better = true;
        }
      }
    }
    return is_better;
  }

  /// By each contact, placements aside.
  void find_best_edges(int node) {
    std::ranges::fill(best_, Best{});
    const std::vector<WalkEdge>& edges = edges_from(node);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const WalkEdge& edge = edges[i];
      if (!is_usable(edge)) continue;
      const double value = turn(edge) - ratio_ * edge.cost + values_[states_.after(edge)];
      Best& best = best_[edge.contact];
      if (value > best.value) best = {value, static_cast<int>(i)};
    }
  }

  TurningLoop cycle() {
    TurningLoop loop;
    int at = on_cycle_;
    do {
      loop.states.push_back(at);
      loop.steps.push_back({states_.node(at), policy_[at]});
      loop.turn += turn(chosen(at));
      at = next_[at];
    } while (at != on_cycle_);
    return loop;
  }

  struct Best {
    double value = -kInfinity;
    int edge = -1;
  };

  WalkLattice& lattice_;
  const WalkStates& states_;
  const int side_;
  Work& work_;
  std::vector<char> in_;        // by state: of those that loops are looked for among
  std::vector<int> policy_;     // the edge to go on by
  std::vector<int> next_;       // the state after it
  std::vector<double> values_;  // turn beyond the best ratio, on the way to the cycle [m]
  std::vector<Best> best_;      // by contact
  double ratio_ = 0.0;          // of turn to cost, of the best cycle [m]
  int on_cycle_ = -1;           // one of its states
};

}  // namespace

std::optional<TurningLoop> turning_loop(WalkLattice& lattice, const WalkStates& states,
                                        const LeastRest& rest, int side,
                                        const Limits& limits, Work& work) {
  return Howard(lattice, states, rest, side, work).run(limits);
}

}  // namespace prehensile
