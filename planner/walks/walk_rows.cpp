#include "planner/walks/walk_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/geometry/free_directions.h"

namespace prehensile {
namespace {

/// Places that are looked at, on the way across a gap.
constexpr int kPlaces = 9;

/// Rows, at most: a lattice takes a second.
constexpr std::size_t kMostRows = 2;

/// Ways that are wider have headings in other lattices, and narrower ones would take more
/// rows than are worth it [rad].
constexpr double kWidest = 0.25;
constexpr double kNarrowest = 0.003;

/// Rows are alike whose headings differ by less than this share of the narrower way, and
/// whose ways are no more than so many times as wide as each other.
constexpr double kAlike = 0.5;
constexpr double kAlikeWidths = 3.0;

struct NarrowWay {
  double heading = 0.0, width = 0.0;  // [rad]
};

/// What the headings at a place leave out is less than half a turn by the width of the
/// way, so that the headings to either side of its axis lead along it to and fro.
NarrowWay way_between(const FreeDirections& headings) {
  const auto gap = headings.widest_gap();
  const double width = std::numbers::pi - gap.width;
  return {gap.from - 0.5 * width, width};
}

/// Adds it unless it is like one that is known, or not narrow.
void add_narrow(const NarrowWay& way, std::vector<NarrowWay>& ways) {
  const bool is_known = std::ranges::any_of(ways, [&](const NarrowWay& other) {
    const double off = std::remainder(way.heading - other.heading, std::numbers::pi);
    const auto [least, most] = std::minmax(way.width, other.width);
    return std::abs(off) < kAlike * least && most < kAlikeWidths * least;
  });
  if (way.width >= kNarrowest && way.width <= kWidest && !is_known) ways.push_back(way);
}

}  // namespace

std::vector<Rows> rows_across(const WalkLattice& lattice, std::span<const WalkGap> gaps,
                              Work& work) {
  std::vector<NarrowWay> ways;
  for (const WalkGap& gap : gaps) {
    if (gap.spacings == 0.0) continue;
    for (int i = 0; i < kPlaces; ++i) {
      const Vec2 place = gap.from + i * (gap.to - gap.from) / (kPlaces - 1);
      add_narrow(way_between(lattice.headings_at(place, work)), ways);
    }
  }
  std::ranges::stable_sort(ways, {}, [](const NarrowWay& way) { return -way.width; });
  ways.resize(std::min(ways.size(), kMostRows));
  std::vector<Rows> rows;
  rows.reserve(ways.size());
  for (const NarrowWay& way : ways) rows.push_back({way.heading, 1.0 / way.width});
  return rows;
}

}  // namespace prehensile
