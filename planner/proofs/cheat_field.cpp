#include "planner/proofs/cheat_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "scene/constants.h"

namespace prehensile {
namespace {

/// Straight pieces of a way lead to the nodes up to so many rows or columns away.
constexpr int kStride = 10;

/// A node, the least cost first.
struct Entry {
  double cost;
  int node;
  bool operator>(const Entry& other) const {
    return std::tie(cost, node) > std::tie(other.cost, other.node);
  }
};

}  // namespace

CheatField::CheatField(const Model& model, int nodes_per_side, FreeAt free_at,
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

std::vector<double> CheatField::costs(const Vec2& start, const std::vector<Vec2>& goals,
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
    if (stopped_()) {
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

/// The share of a step that leaves what sticks.
double CheatField::cheating_of(int node, int next, const Step& step, Judged judged,
                               double freely) {
  if (judged == Judged::kAllAlong) return cheating_along(node, step, freely);
  const double cheating = free_of(node).cheating(step.angle, freely);
  if (judged == Judged::kWhereItBegins || cheating == 0.0) return cheating;
  return std::min(cheating, free_of(next).cheating(step.angle, freely));
}

/// The mean along a step, of each part what it is at the end where that is less.
double CheatField::cheating_along(int node, const Step& step, double freely) {
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

const FreeDirections& CheatField::free_of(int node) {
  std::optional<FreeDirections>& free = free_[static_cast<std::size_t>(node)];
  if (!free) free = free_at_(grid_.place(node));
  return *free;
}

}  // namespace prehensile
