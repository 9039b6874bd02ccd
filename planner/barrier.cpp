#include "planner/barrier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <vector>

#include "planner/goal_cover.h"
#include "planner/local_law.h"
#include "planner/ring_kappas.h"
#include "planner/steering.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Of the grids that are tried, over the longer side of the object.
constexpr std::array kNodesPerSide = {48, 96};

/// Straight pieces of a way lead to the nodes up to so many rows or columns away.
constexpr int kStride = 10;

/// By so much more than what sticks the field lets a way turn for nothing: its
/// pieces have few directions, and what sticks changes from node to node. Tried in order.
constexpr std::array kFreely = {0.06, 0.02, 0.005, 0.0};  // [rad]

/// Levels of the field that are tried, as shares of its value at the goal.
constexpr std::array kLevels = {0.5, 0.25, 0.75};

/// A field with less at the goal [spacings of the grid] shows no barrier.
constexpr double kLeastValue = 0.5;

/// Around a place, what sticks is looked at in so many directions; where it begins and
/// ends between two of them is halved so often.
constexpr int kDirections = 72;
constexpr int kHalvings = 7;

Vec2 towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
double angle_of(const Vec2& way) { return std::atan2(way.y(), way.x()); }

/// Directions from an angle to another, counter-clockwise [rad].
struct Arc {
  double from, to;
};

/// Directions in which the finger axis can be moved at a place.
class FreeDirections {
 public:
  FreeDirections() = default;
  template <class Test>
  explicit FreeDirections(const Test& is_free) {
    const auto at = [](double k) { return 2.0 * kPi * k / kDirections; };
    std::array<bool, kDirections> free;
    for (int k = 0; k < kDirections; ++k) free[k] = is_free(at(k));
    const auto turn = [&](int k) {  // between k and k + 1
      double low = k;
      double high = k + 1;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        (is_free(at(middle)) == free[k] ? low : high) = middle;
      }
      return at(high);
    };
    const auto is_begin = [&](int k) { return !free[k] && free[(k + 1) % kDirections]; };
    for (int k = 0; k < kDirections; ++k) {
      if (!is_begin(k)) continue;
      int end = k + 1;
      while (free[end % kDirections]) ++end;
      arcs_.push_back({turn(k), at(end - 1) + turn((end - 1) % kDirections) -
                                    at((end - 1) % kDirections)});
    }
    all_ = std::all_of(free.begin(), free.end(), [](bool yes) { return yes; });
  }

  const std::vector<Arc>& arcs() const { return arcs_; }

  /// Sine of the angle of a direction to the next that is free, or `freely` beside one.
  double cheating(double angle, double freely) const {
    if (all_) return 0.0;
    double beyond = kPi / 2.0;
    for (const Arc& arc : arcs_) {
      const double half = 0.5 * (arc.to - arc.from);
      const double off = std::abs(std::remainder(angle - arc.from - half, 2.0 * kPi));
      beyond = std::min(beyond, off - half - freely);
    }
    return beyond <= 1e-9 ? 0.0 : std::sin(beyond);
  }

 private:
  std::vector<Arc> arcs_;
  bool all_ = false;
};

/// What ways of the finger axis from the start cost: the part of them across what sticks.
class CheatField {
 public:
  CheatField(const Model& model, int nodes_per_side)
      : search_(prepare_search(model, Margin::none())),
        model_(model),
        grid_(PlaceGrid::over(model.pad_face, nodes_per_side)),
        free_(grid_.count()) {
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
  /// least of its places: the rest keep that.
  std::vector<double> costs(const Vec2& start, const std::vector<Vec2>& goals,
                            double freely, double* of_goal) {
    std::vector<double> cost(grid_.count(), kInfinity);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto offer = [&](int node, double value) {
      if (value >= cost[node]) return;
      cost[node] = value;
      open.push({value, node});
    };
    const double reach = kStride * grid_.spacing;
    const FreeDirections at_start = free_at(start);
    for (int node = 0; node < grid_.count(); ++node) {
      const Vec2 way = grid_.place(node) - start;
      if (way.norm() > reach) continue;
      offer(node, way.norm() * at_start.cheating(angle_of(way), freely));
    }
    *of_goal = kInfinity;
    while (!open.empty() && open.top().cost < *of_goal) {
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
        offer(next, value + step.length * free.cheating(step.angle, freely));
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

  const FreeDirections& free_of(int node) {
    if (!free_[node]) free_[node] = free_at(grid_.place(node));
    return *free_[node];
  }

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
    return FreeDirections([&](double angle) {
      return std::any_of(contacts.begin(), contacts.end(), [&](const auto* contact) {
        return sticks(*contact, place, -towards(angle));
      });
    });
  }

  bool sticks(const StickContact& contact, const Vec2& place, const Vec2& e) const {
    const bool ring = search_.rings && !contact.is_point;
    const KappaSet kappas = ring ? search_.rings->kappas(contact, place, e)
                                 : sticking_kappas(contact, place, e);
    return !kappas.empty();
  }

  const SearchModel search_;
  const Model& model_;
  PlaceGrid grid_;
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

/// A level of the field that is a barrier.
Loops barrier_in(const Model& model, CheatField& field, double freely) {
  const double spacing = field.grid().spacing;
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  const std::vector<Vec2> goals = places_of(*model.scene.goal, 0.25 * spacing);
  double of_goal = 0.0;
  const std::vector<double> cost = field.costs(start, goals, freely, &of_goal);
  if (!(of_goal > kLeastValue * spacing) || of_goal == kInfinity) return {};
  for (const double share : kLevels) {
    Loops region = loops_below(field.grid(), cost, share * of_goal, 0.1 * spacing);
    if (verify_barrier(model, region, nullptr)) return region;
  }
  return {};
}

}  // namespace

Loops find_barrier(const Model& model) {
  const Goal& goal = *model.scene.goal;
  if (!goal.x || !goal.y || !LocalLaw(model).is_known()) return {};
  for (const int nodes : kNodesPerSide) {
    CheatField field(model, nodes);
    for (const double freely : kFreely) {
      Loops region = barrier_in(model, field, freely);
      if (!region.empty()) return region;
    }
  }
  return {};
}

}  // namespace prehensile
