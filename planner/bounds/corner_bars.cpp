#include "planner/bounds/corner_bars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scene/constants.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr int kRays = 120;          // around each corner
constexpr int kMostTurns = 7;       // halvings of the directions across a piece
constexpr int kMostCuts = 4;        // of the line
constexpr double kRounding = 1e-7;  // [m]

/// Places on one side of a line from a corner to the border of the object.
struct Bar {
  Vec2 from, to;
  std::vector<Vec2> part;  // of the object, to the right of the line

  Vec2 to_the_left() const { return perp((to - from).normalized()); }

  double distance(const Vec2& p) const {
    const Vec2 d = to - from;
    const double share = std::clamp((p - from).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - from - share * d).norm();
  }
};

/// The line from a corner of an outline in a direction, up to where it first meets the
/// border again; none if it leaves the object at once.
std::optional<Bar> bar_from(const std::vector<Vec2>& outline, std::size_t corner,
                            const Vec2& along) {
  const std::size_t n = outline.size();
  const Vec2& from = outline[corner];
  if (!contains(outline, from + 10.0 * kRounding * along)) return std::nullopt;
  double nearest = kInfinity;
  std::size_t met = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == corner || (i + 1) % n == corner) continue;
    const Vec2 edge = outline[(i + 1) % n] - outline[i];
    const double sine = cross(along, edge);
    if (sine == 0.0) continue;
    const Vec2 off = outline[i] - from;
    const double distance = cross(off, edge) / sine;
    const double share = cross(off, along) / sine;
    if (distance <= 0.0 || share < 0.0 || share > 1.0 || distance >= nearest) continue;
    nearest = distance;
    met = i;
  }
  if (met == n) return std::nullopt;
  Bar bar{from, from + nearest * along, {from}};
  for (std::size_t i = corner; i != met;) {
    i = (i + 1) % n;
    bar.part.push_back(outline[i]);
  }
  bar.part.push_back(bar.to);
  return bar;
}

/// Whether all members of the goal are on that side of the bar.
bool is_beside(const Bar& bar, const GoalArc& goal, bool to_the_right) {
  const std::array ends = {Vec2(goal.centre - goal.arc), Vec2(goal.centre + goal.arc)};
  const double room = goal.widest() + goal.arc.norm() + kRounding;
  return contains(bar.part, ends[0]) == to_the_right &&
         std::min(bar.distance(ends[0]), bar.distance(ends[1])) > room;
}

/// Whether no motion leads across a piece of a line in any direction whose angle from
/// `out` is within half_angle of `angle`.
bool none_crosses(const LocalLaw& law, int contact, const PlaceSpan& piece,
                  const Vec2& out, double angle, double half_angle, int turns) {
  if (!law.may_move(contact, piece, {rotated(angle, out), half_angle})) return true;
  if (turns == 0) return false;
  const double half = 0.5 * half_angle;
  return none_crosses(law, contact, piece, out, angle - half, half, turns - 1) &&
         none_crosses(law, contact, piece, out, angle + half, half, turns - 1);
}

bool is_sealed(const LocalLaw& law, int contact, const PlaceSpan& piece, const Vec2& out,
               int cuts) {
  if (none_crosses(law, contact, piece, out, 0.0, 0.5 * kPi, kMostTurns)) return true;
  if (cuts == 0) return false;
  const Vec2 middle = 0.5 * (piece.a + piece.b);
  return is_sealed(law, contact, {piece.a, middle}, out, cuts - 1) &&
         is_sealed(law, contact, {middle, piece.b}, out, cuts - 1);
}

bool is_reflex(const std::vector<Vec2>& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vec2 in = outline[i] - outline[(i + n - 1) % n];
  const Vec2 out = outline[(i + 1) % n] - outline[i];
  return cross(in, out) < 0.0;
}

}  // namespace

bool is_barred(const LocalLaw& law, int contact, const std::vector<Vec2>& outline,
               const Vec2& start, std::span<const GoalArc> goals) {
  if (!law.is_known()) return false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (!is_reflex(outline, i)) continue;
    for (int k = 0; k < kRays; ++k) {
      const Vec2 along = rotated(2.0 * kPi * k / kRays, {1.0, 0.0});
      const auto bar = bar_from(outline, i, along);
      if (!bar || bar->distance(start) < kRounding) continue;
      const bool is_right = contains(bar->part, start);
      const auto is_apart = [&](const GoalArc& goal) {
        return is_beside(*bar, goal, !is_right);
      };
      if (!std::ranges::all_of(goals, is_apart)) continue;
      const Vec2 out = is_right ? bar->to_the_left() : Vec2(-bar->to_the_left());
      if (is_sealed(law, contact, {bar->from, bar->to}, out, kMostCuts)) return true;
    }
  }
  return false;
}

}  // namespace prehensile
