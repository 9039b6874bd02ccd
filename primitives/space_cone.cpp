#include "primitives/space_cone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "primitives/spatial_push_instant.h"

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Rates of turn that are looked at in one direction.
constexpr int kScan = 40;

/// Least and greatest atan(c omega / speed); beyond them there is no limit.
constexpr double kMostTurn = 0.499 * std::numbers::pi;
constexpr double kEdge = 1e-9;        // [rad] of that angle
constexpr double kRobustEdge = 1e-6;  // [rad] of angle or direction

/// Places in a range of which both ends slip with a member.
constexpr int kScanInside = 10;

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

/// What of a range that held so far holds still, looked at in its ends and, where these
/// fail, inside.
template <class Holds>
std::optional<DirectionRange> narrowed(const DirectionRange& range, const Holds& holds) {
  const bool at_lo = holds(range.lo);
  const bool at_hi = holds(range.hi);
  if (at_lo && at_hi) return range;
  double inside = at_lo ? range.lo : range.hi;
  if (!at_lo && !at_hi) {
    int k = 1;
    const auto place = [&] { return range.lo + (range.hi - range.lo) * k / kScanInside; };
    while (k < kScanInside && !holds(place())) ++k;
    if (k == kScanInside) return {};
    inside = place();
  }
  const auto edge = [&](double outside) {
    double held = inside;
    while (std::abs(outside - held) > kRobustEdge) {
      const double middle = 0.5 * (held + outside);
      (holds(middle) ? held : outside) = middle;
    }
    return held;
  };
  return DirectionRange{at_lo ? range.lo : edge(range.lo),
                        at_hi ? range.hi : edge(range.hi)};
}

/// What of these ranges holds with every member; `holds(member, at)`. A member that
/// leaves gaps may not hold at the edge that a later one gave, so members are asked again
/// until none moves an edge.
template <class Holds>
std::vector<DirectionRange> robust_part(const std::vector<DirectionRange>& ranges,
                                        const std::vector<SpaceMember>& members,
                                        const Holds& holds) {
  std::vector<DirectionRange> left;
  for (const DirectionRange& range : ranges) {
    std::optional<DirectionRange> now = range;
    // The member that moved an edge last need not be asked again.
    std::size_t agree = 0;
    for (std::size_t i = 0; now && agree < members.size(); i = (i + 1) % members.size()) {
      const DirectionRange before = *now;
      now = narrowed(before, [&](double at) { return holds(members[i], at); });
      const bool moved = now && (now->lo != before.lo || now->hi != before.hi);
      agree = moved ? 1 : agree + 1;
    }
    if (now) left.push_back(*now);
  }
  return left;
}

double turn_of(double rate, double c) {
  return std::clamp(std::atan(c * rate), -kMostTurn, kMostTurn);
}

double rate_of(double turn, double c) {
  return std::abs(turn) < kMostTurn ? std::tan(turn) / c : std::copysign(kInfinity, turn);
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

std::optional<SpaceMember> space_member(const Model& model, const Grasp& grasp,
                                        int contact, double place,
                                        const UncertaintyBox& box, const BoxPoint& at) {
  const UncertainPush varied =
      vary(model.scene, grasp, LinearPush{.contact = contact, .place = place}, box, at);
  if (!check(varied.scene).empty()) return {};
  Model changed = prepare(varied.scene, model.options);
  if (!(changed.F > 0.0 && changed.c > 0.0) ||
      !pads_on_object(changed, varied.start.X_HO)) {
    return {};
  }
  const LinearPush& push = std::get<LinearPush>(varied.push);
  return SpaceMember{std::move(changed), varied.start, push.place,
                     std::atan2(push.e.y(), push.e.x())};
}

SpatialVerdict sticks_in_space(const SpaceMember& member, int contact, double direction,
                               double omega_per_speed) noexcept {
  return sticks_in_space(member.model, member.grasp, contact, member.place,
                         direction + member.turned, omega_per_speed);
}

MotionCone cone_in_space(const Model& model, const Grasp& grasp, int contact,
                         double place, const MotionCone& flat,
                         const std::vector<SpaceMember>& members) {
  const auto sticks = [&](double direction, double turn) {
    return sticks_in_space(model, grasp, contact, place, direction,
                           std::tan(turn) / flat.c)
               .margin >= 0.0;
  };
  const auto member_sticks = [&](const SpaceMember& member, double direction,
                                 double turn) {
    return sticks_in_space(member, contact, direction, std::tan(turn) / flat.c).margin >=
           0.0;
  };
  MotionCone cone = flat;
  cone.members = static_cast<int>(members.size());
  cone.nominal = ranges_where([&](double direction) { return sticks(direction, 0.0); });
  cone.robust = robust_part(cone.nominal, members,
                            [&](const SpaceMember& member, double direction) {
                              return member_sticks(member, direction, 0.0);
                            });
  for (ConeSlice& slice : cone.slices) {
    slice.nominal =
        rates_where([&](double turn) { return sticks(slice.direction, turn); }, flat.c);
    std::vector<DirectionRange> turns;
    for (int i = 0; i < slice.nominal.count; ++i) {
      const KappaSet::Interval& rates = slice.nominal.intervals[i];
      turns.push_back({turn_of(rates.lo, flat.c), turn_of(rates.hi, flat.c)});
    }
    turns = robust_part(turns, members, [&](const SpaceMember& member, double turn) {
      return member_sticks(member, slice.direction, turn);
    });
    slice.robust = {};
    for (const DirectionRange& turn : turns) {
      slice.robust.intervals[slice.robust.count++] = {rate_of(turn.lo, flat.c),
                                                      rate_of(turn.hi, flat.c)};
    }
  }
  return cone;
}

}  // namespace prehensile
