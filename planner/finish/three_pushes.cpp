#include "planner/finish/three_pushes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/pad_envelope.h"
#include "planner/bounds/bounds.h"
#include "planner/chains/best_moves.h"
#include "planner/chains/chain_search.h"
#include "planner/costs.h"
#include "planner/steering/draft.h"
#include "planner/steering/fan.h"

namespace prehensile {
namespace {

constexpr std::array kAlong = {0.5, 0.15, 0.85};  // shares of the way, of the fans
constexpr std::array kDepths = {0.02, 0.1, 0.3};  // of moves in their ranges

using Moves = std::vector<Move>;

class ThreePushes {
 public:
  ThreePushes(const SearchModel& search, const PadEnvelope& envelope,
              const FlatState& start, double to_beat, const Limits& limits, Work& work)
      : search_(search),
        envelope_(envelope),
        start_(start),
        to_beat_(to_beat),
        limits_(limits),
        work_(work) {}

  std::optional<Moves> run(const GoalPlaces& goals) {
    for (std::size_t i = 0; i < search_.contacts.size() && !limits_.reached(); ++i) {
      if (search_.contacts[i].stick.is_point) continue;  // each push has its own place
      by_contact(static_cast<int>(i), goals);
    }
    return found_;
  }

 private:
  double room() const { return (to_beat_ - 1.0) * placement_length(*search_.model); }

  Vec3 way_to(const FlatState& goal) const {
    Vec3 way;
    way << goal.p_OF - start_.p_OF, search_.model->c * (goal.theta - start_.theta);
    return way;
  }

  /// Moves at the ends of their ranges make the shortest ways, those within stick more
  /// often all along: both are looked at.
  void by_contact(int contact, const GoalPlaces& goals) {
    SearchModel one = search_;
    one.contacts = {search_.contacts[contact]};
    for (const double along : kAlong) {
      for (const double depth : kDepths) by_fan(one, contact, along, depth, goals);
    }
  }

  /// To all places from one fan: they are next to each other.
  void by_fan(const SearchModel& one, int contact, double along, double depth,
              const GoalPlaces& goals) {
    std::vector<Generator> fan;
    for (int i = 0; i < goals.count; ++i) {
      const GoalPlace& place = goals.places[i];
      for (int j = 0; j < place.count; ++j) {
        const FlatState goal{place.p_OF, place.theta[j]};
        if (way_to(goal).norm() >= room()) continue;
        if (fan.empty()) {
          const Vec2 at = start_.p_OF + along * (goal.p_OF - start_.p_OF);
          fan = fan_at(one, envelope_, at, depth, work_);
          if (fan.empty()) return;
          for (Generator& generator : fan) generator.contact = contact;
        }
        to_goal(fan, goal);
      }
    }
  }

  void to_goal(const std::vector<Generator>& fan, const FlatState& goal) {
    const auto found = combine(fan, way_to(goal));
    if (!found) return;
    double length = 0.0;
    for (int k = 0; k < found->count; ++k) length += found->amount[k];
    if (length >= room()) return;
    for (const Order& order : orders_of(found->count)) {
      auto moves = in_order(fan, *found, order, goal);
      if (!moves) continue;
      moves = shortened(search_, *moves, limits_, work_);
      to_beat_ = cost_of(search_, *moves);
      found_ = std::move(moves);
      return;
    }
  }

  std::optional<Moves> in_order(const std::vector<Generator>& fan,
                                const Combination& found, const Order& order,
                                const FlatState& goal) {
    Moves moves = moves_in_order(search_, fan, found, order, start_);
    if (moves.empty()) return std::nullopt;
    moves.back().to = goal;  // without rounding
    for (const Move& move : moves) {
      if (!move_passes(search_, move, work_)) return std::nullopt;
    }
    return moves;
  }

  const SearchModel& search_;
  const PadEnvelope& envelope_;
  const FlatState& start_;
  double to_beat_;
  const Limits& limits_;
  Work& work_;
  std::optional<Moves> found_;
};

}  // namespace

bool improve_by_three_pushes(const SearchModel& search, const Limits& limits, Work& work,
                             Plan& plan) {
  const Model& model = *search.model;
  if (can_roll(model.scene.object) || plan.rolls() || plan.pushes.empty()) return false;
  const Goal goal = planar_goal(goal_within_limits(model.scene));
  account(model, plan);
  if (plan.cost <= kGoodEnough * guide_bound(model, plan.start, goal)) return false;
  const FlatState from = flat_state(plan.start);
  const PadEnvelope pads(model, search.margin);
  BestMoves best(search);
  const auto look = [&](const GoalPlaces& places, double worth) {
    auto moves = ThreePushes(search, pads, from, worth * std::min(plan.cost, best.cost()),
                             limits, work)
                     .run(places);
    if (moves) best.offer(std::move(*moves));
  };
  look(goal_places(model, goal, from, search.margin), 1.0);
  if (search.margin.is_none()) {
    look(tolerated_places(model, goal, from), kWorthTolerance);
  }
  const auto moves = best.take();
  if (!moves) return false;
  plan.pushes.clear();
  for (const Move& move : *moves) append_move(search, move, plan);
  return true;
}

}  // namespace prehensile
