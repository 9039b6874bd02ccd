/// Nodes of the branch and bound over switch points, and their bounds. Internal to the
/// planner.
///
/// A word is the sequence of contacts of a plan. Its path runs through points: the start,
/// the switches between contacts, lines that every path must cross (in the same run), and
/// the goal. Each point is known up to a box; a node is a word with its boxes. Summing
/// the laws of the runs (run_law.h) over the pieces between the points gives inequalities
/// that are quadratic in the points; their extremes over the boxes follow from the values
/// and gradients at the centres and the exact second-order remainder.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "planner/pads/run_law.h"

namespace prehensile {

/// Centre and two half-edges of a parallelogram; zero where it is thinner [m].
struct PointBox {
  Vec2 centre = Vec2::Zero();
  std::array<Vec2, 2> half = {Vec2::Zero(), Vec2::Zero()};

  /// Greatest w.(p - centre).
  double reach(const Vec2& w) const {
    return std::abs(w.dot(half[0])) + std::abs(w.dot(half[1]));
  }
};

/// A straight line in the object with the whole object that is left of it on one side of
/// the path and the rest on the other: each path between the sides crosses it.
struct Portal {
  Vec2 from, to;
  Vec2 normal;
};

/// What the bounds of all nodes share.
struct WordScene {
  const RunLaws* laws = nullptr;
  double c = 0.0, L = 0.0;
  std::vector<Vec2> outline;  ///< where the finger axis may be
  std::vector<Portal> portals;
};

struct WordNode {
  static constexpr int kMaxPoints = 16;
  int points = 0;  ///< start and goal included
  int placements = 0;
  std::array<PointBox, kMaxPoints> box;
  std::array<short, kMaxPoints> contact{};  ///< of the piece that ends at a point
  double turn_low = 0.0, turn_high = 0.0;   ///< [rad]
  Vec2 goal_arc = Vec2::Zero();  ///< [m] half of the goal's way between these turns
  double bound = 0.0;            ///< of J

  /// What to divide next: a half-edge of a box, or the goal's angles (point = points -
  /// 1), or a piece by a line across its depth.
  enum class Split : signed char { kNone, kBox, kGoal, kLine };
  Split split = Split::kNone;
  signed char split_point = 0, split_edge = 0;
};

/// Told each node that is divided: where a plan cheaper than the target might be.
using WordVisitor = std::function<void(const WordNode&)>;

/// Fills `bound` and what to split; false if no plan of the node costs less than
/// `target`. No heap.
bool bound_node(const WordScene& scene, double target, WordNode& node) noexcept;

/// Adds the portals that the pieces of the node must cross. No heap.
void cross_portals(const WordScene& scene, WordNode& node) noexcept;

/// Adds a line across the depth of the piece that ends at `point`; false if there is no
/// level between its boxes. The line is cut by the cones from both sides: `target` limits
/// the path. An empty line makes the node impossible: `possible` is false. No heap.
bool add_depth_line(const WordScene& scene, double target, int point, WordNode& node,
                    bool& possible) noexcept;

}  // namespace prehensile
