/// Nearest neighbours among points that are added one by one: a k-d tree (Bentley 1975)
/// whose nodes know the box around all that is below them. Internal to the planner.
///
/// Points of a search tree come in rows, each a little farther than the one before, and
/// are asked for from far off: a part that has become lopsided is built anew (Overmars
/// 1983), so that the depth stays within twice the least, and boxes are passed by
/// that hold nothing nearer. What is found does not depend on the shape of the tree.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "planner/steering/steering.h"

namespace prehensile {

class PointTree {
 public:
  int size() const { return static_cast<int>(nodes_.size()); }

  /// The index of the point is the number of points before it.
  void add(const Vec3& point);

  /// The first of the nearest ones; -1 without points. What is looked at counts as work.
  int nearest(const Vec3& to, Work& work) const;

  /// All within a radius, in the order in which they were added.
  void within(const Vec3& of, double radius, std::vector<int>& found) const;

 private:
  struct Node {
    Vec3 point, low, high;  // and the box around all below, itself included
    std::array<int, 2> child{-1, -1};
    int axis = 0;   // that divides the children
    int count = 1;  // of all below, itself included
  };

  int count_of(int node) const { return node < 0 ? 0 : nodes_[node].count; }
  void collect(int node, std::vector<int>& indices) const;
  int build(int* begin, int* end);
  double distance_to_box(int node, const Vec3& from) const {
    const Node& box = nodes_[node];
    return (from.cwiseMax(box.low).cwiseMin(box.high) - from).norm();
  }

  /// Calls for every point that may lie within `radius`, which the call may lower.
  template <typename Call>
  void visit(const Vec3& of, const double& radius, Call&& call) const {
    if (!nodes_.empty()) visit_from(root_, of, radius, call);
  }

  template <typename Call>
  void visit_from(int at, const Vec3& of, const double& radius, Call& call) const {
    const Node& node = nodes_[at];
    call(at, (node.point - of).norm());
    std::array<double, 2> distance;
    for (int side = 0; side < 2; ++side) {
      distance[side] = node.child[side] < 0 ? std::numeric_limits<double>::infinity()
                                            : distance_to_box(node.child[side], of);
    }
    const int near = distance[0] <= distance[1] ? 0 : 1;
    for (const int side : {near, 1 - near}) {
      if (node.child[side] >= 0 && distance[side] <= radius) {
        visit_from(node.child[side], of, radius, call);
      }
    }
  }

  std::vector<Node> nodes_;
  int root_ = 0;
};

}  // namespace prehensile
