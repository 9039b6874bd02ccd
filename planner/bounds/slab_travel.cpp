#include "planner/bounds/slab_travel.h"

#include <algorithm>
#include <cmath>

#include "planner/bounds/slab_cost.h"
#include "planner/geometry/segment.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Slabs over the object, and steps of the branch and bound for each: the coarse ones
/// tell along which way, and for which share, it is worth to look at the fine ones.
constexpr int kCoarseSlabs = 10, kCoarseSteps = 24;
constexpr int kFineSlabs = 100, kFineSteps = 1500;

constexpr std::array<double, 5> kShareOfTurn = {0.0, 0.5, -0.5, 0.9, -0.9};

constexpr double kRounding = 1e-7;  // [m] of the way between two places

}  // namespace

const LocalLaw& SlabTravel::law() {
  if (!law_) law_.emplace(model_, margin_);
  return *law_;
}

void SlabTravel::prepare_slabs() {
  has_slabs_ = true;
  for (int i = 0; i < kWays; ++i) {
    const Vec2 u = rotated(2.0 * kPi * i / kWays, Vec2(1.0, 0.0));
    coarse_[i] = slabs_across(u, kCoarseSlabs, kCoarseSteps);
    fine_[i] = slabs_across(u, kFineSlabs, kFineSteps);
  }
}

SlabTravel::Slabs SlabTravel::slabs_across(const Vec2& u, int count, int steps) const {
  double least = kInfinity, most = -kInfinity;
  for (const Vec2& p : model_.pad_face) {
    least = std::min(least, u.dot(p));
    most = std::max(most, u.dot(p));
  }
  Slabs slabs{.u = u, .low = least, .width = (most - least) / count, .steps = steps};
  std::array<double, kShares> unknown;
  unknown.fill(kNan);
  slabs.costs.assign(count, unknown);
  return slabs;
}

double SlabTravel::cost_of(Slabs& slabs, int index, int share) const {
  double& cost = slabs.costs[index][share];
  if (std::isnan(cost)) {
    const double low = slabs.low + index * slabs.width;
    const Extent across = extent_across(model_.pad_face, slabs.u, perp(slabs.u),
                                        low - kRounding, low + slabs.width + kRounding);
    cost = least_cost(*law_, {slabs.u, low, slabs.width, across},
                      {.end_contact = static_cast<int>(model_.contacts.size()),
                       .share = kShareOfTurn[share],
                       .steps = slabs.steps,
                       .as_half_turn = 8.0 * model_.L});
  }
  return cost;
}

double SlabTravel::least_along(Slabs& slabs, int share, const Vec2& from,
                               const GoalArc& to, double turn_low,
                               double turn_high) const {
  const double begin = slabs.u.dot(from) + kRounding;
  const double end = slabs.u.dot(to.centre) - to.reach(slabs.u) - kRounding;
  if (end <= begin) return 0.0;
  const double turn = kShareOfTurn[share] > 0.0 ? turn_low : turn_high;
  double travel = kShareOfTurn[share] * model_.c * turn;
  for (int i = 0; i < static_cast<int>(slabs.costs.size()); ++i) {
    const double low = slabs.low + i * slabs.width;
    const double across = std::min(end, low + slabs.width) - std::max(begin, low);
    if (across > 0.0) travel += across * cost_of(slabs, i, share);
  }
  return travel;
}

double SlabTravel::least(const Vec2& from, const GoalArc& to, double turn_low,
                         double turn_high) {
  if (!law().is_known()) return 0.0;
  if (!has_slabs_) prepare_slabs();
  double most = 0.0;
  int best_way = 0, best_share = 0;
  for (int way = 0; way < kWays; ++way) {
    for (int share = 0; share < kShares; ++share) {
      const double travel =
          least_along(coarse_[way], share, from, to, turn_low, turn_high);
      if (travel <= most) continue;
      most = travel;
      best_way = way;
      best_share = share;
    }
  }
  if (most == 0.0) return 0.0;
  return std::max(
      most, least_along(fine_[best_way], best_share, from, to, turn_low, turn_high));
}

}  // namespace prehensile
