#include "primitives/space_cone.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "primitives/spatial_push_instant.h"

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Rates of turn that are looked at in one direction.
constexpr int kScan = 40;

/// Least and greatest atan(c omega / speed); beyond them there is no limit.
constexpr double kMostTurn = 0.499 * std::numbers::pi;
constexpr double kEdge = 1e-9;  // [rad] of that angle

/// Length of the push whose beginning is the instant [m].
constexpr double kTravel = 0.01;

/// The rates of turn for which `holds(atan(c omega / speed))`, [rad/m].
template <class Holds>
KappaSet rates_where(const Holds& holds, double c) {
  const auto edge = [&](double inside, double outside) {
    while (std::abs(outside - inside) > kEdge) {
      const double middle = 0.5 * (inside + outside);
      (holds(middle) ? inside : outside) = middle;
    }
    return std::tan(inside) / c;
  };
  KappaSet set;
  double last = -kMostTurn;
  bool was_inside = holds(last);
  double low = -kInfinity;
  for (int k = 1; k <= kScan; ++k) {
    const double at = kMostTurn * (2.0 * k / kScan - 1.0);
    const bool inside = holds(at);
    if (inside && !was_inside) low = edge(at, last);
    const bool ends = was_inside && (!inside || k == kScan);
    if (ends && set.count < static_cast<int>(set.intervals.size())) {
      set.intervals[set.count++] = {low, inside ? kInfinity : edge(last, at)};
    }
    was_inside = inside;
    last = at;
  }
  return set;
}

std::vector<DirectionRange> intersection(const std::vector<DirectionRange>& a,
                                         const std::vector<DirectionRange>& b) {
  std::vector<DirectionRange> out;
  for (const DirectionRange& one : a) {
    for (const DirectionRange& other : b) {
      const double lo = std::max(one.lo, other.lo);
      const double hi = std::min(one.hi, other.hi);
      if (lo <= hi) out.push_back({lo, hi});
    }
  }
  return out;
}

}  // namespace

SpatialVerdict sticks_in_space(const Model& model, const Grasp& grasp, int contact,
                               double place, double direction,
                               double omega_per_speed) noexcept {
  // The direction is that of the finger axis, or of a point, which does not turn.
  const bool is_point = model.contacts[contact].is_point;
  const LinearPush push{.contact = contact,
                        .place = place,
                        .e = rotated(direction, model.contacts[contact].n),
                        .travel = kTravel,
                        .turn = is_point ? 0.0 : kTravel * omega_per_speed};
  SpatialPushInstant instant(model, push, grasp, {});
  const Seat seat = instant.geometry().first();
  const PushStop stop = instant.solve(seat, 0.0, Vec2::Zero());
  SpatialVerdict verdict;
  switch (stop.status) {
    case TransitionStatus::kNotRun:
      verdict.is_known = true;
      verdict.margin = instant.margin(seat, Regime::kStick).least();
      if (std::abs(verdict.margin) < instant.noise()) verdict.margin = 0.0;
      break;
    case TransitionStatus::kPusherLost:
    case TransitionStatus::kLeavesPlane:
      verdict.is_known = true;
      break;
    default:
      break;
  }
  return verdict;
}

MotionCone cone_in_space(const Model& model, const Grasp& grasp, int contact,
                         double place, const MotionCone& flat) {
  const auto sticks = [&](double direction, double turn) {
    return sticks_in_space(model, grasp, contact, place, direction,
                           std::tan(turn) / flat.c)
               .margin >= 0.0;
  };
  MotionCone cone = flat;
  cone.nominal = ranges_where([&](double direction) { return sticks(direction, 0.0); });
  cone.robust = intersection(cone.nominal, flat.robust);
  for (ConeSlice& slice : cone.slices) {
    slice.nominal =
        rates_where([&](double turn) { return sticks(slice.direction, turn); }, flat.c);
    slice.robust = intersection(slice.nominal, slice.robust);
  }
  return cone;
}

}  // namespace prehensile
