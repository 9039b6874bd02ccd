/// The open nodes of a branch and bound over words. Internal to the planner.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/bounds/word_goal.h"

namespace prehensile {

/// Nodes of one search, best first, of equal ones the older. Keeps references to scene,
/// nodes and visitor.
class OpenNodes {
 public:
  /// `nodes` counts down with each that is added.
  OpenNodes(const WordScene& scene, double target, std::int64_t& nodes,
            const WordVisitor& visit)
      : scene_(scene), target_(target), nodes_(nodes), visit_(visit) {}

  /// Bounds a node, and keeps it if it may hold a plan.
  void add(WordNode& node);

  /// The least bound of what is left, at most the target.
  double run(const WordQuestion& question);

 private:
  struct Open {
    double bound;
    int index;
    bool operator<(const Open& other) const {  // heaps keep the greatest in front
      return bound != other.bound ? bound > other.bound : index > other.index;
    }
  };

  void keep(const WordNode& node);
  void divide(const WordQuestion& question, const WordNode& node);
  void halve(const WordQuestion& question, const WordNode& node, WordNode::Split split,
             int point, int edge);
  /// Where no line fits into a piece.
  void halve_widest(const WordQuestion& question, const WordNode& node);
  bool outside(const PointBox& box) const;

  const WordScene& scene_;
  double target_;
  std::int64_t& nodes_;
  const WordVisitor& visit_;
  std::vector<WordNode> pool_;
  std::vector<int> free_;  // places of the pool
  std::vector<Open> heap_;
};

}  // namespace prehensile
