/// Nearest neighbours among points that are added one by one: a k-d tree that is never
/// balanced, which random points do not need. Internal to the planner.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

class PointTree {
 public:
  int size() const { return static_cast<int>(nodes_.size()); }

  /// The index of the point is the number of points before it.
  void add(const Vec3& point) {
    const int index = size();
    nodes_.push_back({point, {-1, -1}});
    if (index == 0) return;
    int at = 0;
    for (int axis = 0;; axis = (axis + 1) % 3) {
      int& child = nodes_[at].child[point[axis] < nodes_[at].point[axis] ? 0 : 1];
      if (child < 0) {
        child = index;
        return;
      }
      at = child;
    }
  }

  /// -1 without points.
  int nearest(const Vec3& to) const {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    visit(to, least, [&](int index, double distance) {
      if (distance < least) {
        least = distance;
        best = index;
      }
    });
    return best;
  }

  /// All within a radius, in an order that depends on the points alone.
  void within(const Vec3& of, double radius, std::vector<int>& found) const {
    found.clear();
    visit(of, radius, [&](int index, double distance) {
      if (distance <= radius) found.push_back(index);
    });
  }

 private:
  struct Node {
    Vec3 point;
    int child[2];
  };

  /// Calls for every point that may lie within `radius`, which the call may lower.
  template <typename Call>
  void visit(const Vec3& of, const double& radius, Call&& call) const {
    if (!nodes_.empty()) visit_from(0, 0, of, radius, call);
  }

  template <typename Call>
  void visit_from(int at, int axis, const Vec3& of, const double& radius,
                  Call& call) const {
    const Node& node = nodes_[at];
    call(at, (node.point - of).norm());
    const double side = of[axis] - node.point[axis];
    const int near = side < 0.0 ? 0 : 1;
    const int next = (axis + 1) % 3;
    if (node.child[near] >= 0) visit_from(node.child[near], next, of, radius, call);
    if (node.child[1 - near] >= 0 && std::abs(side) <= radius) {
      visit_from(node.child[1 - near], next, of, radius, call);
    }
  }

  std::vector<Node> nodes_;
};

}  // namespace prehensile
