#include "planner/pads/ring_kappas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kBetweenEntries = 3e-4;  // of force and moment
constexpr double kStraight = 5e-4;        // second difference that is still interpolated
constexpr double kMostShrunk = 0.99;      // of the torque radius

/// Keeps of each interval what lies in [low, high].
void keep_between(double low, double high, KappaSet& set) {
  int count = 0;
  for (int i = 0; i < set.count; ++i) {
    const KappaSet::Interval part{std::max(low, set.intervals[i].lo),
                                  std::min(high, set.intervals[i].hi)};
    if (part.lo <= part.hi) set.intervals[count++] = part;
  }
  set.count = count;
}

/// What lies in both, as far as a set can hold it.
KappaSet common(const KappaSet& a, const KappaSet& b) {
  KappaSet both;
  for (int i = 0; i < a.count; ++i) {
    KappaSet part = b;
    keep_between(a.intervals[i].lo, a.intervals[i].hi, part);
    for (int j = 0; j < part.count; ++j) {
      if (both.count == static_cast<int>(both.intervals.size())) return both;
      both.intervals[both.count++] = part.intervals[j];
    }
  }
  return both;
}

/// Takes ]low, high[ out of each interval.
void take_out(double low, double high, KappaSet& set) {
  KappaSet rest;
  const auto add = [&](double lo, double hi) {
    if (lo <= hi && rest.count < static_cast<int>(rest.intervals.size())) {
      rest.intervals[rest.count++] = {lo, hi};
    }
  };
  for (int i = 0; i < set.count; ++i) {
    const auto [lo, hi] = set.intervals[i];
    add(lo, std::min(hi, low));
    add(std::max(lo, high), hi);
  }
  set = rest;
}

}  // namespace

RingTable::RingTable(const Model& model) {
  for (int i = 0; i <= kHalf; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kHalf;
    const RingFriction friction = ring_friction(model.region.whole(), model.c, angle);
    along_[kHalf + i] = along_[kHalf - i] = friction.along;
    moment_[kHalf + i] = friction.moment / model.c;
    moment_[kHalf - i] = -friction.moment / model.c;
  }
  bent_.fill(false);
  for (int i = 1; i + 1 < kEntries; ++i) {
    const auto bend = [i](const std::array<double, kEntries>& values) {
      return std::abs(values[i - 1] - 2.0 * values[i] + values[i + 1]);
    };
    if (std::max(bend(along_), bend(moment_)) < kStraight) continue;
    bent_[i - 1] = bent_[i] = true;
  }
}

double RingTable::crossing(const Row& row, int low, int high) const noexcept {
  const bool rises = at(row, high) > at(row, low);
  while (high - low > 1) {  // without branches on what no processor foresees
    const int middle = (low + high) / 2;
    const bool before = (at(row, middle) >= 0.0) == rises;
    high = before ? middle : high;
    low = before ? low : middle;
  }
  const double from = at(row, low);
  const double to = at(row, high);
  if (bent_[low]) return rises ? high : low;
  return low + (from == to ? 0.5 : std::clamp(from / (from - to), 0.0, 1.0));
}

int RingTable::extreme_of(const Row& row, double side) const noexcept {
  if (row.moment == 0.0) return kHalf;  // `along` is greatest without a turn
  int low = 0;
  int high = kEntries - 1;
  while (low < high) {
    const int middle = (low + high) / 2;
    const bool improves = side * (at(row, middle + 1) - at(row, middle)) > 0.0;
    low = improves ? middle + 1 : low;
    high = improves ? high : middle;
  }
  return low;
}

void RingTable::cut(const Row& wanted, KappaSet& entries) const noexcept {
  Row row = wanted;
  row.constant -=
      kBetweenEntries * (std::abs(row.moment) + std::min(2.0, std::abs(row.along)));
  const int last = kEntries - 1;
  const double begin = at(row, 0);
  const double end = at(row, last);
  // The row has one extreme: a greatest value if `along` is positive, else a least one.
  // Between ends of different sign it crosses zero once, wherever that lies.
  if (begin >= 0.0 && end < 0.0) {
    return keep_between(0.0, crossing(row, 0, last), entries);
  }
  if (begin < 0.0 && end >= 0.0) {
    return keep_between(crossing(row, 0, last), last, entries);
  }
  const bool holds_at_ends = begin >= 0.0;
  if ((row.along >= 0.0) == holds_at_ends) {
    if (!holds_at_ends) entries.count = 0;
    return;
  }
  const int extreme = extreme_of(row, row.along >= 0.0 ? 1.0 : -1.0);
  const bool holds = at(row, extreme) >= 0.0;
  if (holds == holds_at_ends) {
    if (!holds) entries.count = 0;
  } else if (holds) {
    keep_between(crossing(row, 0, extreme), crossing(row, extreme, last), entries);
  } else {
    take_out(crossing(row, 0, extreme), crossing(row, extreme, last), entries);
  }
}

KappaSet RingTable::sticking(const StickRows& rows, double c,
                             double stretch) const noexcept {
  KappaSet set;
  set.count = 1;
  set.intervals[0] = {0.0, kEntries - 1.0};
  for (int i = 0; i < rows.edges; ++i) {
    const StickRow& edge = rows.edge[i];
    if (edge.B != 0.0) {
      cut({edge.A, 0.0, -edge.B}, set);
    } else if (edge.A < 0.0) {
      return {};
    }
  }
  cut({rows.end_b.A / c, stretch, -rows.end_b.B / c}, set);
  cut({rows.end_a.A / c, -stretch, -rows.end_a.B / c}, set);
  for (int i = 0; i < set.count; ++i) {
    const auto kappa = [stretch](double entry) {
      const double angle = 0.5 * std::numbers::pi * (entry / kHalf - 1.0);
      return std::tan(std::clamp(angle, -1.5707, 1.5707)) / stretch;
    };
    set.intervals[i] = {kappa(set.intervals[i].lo), kappa(set.intervals[i].hi)};
  }
  return set;
}

KappaSet RingTable::kappas(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                           const Margin& margin) const noexcept {
  const StickRows rows = stick_rows(contact, p_OF, e, margin);
  KappaSet set = sticking(rows, contact.c, 1.0);
  const double r = contact.is_point ? 0.0 : margin.torque_radius;
  for (const double stretch : {1.0 - std::min(r, kMostShrunk), 1.0 + r}) {
    if (r > 0.0 && !set.empty()) set = common(set, sticking(rows, contact.c, stretch));
  }
  // The pusher advances at one end of the face at least.
  const auto [low, high] = receding_kappas(contact, p_OF, e, margin);
  if (low < high) take_out(low, high, set);
  return set;
}

}  // namespace prehensile
