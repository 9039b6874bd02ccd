#include "planner/chains/fan_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/chains/lattice.h"
#include "planner/chains/shorten.h"
#include "planner/geometry/inner_path.h"
#include "planner/steering/chain.h"
#include "planner/steering/confines.h"
#include "planner/steering/fan.h"

namespace prehensile {
namespace {

constexpr std::array<int, 13> kPieces = {1, 2, 3, 4, 6, 9, 14, 20, 30, 60, 120, 240, 400};
constexpr int kMostPiecesWhereThin = 9;  // more do not help where control is lost
constexpr std::array<double, 3> kDepths = {0.02, 0.1, 0.3};  // of moves in their ranges
constexpr std::array<int, 3> kLegPieces = {8, 32, 128};
constexpr double kDearRotation = 1e3;  // in place of kFreeRotationCost, under limits
constexpr int kBranchNodes = 200;      // lattice of places where legs may begin
constexpr int kMostBranches = 8;
constexpr int kMostPlacesOfLegs = 8;  // of a goal, which lie close together

using Moves = std::vector<Move>;

bool limits_theta(const Scene& scene) {
  return scene.limits && (scene.limits->theta_low || scene.limits->theta_high);
}

class FanSearch {
 public:
  FanSearch(const SearchModel& search, const PadEnvelope& envelope, const Limits& limits,
            Work& work)
      : search_(search), fans_(search, envelope), limits_(limits), work_(work) {}

  std::optional<Moves> run(const FlatState& start, const GoalPlaces& goals) {
    for (int i = 0; i < goals.count && !limits_.reached(); ++i) {
      const GoalPlace& place = goals.places[i];
      for (int j = 0; j < place.count; ++j) {
        if (auto moves = walk(start, {place.p_OF, place.theta[j]})) return moves;
      }
    }
    const int stride = std::max(1, goals.count / kMostPlacesOfLegs);
    for (int i = 0; i < goals.count && !limits_.reached(); i += stride) {
      const GoalPlace& place = goals.places[i];
      if (auto moves = with_legs(start, {place.p_OF, place.theta[0]})) return moves;
    }
    return std::nullopt;
  }

 private:
  /// Along the shortest path on the object, in pieces short enough.
  std::optional<Moves> walk(const FlatState& from, const FlatState& to) {
    const std::vector<Vec2> path =
        inner_path(search_.model->pad_face, from.p_OF, to.p_OF);
    if (path.empty()) return std::nullopt;
    // Limits on theta want short pieces, also where the object is hard to control.
    const bool thin = !limits_theta(search_.model->scene) &&
                      (!controllable(from.p_OF) || !controllable(to.p_OF));
    for (const int pieces : kPieces) {
      if (thin && pieces > kMostPiecesWhereThin) return std::nullopt;
      for (const double depth : kDepths) {
        if (limits_.reached()) return std::nullopt;
        if (auto moves = walk_pieces(from, to, cut_path(path, pieces), depth)) {
          return moves;
        }
      }
    }
    return std::nullopt;
  }

  std::optional<Moves> walk_pieces(const FlatState& from, const FlatState& to,
                                   const std::vector<Vec2>& places, double depth) {
    Moves moves;
    FlatState at = from;
    const std::size_t pieces = places.size() - 1;
    for (std::size_t k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      FlatState next{places[k], std::lerp(from.theta, to.theta, share)};
      if (!step(fans_.at(at.p_OF, depth, work_), at, next, false, moves)) {
        return std::nullopt;
      }
      at = next;
    }
    return moves;
  }

  /// Appends the moves of one piece; with `drifts` the angle of `next` is set by them.
  bool step(const std::vector<Generator>& fan, const FlatState& at, FlatState& next,
            bool drifts, Moves& moves) {
    Vec3 wanted;
    wanted << next.p_OF - at.p_OF,
        drifts ? 0.0 : search_.model->c * (next.theta - at.theta);
    const auto found =
        combine(fan, wanted,
                limits_theta(search_.model->scene) ? kDearRotation : kFreeRotationCost);
    return found && append(fan, *found, at, next, drifts, moves);
  }

  /// In the first order in which every move sticks, those that go on with the last
  /// contact first.
  bool append(const std::vector<Generator>& fan, const Combination& found,
              const FlatState& at, FlatState& next, bool drifts, Moves& moves) {
    const int contact = moves.empty() ? -1 : moves.back().contact;
    for (const bool wants_to_go_on : {true, false}) {
      for (const Order& order : orders_of(found.count)) {
        const bool goes_on = fan[found.generator[order[0]]].contact == contact;
        if (goes_on != wants_to_go_on) continue;
        if (append_in_order(fan, found, order, at, next, drifts, moves)) return true;
      }
    }
    return false;
  }

  bool append_in_order(const std::vector<Generator>& fan, const Combination& found,
                       const Order& order, const FlatState& at, FlatState& next,
                       bool drifts, Moves& moves) {
    Moves more = moves_in_order(search_, fan, found, order, at);
    if (!drifts && !more.empty()) more.back().to = next;  // without rounding
    for (const Move& move : more) {
      const bool passes =
          drifts ? move_holds(search_, move, work_) : move_passes(search_, move, work_);
      if (!passes) return false;
    }
    if (drifts) next = more.empty() ? at : more.back().to;
    moves.insert(moves.end(), more.begin(), more.end());
    return true;
  }

  bool all_stick(const Moves& moves) {
    return std::all_of(moves.begin(), moves.end(), [this](const Move& move) {
      return move_passes(search_, move, work_);
    });
  }

  bool all_confined(const Moves& moves) {
    return std::all_of(moves.begin(), moves.end(), [this](const Move& move) {
      return is_confined(search_, move, work_);
    });
  }

  /// Along a path with the rotation left to itself; the first that `settle` makes into
  /// one that is confined.
  template <class Settle>
  std::optional<Moves> leg(const FlatState& from, const Vec2& to, const Settle& settle) {
    const std::vector<Vec2> path = inner_path(search_.model->pad_face, from.p_OF, to);
    if (path.empty()) return std::nullopt;
    for (const int pieces : kLegPieces) {
      for (const double depth : kDepths) {
        if (limits_.reached()) return std::nullopt;
        auto moves = leg_in_pieces(from, cut_path(path, pieces), depth);
        if (moves && settle(*moves) && all_confined(*moves)) return moves;
      }
    }
    return std::nullopt;
  }

  std::optional<Moves> leg_in_pieces(const FlatState& from,
                                     const std::vector<Vec2>& places, double depth) {
    Moves moves;
    FlatState at = from;
    for (std::size_t k = 1; k < places.size(); ++k) {
      std::vector<Generator> fan = fans_.at(at.p_OF, depth, work_);
      free_rotation(fan);
      FlatState next{places[k], at.theta};
      if (!step(fan, at, next, true, moves)) return std::nullopt;
      at = next;
    }
    return moves;
  }

  /// A leg into the goal, turned as a whole so that it ends with the wanted angle.
  std::optional<Moves> leg_into(const Vec2& from, const FlatState& goal) {
    return leg({from, goal.theta}, goal.p_OF, [&](Moves& moves) {
      if (moves.empty()) return false;
      const double drift = moves.back().to.theta - goal.theta;
      for (Move& move : moves) {
        move.from.theta -= drift;
        move.to.theta -= drift;
      }
      moves.back().to = goal;
      // Isotropic pads feel the same at every angle; others are asked again.
      return search_.exact_everywhere || all_stick(moves);
    });
  }

  bool controllable(const Vec2& p_OF) {
    return is_controllable(fans_.at(p_OF, kDepths[1], work_));
  }

  /// Controllable places, nearest to p_OF along the object first; p_OF itself alone where
  /// it is one.
  std::vector<Vec2> branches(const Vec2& p_OF) {
    if (controllable(p_OF)) return {p_OF};
    std::vector<std::pair<double, Vec2>> found;
    for (const Vec2& node : lattice_nodes(search_, kBranchNodes)) {
      if (limits_.reached()) return {};
      if (!controllable(node)) continue;
      const auto path = inner_path(search_.model->pad_face, node, p_OF);
      if (!path.empty()) found.emplace_back(path_length(path), node);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Vec2> places;
    for (std::size_t i = 0; i < found.size() && places.size() < kMostBranches; ++i) {
      places.push_back(found[i].second);
    }
    return places;
  }

  std::optional<Moves> first_leg_out(const FlatState& start) {
    for (const Vec2& place : branches(start.p_OF)) {
      if (place == start.p_OF) return Moves{};
      if (auto moves = leg(start, place, [](Moves&) { return true; })) return moves;
    }
    return std::nullopt;
  }

  std::optional<Moves> with_legs(const FlatState& start, const FlatState& goal) {
    const auto out = first_leg_out(start);
    if (!out) return std::nullopt;
    const FlatState begin = out->empty() ? start : out->back().to;
    for (const Vec2& place : branches(goal.p_OF)) {
      Moves in;
      if (place != goal.p_OF) {
        auto moves = leg_into(place, goal);
        if (!moves) continue;
        in = std::move(*moves);
      }
      if (auto plan = join(*out, begin, in.empty() ? goal : in.front().from, in)) {
        return plan;
      }
    }
    return std::nullopt;
  }

  std::optional<Moves> join(const Moves& out, const FlatState& begin,
                            const FlatState& end, const Moves& in) {
    auto middle = walk(begin, end);
    if (!middle) return std::nullopt;
    Moves moves = out;
    moves.insert(moves.end(), middle->begin(), middle->end());
    moves.insert(moves.end(), in.begin(), in.end());
    return moves;
  }

  const SearchModel& search_;
  Fans fans_;
  const Limits& limits_;
  Work& work_;
};

}  // namespace

std::optional<std::vector<Move>> search_fan(const SearchModel& search,
                                            const PadEnvelope& envelope,
                                            const FlatState& start,
                                            const GoalPlaces& goals, const Limits& limits,
                                            Work& work) {
  const auto moves = FanSearch(search, envelope, limits, work).run(start, goals);
  if (!moves || moves->empty()) return std::nullopt;
  return shortened(search, *moves, limits, work);
}

}  // namespace prehensile
