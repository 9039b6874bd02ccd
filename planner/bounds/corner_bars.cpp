#include "planner/bounds/corner_bars.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/constants.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr std::size_t kMostVertices = 64;
constexpr int kRays = 120;           // around each corner
constexpr int kMostTurns = 7;        // halvings of the directions across a piece
constexpr int kMostCuts = 4;         // of the line
constexpr double kRounding = 1e-7;   // [m]
constexpr double kEndOfEdge = 1e-9;  // share of an edge: lines through its ends meet it

/// A line from a corner to the border of the object, and the object on either side of it.
struct Bar {
  Vec2 from, to;
  std::vector<Vec2> right, left;

  Vec2 to_the_left() const { return perp((to - from).normalized()); }
};

/// In a direction from a corner up to where that first meets the border again; none if it
/// leaves the object at once.
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
    const bool meets = share >= -kEndOfEdge && share <= 1.0 + kEndOfEdge;
    if (!meets || distance <= kRounding || distance >= nearest) continue;
    nearest = distance;
    met = i;
  }
  if (met == n) return std::nullopt;
  Bar bar{from, from + nearest * along, {from}, {from, from + nearest * along}};
  for (std::size_t i = (corner + 1) % n; i != corner; i = (i + 1) % n) {
    const bool is_right = (i + n - corner) % n <= (met + n - corner) % n;
    (is_right ? bar.right : bar.left).push_back(outline[i]);
  }
  bar.right.push_back(bar.to);
  return bar;
}

/// Whether no member of the goal is in a part of the object.
bool is_beside(const std::vector<Vec2>& part, const GoalArc& goal) {
  return depth_inside(part, goal.centre) < -(goal.widest() + goal.arc.norm() + kRounding);
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

/// Whether the bar keeps the start from all goals.
bool keeps_apart(const LocalLaw& law, int contact, const Bar& bar, const Vec2& start,
                 std::span<const GoalArc> goals) {
  const bool is_right = depth_inside(bar.right, start) > kRounding;
  const std::vector<Vec2>& part = is_right ? bar.right : bar.left;
  if (!is_right && !(depth_inside(bar.left, start) > kRounding)) return false;
  const auto is_elsewhere = [&](const GoalArc& goal) { return is_beside(part, goal); };
  if (!std::ranges::all_of(goals, is_elsewhere)) return false;
  const Vec2 out = is_right ? bar.to_the_left() : Vec2(-bar.to_the_left());
  return is_sealed(law, contact, {bar.from, bar.to}, out, kMostCuts);
}

}  // namespace

bool is_barred(const LocalLaw& law, int contact, const std::vector<Vec2>& outline,
               const Vec2& start, std::span<const GoalArc> goals) {
  if (!law.is_known() || outline.size() > kMostVertices) return false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (!is_reflex(outline, i)) continue;
    for (int k = 0; k < kRays; ++k) {
      const Vec2 along = rotated(2.0 * kPi * k / kRays, {1.0, 0.0});
      const auto bar = bar_from(outline, i, along);
      if (bar && keeps_apart(law, contact, *bar, start, goals)) return true;
    }
  }
  return false;
}

}  // namespace prehensile
