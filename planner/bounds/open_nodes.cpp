#include "planner/bounds/open_nodes.h"

#include <algorithm>
#include <cmath>

#include "scene/outline.h"

namespace prehensile {

void OpenNodes::add(WordNode& node) {
  --nodes_;
  cross_portals(scene_, node);
  if (bound_node(scene_, target_, node)) keep(node);
}

double OpenNodes::run(const WordQuestion& question) {
  WordNode node;
  while (!heap_.empty() && nodes_ > 0) {
    std::pop_heap(heap_.begin(), heap_.end());
    const int index = heap_.back().index;
    node = pool_[index];
    if (node.split == WordNode::Split::kNone) return node.bound;
    heap_.pop_back();
    free_.push_back(index);
    if (visit_) visit_(node);
    divide(question, node);
  }
  return heap_.empty() ? target_ : std::min(target_, heap_.front().bound);
}

void OpenNodes::keep(const WordNode& node) {
  int index = static_cast<int>(pool_.size());
  if (free_.empty()) {
    pool_.push_back(node);
  } else {
    index = free_.back();
    free_.pop_back();
    pool_[index] = node;
  }
  heap_.push_back({node.bound, index});
  std::push_heap(heap_.begin(), heap_.end());
}

void OpenNodes::divide(const WordQuestion& question, const WordNode& node) {
  if (node.split == WordNode::Split::kLine) {
    WordNode child = node;
    bool possible = true;
    if (add_depth_line(scene_, target_, node.split_point, child, possible)) {
      if (possible) add(child);
      return;
    }
    halve_widest(question, node);
    return;
  }
  halve(question, node, node.split, node.split_point, node.split_edge);
}

void OpenNodes::halve(const WordQuestion& question, const WordNode& node,
                      WordNode::Split split, int point, int edge) {
  for (const double side : {-1.0, 1.0}) {
    WordNode child = node;
    if (split == WordNode::Split::kGoal) {
      const double middle = 0.5 * (node.turn_low + node.turn_high);
      set_goal(question, side < 0.0 ? node.turn_low : middle,
               side < 0.0 ? middle : node.turn_high, child);
    } else {
      PointBox& box = child.box[point];
      box.half[edge] *= 0.5;
      box.centre += side * box.half[edge];
      if (outside(box)) continue;
    }
    add(child);
  }
}

void OpenNodes::halve_widest(const WordQuestion& question, const WordNode& node) {
  double widest = node.goal_arc.norm();
  int point = node.points - 1, edge = 0;
  for (int i = 1; i + 1 < node.points; ++i) {
    for (int k = 0; k < 2; ++k) {
      if (node.box[i].half[k].norm() <= widest) continue;
      widest = node.box[i].half[k].norm();
      point = i;
      edge = k;
    }
  }
  if (widest < 1e-6) {  // nothing to divide: it stays open with its bound
    WordNode last = node;
    last.split = WordNode::Split::kNone;
    keep(last);
    return;
  }
  halve(question, node,
        point == node.points - 1 ? WordNode::Split::kGoal : WordNode::Split::kBox, point,
        edge);
}

bool OpenNodes::outside(const PointBox& box) const {
  const double radius = std::hypot(box.half[0].norm(), box.half[1].norm());
  return depth_inside(scene_.outline, box.centre) <
         -(box.half[0].norm() + box.half[1].norm()) - 1e-9 * radius;
}

}  // namespace prehensile
