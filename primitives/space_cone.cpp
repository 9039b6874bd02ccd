#include "primitives/space_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "primitives/border.h"
#include "primitives/spatial_push_instant.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Rates of turn that are looked at in one direction.
constexpr int kScan = 40;

/// Least and greatest atan(c omega / speed); beyond them there is no limit.
constexpr double kMostTurn = 0.499 * std::numbers::pi;
constexpr double kEdge = 1e-9;        // [rad] of that angle
constexpr double kRobustEdge = 1e-6;  // [rad] of angle or direction

/// Margin below which the border is close: places for each of those rates of turn there,
/// and the width to which a place between them is sought [rad].
constexpr double kMostNear = 0.02;
constexpr int kScanNear = 6;
constexpr double kNarrow = 1e-3;

/// Margin that an edge of the robust cone keeps with the member that sets it: half of
/// what counts as none, so that the edge sticks however it is rounded.
constexpr double kRobustMargin = 5e-8;

/// Places in a range of which both ends slip with a member.
constexpr int kScanInside = 10;

/// Length of the push whose beginning is the instant [m].
constexpr double kTravel = 0.01;

/// Where `sign * margin` is least in (low, high) as far as golden section finds it, or
/// the first place where it is negative.
template <class Margin>
double least_place(const Margin& margin, double sign, double low, double high) {
  constexpr double kGolden = 0.381966011250105;
  double x = low + kGolden * (high - low);
  double y = high - kGolden * (high - low);
  double at_x = sign * margin(x);
  double at_y = sign * margin(y);
  while (at_x >= 0.0 && at_y >= 0.0 && high - low > kNarrow) {
    if (at_x < at_y) {
      high = y;
      y = std::exchange(x, low + kGolden * (y - low));
      at_y = std::exchange(at_x, sign * margin(x));
    } else {
      low = x;
      x = std::exchange(y, high - kGolden * (high - x));
      at_x = std::exchange(at_y, sign * margin(y));
    }
  }
  return at_x < at_y ? x : y;
}

using Looked = MarginAt;  ///< at atan(c omega / speed)

/// The margin over the rates of turn, ascending: over the whole range, more closely where
/// it is close to zero, and where it turns back there without being seen to cross it.
template <class Margin>
std::vector<Looked> scanned(const Margin& margin) {
  std::vector<Looked> scan;
  const auto look = [&](double at) { scan.push_back({at, margin(at)}); };
  look(-kMostTurn);
  for (int k = 1; k <= kScan; ++k) {
    const Looked before = scan.back();
    const double at = kMostTurn * (2.0 * k / kScan - 1.0);
    const double here = margin(at);
    const bool is_near = std::min(std::abs(before.margin), std::abs(here)) < kMostNear;
    for (int i = 1; is_near && i < kScanNear; ++i) {
      look(before.at + (at - before.at) * i / kScanNear);
    }
    scan.push_back({at, here});
  }
  const std::size_t count = scan.size();
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double sign = scan[k].margin >= 0.0 ? 1.0 : -1.0;
    const auto away = [&](std::size_t i) { return sign * scan[i].margin; };
    const bool turns = away(k - 1) >= away(k) && away(k + 1) > away(k);
    if (!turns || away(k) > kMostNear) continue;
    look(least_place(margin, sign, scan[k - 1].at, scan[k + 1].at));
  }
  std::sort(scan.begin(), scan.end(),
            [](const Looked& a, const Looked& b) { return a.at < b.at; });
  return scan;
}

/// The rates of turn [rad/m] for which `margin(atan(c omega / speed))` is not negative.
template <class Margin>
KappaSet rates_where(const Margin& margin, double c) {
  const auto edge = [&](const Looked& inside, const Looked& outside) {
    return std::tan(border(margin, inside, outside, kEdge)) / c;
  };
  const std::vector<Looked> scan = scanned(margin);
  std::vector<KappaSet::Interval> found;
  double low = -kInfinity;
  for (std::size_t k = 1; k < scan.size(); ++k) {
    const bool was_inside = scan[k - 1].margin >= 0.0;
    const bool inside = scan[k].margin >= 0.0;
    if (inside && !was_inside) low = edge(scan[k], scan[k - 1]);
    if (was_inside && (!inside || k + 1 == scan.size())) {
      found.push_back({low, inside ? kInfinity : edge(scan[k - 1], scan[k])});
    }
  }
  KappaSet set;
  const auto width = [c](const KappaSet::Interval& rates) {
    return std::atan(c * rates.hi) - std::atan(c * rates.lo);
  };
  const auto is_narrower = [&](const KappaSet::Interval& a, const KappaSet::Interval& b) {
    return width(a) < width(b);
  };
  while (found.size() > set.intervals.size()) {
    found.erase(std::min_element(found.begin(), found.end(), is_narrower));
  }
  for (const KappaSet::Interval& rates : found) set.intervals[set.count++] = rates;
  return set;
}

/// What of a range that held so far holds still, looked at in its ends and, where these
/// fail, inside.
template <class Margin>
std::optional<DirectionRange> narrowed(const DirectionRange& range,
                                       const Margin& margin) {
  const auto look = [&](double at) { return Looked{at, margin(at)}; };
  const auto holds = [](const Looked& looked) { return looked.margin >= 0.0; };
  const Looked lo = look(range.lo);
  const Looked hi = look(range.hi);
  if (holds(lo) && holds(hi)) return range;
  Looked inside = holds(lo) ? lo : hi;
  for (int k = 1; !holds(inside); ++k) {
    if (k == kScanInside) return {};
    inside = look(range.lo + (range.hi - range.lo) * k / kScanInside);
  }
  const auto safe = [&](double at) { return margin(at) - kRobustMargin; };
  const auto edge = [&](const Looked& outside) {
    return inside.margin > kRobustMargin ? border(safe, inside, outside, kRobustEdge)
                                         : inside.at;
  };
  return DirectionRange{holds(lo) ? range.lo : edge(lo), holds(hi) ? range.hi : edge(hi)};
}

/// What of these ranges holds with every member; `margin(member, at)`. A member that
/// leaves gaps may not hold at the edge that a later one gave, so members are asked again
/// until none moves an edge.
template <class Margin>
std::vector<DirectionRange> robust_part(const std::vector<DirectionRange>& ranges,
                                        const std::vector<SpaceMember>& members,
                                        const Margin& margin) {
  std::vector<DirectionRange> left;
  for (const DirectionRange& range : ranges) {
    std::optional<DirectionRange> now = range;
    // The member that moved an edge last need not be asked again.
    std::size_t agree = 0;
    for (std::size_t i = 0; now && agree < members.size(); i = (i + 1) % members.size()) {
      const DirectionRange before = *now;
      now = narrowed(before, [&](double at) { return margin(members[i], at); });
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
      // What is none up to the noise sticks.
      verdict.margin = instant.margin(seat, Regime::kStick).least() + instant.noise();
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
  const auto margin = [&](double direction, double turn) {
    return sticks_in_space(model, grasp, contact, place, direction,
                           std::tan(turn) / flat.c)
        .margin;
  };
  const auto member_margin = [&](const SpaceMember& member, double direction,
                                 double turn) {
    return sticks_in_space(member, contact, direction, std::tan(turn) / flat.c).margin;
  };
  MotionCone cone = flat;
  cone.members = static_cast<int>(members.size());
  cone.nominal =
      ranges_where([&](double direction) { return margin(direction, 0.0) >= 0.0; });
  cone.robust = robust_part(cone.nominal, members,
                            [&](const SpaceMember& member, double direction) {
                              return member_margin(member, direction, 0.0);
                            });
  for (ConeSlice& slice : cone.slices) {
    slice.nominal =
        rates_where([&](double turn) { return margin(slice.direction, turn); }, flat.c);
    std::vector<DirectionRange> turns;
    for (int i = 0; i < slice.nominal.count; ++i) {
      const KappaSet::Interval& rates = slice.nominal.intervals[i];
      turns.push_back({turn_of(rates.lo, flat.c), turn_of(rates.hi, flat.c)});
    }
    turns = robust_part(turns, members, [&](const SpaceMember& member, double turn) {
      return member_margin(member, slice.direction, turn);
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
