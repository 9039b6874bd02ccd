#include "planner/bounds/slab_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr int kFirstSectors = 4;             // of half a turn about u
constexpr double kNarrowest = kPi / 1440.0;  // [rad] half of a sector that is not divided

/// Motions by one contact in a sector of directions, at places across a slab.
struct Branch {
  double cost = 0.0;  // least of them, from below
  LeastTravel least;
  int contact = 0;
  double off = 0.0, half = 0.0;  // [rad] middle of the sector from u, and half of it
  double low = 0.0, high = 0.0;  // [m] of perp(u).p
  bool operator<(const Branch& other) const {  // heaps keep the greatest in front
    return cost > other.cost;
  }
};

}  // namespace

/// Best first, until what is best is narrow or the steps are done.
double least_cost(const LocalLaw& law, const Slab& slab, const SlabQuestion& question) {
  if (!(slab.across.low <= slab.across.high)) return kInfinity;
  const Vec2& u = slab.u;
  const Vec2 v = perp(u);
  std::vector<Branch> open;
  const auto add = [&](Branch branch) {
    const double advance = std::cos(std::max(0.0, std::abs(branch.off) - branch.half));
    const double end = slab.low + slab.width;
    const std::array<Vec2, 4> corners = {
        slab.low * u + branch.low * v, end * u + branch.low * v,
        end * u + branch.high * v, slab.low * u + branch.high * v};
    branch.least =
        law.least_travel(branch.contact, corners, {rotated(branch.off, u), branch.half},
                         question.share, branch.least);
    branch.cost = std::max(branch.cost, branch.least.cost / advance);
    if (branch.cost == kInfinity) return;
    open.push_back(branch);
    std::push_heap(open.begin(), open.end());
  };
  Branch first{.half = 0.5 * kPi / kFirstSectors,
               .low = slab.across.low,
               .high = slab.across.high};
  for (int contact = question.first_contact; contact < question.end_contact; ++contact) {
    first.contact = contact;
    for (int i = 0; i < kFirstSectors; ++i) {
      first.off = (2 * i + 1 - kFirstSectors) * first.half;
      add(first);
    }
  }
  for (int step = 0; step < question.steps && !open.empty(); ++step) {
    const Branch worst = open.front();
    const double width = worst.high - worst.low;
    const bool is_wide = width > slab.width;
    if (!is_wide && worst.half <= kNarrowest) break;
    std::pop_heap(open.begin(), open.end());
    open.pop_back();
    Branch one = worst, other = worst;
    if (is_wide && width > question.as_half_turn * worst.half / kPi) {
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

}  // namespace prehensile
