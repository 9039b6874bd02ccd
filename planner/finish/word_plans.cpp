#include "planner/finish/word_plans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/bounds/bounds.h"
#include "planner/bounds/word_node.h"
#include "planner/costs.h"
#include "planner/finish/polish.h"
#include "planner/steering/chain.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

constexpr double kWorthwhile = 0.99;  // of the cost of the plan, for another one
constexpr double kPromising = 1.3;    // of it, for chains before they are polished
constexpr std::size_t kMostKept = 6;  // sequences of contacts that are polished

/// Keeps the cheapest chain of each sequence of contacts.
class Candidates {
 public:
  Candidates(const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
             double cost, Work& work)
      : search_(search), start_(start), goals_(goals), cost_(cost), work_(work) {}

  void offer(const WordNode& node) {
    ++work_.other;
    Vec2 goal;
    double turn = 0.0;
    Chain& chain = scratch_;
    if (!end_of(node, goal, turn) || !make_legs(node, goal, chain) ||
        !solve_chain(search_, turn, chain, turns_from(search_, start_.theta)) ||
        !(chain.cost < kPromising * cost_)) {
      return;
    }
    const auto same = std::ranges::find_if(
        kept_, [&](const Chain& other) { return is_same_word(chain, other); });
    const double to_beat =
        same != kept_.end() ? same->cost : std::numeric_limits<double>::infinity();
    if (!(chain.cost < to_beat) ||
        !make_chain_stick(search_, start_.theta, turn, chain, work_) ||
        !(chain.cost < to_beat)) {
      return;
    }
    if (same != kept_.end()) {
      *same = chain;
    } else {
      kept_.push_back(chain);
    }
  }

  /// Cheapest first.
  std::vector<Chain> best() && {
    std::ranges::stable_sort(kept_, {}, &Chain::cost);
    if (kept_.size() > kMostKept) kept_.resize(kMostKept);
    return std::move(kept_);
  }

 private:
  static bool is_same_word(const Chain& a, const Chain& b) {
    const auto contact = [](const Leg& leg) { return leg.contact; };
    return std::ranges::equal(a.legs.begin(), a.legs.begin() + a.count, b.legs.begin(),
                              b.legs.begin() + b.count, {}, contact, contact);
  }

  /// The goal that the node ends at, and the turn to it.
  bool end_of(const WordNode& node, Vec2& place, double& turn) const {
    const Vec2& wanted = node.box[node.points - 1].centre;
    const double middle = 0.5 * (node.turn_low + node.turn_high);
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < goals_.count; ++i) {
      for (int j = 0; j < goals_.places[i].count; ++j) {
        const double dtheta = goals_.places[i].theta[j] - start_.theta;
        const double off = (goals_.places[i].p_OF - wanted).norm() +
                           search_.model->c * std::abs(dtheta - middle);
        if (off >= nearest) continue;
        nearest = off;
        place = goals_.places[i].p_OF;
        turn = dtheta;
      }
    }
    return std::isfinite(nearest);
  }

  /// Through the centres of the boxes.
  bool make_legs(const WordNode& node, const Vec2& goal, Chain& chain) {
    chain.count = node.points - 1;
    Stop from{start_.p_OF, true};
    for (int k = 0; k < chain.count; ++k) {
      const bool last = k + 1 == chain.count;
      const Stop to = last ? Stop{goal, true} : Stop{node.box[k + 1].centre};
      if (!make_any_leg(node.contact[k + 1], from, to, chain.legs[k])) return false;
      from = to;
    }
    return true;
  }

  bool make_any_leg(int contact, const Stop& from, const Stop& to, Leg& leg) {
    for (std::size_t i = 0; i < search_.contacts.size(); ++i) {
      if (search_.contacts[i].contact == contact &&
          make_leg({search_}, static_cast<int>(i), from, to, work_, leg)) {
        return true;
      }
    }
    return false;
  }

  const SearchModel& search_;
  const FlatState& start_;
  const GoalPlaces& goals_;
  double cost_;
  Work& work_;
  Chain scratch_;
  std::vector<Chain> kept_;
};

}  // namespace

bool improve_by_words(const SearchModel& search, const Limits& limits, Work& work,
                      Plan& plan) {
  const Model& model = *search.model;
  if (!search.exact_everywhere || plan.rolls() || plan.pushes.empty() ||
      limits.reached()) {
    return false;
  }
  const Goal goal = planar_goal(goal_within_limits(model.scene));
  account(model, plan);
  if (plan.cost <= kGapAsked * trivial_bound(model, plan.start, goal)) return false;
  const FlatState from = flat_state(plan.start);
  const GoalPlaces goals = goal_places(model, goal, from, search.margin);
  Candidates candidates(search, from, goals, plan.cost, work);
  std::int64_t nodes = kBoundNodes;
  visit_words(model, plan.start, goal, plan.cost, search.margin, nodes,
              [&](const WordNode& node) { candidates.offer(node); });
  bool improved = false;
  for (const Chain& chain : std::move(candidates).best()) {
    Plan other = plan;
    other.pushes.clear();
    append_chain(search, from, chain, other);
    polish(search, limits, work, other);
    account(model, other);
    if (other.cost < kWorthwhile * plan.cost && reaches(goal, other.goal)) {
      plan = std::move(other);
      improved = true;
    }
  }
  return improved;
}

}  // namespace prehensile
