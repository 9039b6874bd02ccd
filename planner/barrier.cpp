#include "planner/barrier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <vector>

#include "planner/free_directions.h"
#include "planner/goal_cover.h"
#include "planner/local_law.h"
#include "planner/place_slacks.h"
#include "planner/ring_kappas.h"
#include "planner/ring_pads.h"
#include "planner/steering.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of the grids that are tried, over the longer side of the object.
constexpr std::array kNodesPerSide = {48, 96};
constexpr std::array kNodesPerSideWhereClipped = {96, 192};

/// Straight pieces of a way lead to the nodes up to so many rows or columns away.
constexpr int kStride = 10;

/// By so much more than what sticks the field lets a way turn for nothing: its
/// pieces have few directions, and what sticks changes from node to node. Tried in order.
constexpr std::array kFreely = {0.06, 0.02, 0.005, 0.0};  // [rad]
constexpr std::array kFreelyWhereClipped = {0.06, 0.0};

/// Where the face clips the discs: so much slack, over F, may be missing. Tried in order.
constexpr std::array kAllowed = {0.06, 0.03, 0.015, 0.008};

/// Levels of the field that are tried, as shares of its value at the goal.
constexpr std::array kLevels = {0.5, 0.25, 0.75};

/// A field with less at the goal [spacings of the grid] shows no barrier.
constexpr double kLeastValue = 0.5;

/// Where pushes of a contact end for lack of grip the check wants a fall for sure: so
/// much of what the grip holds may be missing before the field takes it for one.
constexpr double kNearlyHeld = 0.05;

/// Half of the directions that are looked at as one where the law says what sticks [rad].
constexpr double kHalfLooked = 1e-3;

/// What sticks at a place, over soft points and round pads that are whole everywhere.
class RoundPads {
 public:
  explicit RoundPads(const Model& model)
      : search_(prepare_search(model, Margin::none())), model_(model) {}

  FreeDirections free_at(const Vec2& place) const {
    if (depth_inside(model_.pad_face, place) < 0.0) return {};
    std::vector<const StickContact*> contacts;
    for (const SearchContact& contact : search_.contacts) {
      const Vec2& g_O = model_.contacts[contact.contact].g_O;
      if (holding_slack(model_, place, g_O, Margin::none()) >= 0.0) {
        contacts.push_back(&contact.stick);
      }
    }
    if (contacts.empty()) return {};
    return FreeDirections::where([&](double angle) {
      return std::any_of(contacts.begin(), contacts.end(), [&](const auto* contact) {
        return sticks(*contact, place, -towards(angle));
      });
    });
  }

 private:
  bool sticks(const StickContact& contact, const Vec2& place, const Vec2& e) const {
    const bool ring = search_.rings && !contact.is_point;
    const KappaSet kappas = ring ? search_.rings->kappas(contact, place, e)
                                 : sticking_kappas(contact, place, e);
    return !kappas.empty();
  }

  const SearchModel search_;
  const Model& model_;
};

/// What the law lets stick at a place, over pads of other shapes, which deflect the
/// friction by more than what the field allows for.
class LawfulPads {
 public:
  explicit LawfulPads(const Model& model) : law_(model), model_(model) {}

  FreeDirections free_at(const Vec2& place) const {
    if (depth_inside(model_.pad_face, place) < 0.0) return {};
    std::vector<int> contacts;
    for (int k = 0; k < static_cast<int>(model_.contacts.size()); ++k) {
      const Vec2& g_O = model_.contacts[k].g_O;
      if (holding_slack(model_, place, g_O, Margin::none()) >= -kNearlyHeld) {
        contacts.push_back(k);
      }
    }
    if (contacts.empty()) return {};
    return FreeDirections::where([&](double angle) {
      return std::ranges::any_of(contacts, [&](int contact) {
        return law_.may_move(contact, {place, place}, {towards(angle), kHalfLooked});
      });
    });
  }

 private:
  const LocalLaw law_;
  const Model& model_;
};

using Stopped = std::function<bool()>;
using FreeAt = std::function<FreeDirections(const Vec2&)>;

/// Where a straight piece of a way is judged. What sticks changes much between places
/// where the face clips the pads.
enum class Judged {
  kWhereItBegins,
  kAtBothEnds,  ///< as where it costs less: a long one leaps across what nothing crosses
  kAllAlong,    ///< each of its parts as at its ends
};

/// What ways of the finger axis from the start cost: the part of them across what sticks.
class CheatField {
 public:
  CheatField(const Model& model, int nodes_per_side, FreeAt free_at,
             const Stopped& stopped)
      : stopped_(stopped),
        grid_(PlaceGrid::over(model.pad_face, nodes_per_side)),
        free_at_(std::move(free_at)),
        free_(static_cast<std::size_t>(grid_.count())) {
    for (int i = -kStride; i <= kStride; ++i) {
      for (int j = -kStride; j <= kStride; ++j) {
        if (std::gcd(i, j) != 1) continue;
        const Vec2 way = grid_.spacing * Vec2(i, j);
        steps_.push_back({i, j, way.norm(), angle_of(way)});
      }
    }
  }

  const PlaceGrid& grid() const { return grid_; }

  /// The cost at each node, as far as it is below that of the goal, which receives the
  /// least of its places: the rest keep that. `of_goal` is infinite if it was stopped.
  std::vector<double> costs(const Vec2& start, const std::vector<Vec2>& goals,
                            Judged judged, double freely, double* of_goal) {
    std::vector<double> cost(grid_.count(), kInfinity);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto offer = [&](int node, double value) {
      if (value >= cost[node]) return;
      cost[node] = value;
      open.push({value, node});
    };
    const double reach = kStride * grid_.spacing;
    const FreeDirections at_start = free_at_(start);
    for (int node = 0; node < grid_.count(); ++node) {
      const Vec2 way = grid_.place(node) - start;
      if (way.norm() > reach) continue;
      offer(node, way.norm() * at_start.cheating(angle_of(way), freely));
    }
    *of_goal = kInfinity;
    while (!open.empty() && open.top().cost < *of_goal) {
      if (stopped_ && stopped_()) {
        *of_goal = kInfinity;
        break;
      }
      const auto [value, node] = open.top();
      open.pop();
      if (value > cost[node]) continue;
      const FreeDirections& free = free_of(node);
      for (const Vec2& goal : goals) {
        const Vec2 way = goal - grid_.place(node);
        if (way.norm() > reach) continue;
        const double cheating = free.cheating(angle_of(way), freely);
        *of_goal = std::min(*of_goal, value + way.norm() * cheating);
      }
      const int i = grid_.column(node);
      const int j = grid_.row(node);
      for (const Step& step : steps_) {
        if (!grid_.has(i + step.i, j + step.j)) continue;
        const int next = grid_.index(i + step.i, j + step.j);
        if (value >= cost[next]) continue;
        offer(next, value + step.length * cheating_of(node, next, step, judged, freely));
      }
    }
    for (double& value : cost) value = std::min(value, *of_goal);
    return cost;
  }

 private:
  struct Entry {
    double cost;
    int node;
    bool operator>(const Entry& other) const {
      return std::tie(cost, node) > std::tie(other.cost, other.node);
    }
  };
  struct Step {
    int i, j;
    double length, angle;  // [m], [rad]
  };

  /// The share of a step that leaves what sticks.
  double cheating_of(int node, int next, const Step& step, Judged judged, double freely) {
    if (judged == Judged::kAllAlong) return cheating_along(node, step, freely);
    const double cheating = free_of(node).cheating(step.angle, freely);
    if (judged == Judged::kWhereItBegins || cheating == 0.0) return cheating;
    return std::min(cheating, free_of(next).cheating(step.angle, freely));
  }

  /// The mean along a step, of each part what it is at the end where that is less.
  double cheating_along(int node, const Step& step, double freely) {
    const int parts = std::max(std::abs(step.i), std::abs(step.j));
    const auto at = [&](int k) {
      const auto off = [&](int whole) {
        return static_cast<int>(std::lround(static_cast<double>(k * whole) / parts));
      };
      const int place =
          grid_.index(grid_.column(node) + off(step.i), grid_.row(node) + off(step.j));
      return free_of(place).cheating(step.angle, freely);
    };
    double sum = 0.0;
    double before = at(0);
    for (int k = 1; k <= parts; ++k) {
      const double now = at(k);
      sum += std::min(before, now);
      before = now;
    }
    return sum / parts;
  }

  const FreeDirections& free_of(int node) {
    std::optional<FreeDirections>& free = free_[static_cast<std::size_t>(node)];
    if (!free) free = free_at_(grid_.place(node));
    return *free;
  }

  const Stopped& stopped_;
  PlaceGrid grid_;
  FreeAt free_at_;
  std::vector<Step> steps_;
  std::vector<std::optional<FreeDirections>> free_;  // of nodes looked at
};

/// Places of the goal set, no two closer than `spacing`.
std::vector<Vec2> places_of(const Goal& goal, double spacing) {
  std::vector<Vec2> places;
  for_all_goal_places(goal, [&](const Vec2& p_OF, double) {
    if (places.empty() || (p_OF - places.back()).norm() >= spacing) {
      places.push_back(p_OF);
    }
    return true;
  });
  return places;
}

/// Tries levels of a field. `weak`: where the last region that was tried may be crossed.
class Levels {
 public:
  explicit Levels(const Model& model)
      : model_(model), start_(finger_in_object(model.scene.start.X_HO)) {}

  /// Whether the field separates the goal from the start, if only by what it allows.
  bool separate(CheatField& field, Judged judged, double freely) {
    const double spacing = field.grid().spacing;
    const std::vector<Vec2> goals = places_of(*model_.scene.goal, 0.25 * spacing);
    cost_ = field.costs(start_, goals, judged, freely, &of_goal_);
    return of_goal_ > kLeastValue * spacing && of_goal_ != kInfinity;
  }

  /// A level that is a barrier, or none.
  Loops barrier_of(CheatField& field, Judged judged, double freely) {
    if (!separate(field, judged, freely)) return {};
    for (const double share : kLevels) {
      Loops region =
          loops_below(field.grid(), cost_, share * of_goal_, 0.1 * field.grid().spacing);
      if (verify_barrier(model_, region, nullptr, &weak_)) return region;
    }
    return {};
  }

 private:
  const Model& model_;
  Vec2 start_;
  std::vector<double> cost_;
  double of_goal_ = 0.0;
  std::optional<Vec2> weak_;
};

Loops barrier_of_whole_pads(const Model& model, const FreeAt& free_at,
                            const Stopped& stopped) {
  Levels levels(model);
  for (const int nodes : kNodesPerSide) {
    CheatField field(model, nodes, free_at, stopped);
    for (const double freely : kFreely) {
      Loops barrier = levels.barrier_of(field, Judged::kWhereItBegins, freely);
      if (!barrier.empty()) return barrier;
    }
  }
  return {};
}

Loops barrier_of_clipped_discs(const Model& model, const Stopped& stopped) {
  PlaceSlacks slacks(model);
  Levels levels(model);
  constexpr std::array kWays = {Judged::kAtBothEnds, Judged::kAllAlong};
  for (const int nodes : kNodesPerSideWhereClipped) {
    const auto field_allowing = [&](double allowed) {
      return CheatField(
          model, nodes,
          [&slacks, allowed](const Vec2& place) {
            return FreeDirections::above(slacks.at(place), -allowed);
          },
          stopped);
    };
    // What the strictest field does not separate no other does.
    CheatField strictest = field_allowing(kAllowed.back());
    if (std::ranges::none_of(kWays, [&](Judged judged) {
          return levels.separate(strictest, judged, kFreelyWhereClipped.back());
        })) {
      return {};
    }
    for (const double allowed : kAllowed) {
      CheatField field = field_allowing(allowed);
      for (const Judged judged : kWays) {
        for (const double freely : kFreelyWhereClipped) {
          Loops barrier = levels.barrier_of(field, judged, freely);
          if (!barrier.empty()) return barrier;
        }
      }
    }
  }
  return {};
}

}  // namespace

Loops find_barrier(const Model& model, const Stopped& stopped) {
  const Goal& goal = *model.scene.goal;
  if (!goal.x || !goal.y) return {};
  if (has_clipped_discs(model)) {
    return has_clipped_law(model) ? barrier_of_clipped_discs(model, stopped) : Loops{};
  }
  if (!LocalLaw(model).is_known()) return {};
  if (model.has_soft_points() || has_ring_pads(model)) {
    const RoundPads pads(model);
    return barrier_of_whole_pads(
        model, [&](const Vec2& place) { return pads.free_at(place); }, stopped);
  }
  const LawfulPads pads(model);
  return barrier_of_whole_pads(
      model, [&](const Vec2& place) { return pads.free_at(place); }, stopped);
}

}  // namespace prehensile
