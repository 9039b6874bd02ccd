#include "planner/slab_travel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/segment.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Slabs over the object, and steps of the branch and bound for each: the coarse ones
/// tell along which way, and for which share, it is worth to look at the fine ones.
constexpr int kCoarseSlabs = 10, kCoarseSteps = 24;
constexpr int kFineSlabs = 100, kFineSteps = 1500;

constexpr std::array<double, 5> kShareOfTurn = {0.0, 0.5, -0.5, 0.9, -0.9};

constexpr int kFirstSectors = 4;             // of half a turn about u
constexpr double kNarrowest = kPi / 1440.0;  // [rad] half of a sector that is not divided

constexpr double kRounding = 1e-7;  // [m] of the way between two places

/// Motions by one contact in a sector of directions, at places across a slab.
struct Branch {
  double cost = 0.0;  // least of them, from below
  int contact = 0;
  double off = 0.0, half = 0.0;  // [rad] middle of the sector from u, and half of it
  double low = 0.0, high = 0.0;  // [m] of perp(u).p
  bool operator<(const Branch& other) const {  // heaps keep the greatest in front
    return cost > other.cost;
  }
};

}  // namespace

void SlabTravel::prepare_slabs() {
  law_.emplace(model_, weightless_);
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

/// Best first, until what is best is narrow or the steps are done.
double SlabTravel::least_cost(const Slabs& slabs, double slab_low, double share) const {
  const Vec2& u = slabs.u;
  const Vec2 v = perp(u);
  const auto bound = [&](Branch& branch) {
    const double advance = std::cos(std::max(0.0, std::abs(branch.off) - branch.half));
    const std::array<Vec2, 4> corners = {
        slab_low * u + branch.low * v, (slab_low + slabs.width) * u + branch.low * v,
        (slab_low + slabs.width) * u + branch.high * v, slab_low * u + branch.high * v};
    const double travel = law_->least_travel(
        branch.contact, corners, {rotated(branch.off, u), branch.half}, share);
    branch.cost = std::max(branch.cost, travel / advance);
  };
  std::vector<Branch> open;
  const auto add = [&](Branch branch) {
    bound(branch);
    if (branch.cost == kInfinity) return;
    open.push_back(branch);
    std::push_heap(open.begin(), open.end());
  };
  Branch first;
  const Extent extent = extent_across(model_.pad_face, u, v, slab_low - kRounding,
                                      slab_low + slabs.width + kRounding);
  if (!(extent.low <= extent.high)) return kInfinity;
  first.low = extent.low;
  first.high = extent.high;
  first.half = 0.5 * kPi / kFirstSectors;
  for (int contact = 0; contact < static_cast<int>(model_.contacts.size()); ++contact) {
    first.contact = contact;
    for (int i = 0; i < kFirstSectors; ++i) {
      first.off = (2 * i + 1 - kFirstSectors) * first.half;
      add(first);
    }
  }
  for (int step = 0; step < slabs.steps && !open.empty(); ++step) {
    const Branch worst = open.front();
    const double width = worst.high - worst.low;
    const bool is_wide = width > slabs.width;
    if (!is_wide && worst.half <= kNarrowest) break;
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    Branch one = worst, other = worst;
    if (is_wide && width > 8.0 * model_.L * worst.half / kPi) {
      one.high = other.low = 0.5 * (worst.low + worst.high);
    } else {
      one.half = other.half = 0.5 * worst.half;
      one.off -= one.half;
      other.off += other.half;
    }
    add(one);
    add(other);
  }
  return open.empty() ? kInfinity : open.front().cost;
}

double SlabTravel::cost_of(Slabs& slabs, int index, int share) const {
  double& cost = slabs.costs[index][share];
  if (std::isnan(cost)) {
    cost = least_cost(slabs, slabs.low + index * slabs.width, kShareOfTurn[share]);
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
  if (!law_) prepare_slabs();
  if (!law_->is_known()) return 0.0;
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
