#include "planner/bounds/word_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/bounds/corner_bars.h"
#include "planner/bounds/portals.h"
#include "planner/bounds/run_slabs.h"
#include "planner/bounds/slab_travel.h"
#include "planner/costs.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr int kMostPlacements = 6;
constexpr int kPlacementsOfSlabs = 3;  // from which on it pays to ask what slabs cost
// As long as the program of a run takes, and its slabs where there is none; these are few
// for that.
constexpr std::int64_t kNodesPerRun = 350;
constexpr std::int64_t kNodesPerSlabs = 700;

/// A node that is open: best first, of equal ones the older.
struct OpenNode {
  double bound;
  int index;
  bool operator<(const OpenNode& other) const {  // heaps keep the greatest in front
    return bound != other.bound ? bound > other.bound : index > other.index;
  }
};

/// Nodes of one search, best first.
class OpenNodes {
 public:
  OpenNodes(const WordScene& scene, double target, std::int64_t& nodes,
            const WordVisitor& visit)
      : scene_(scene), target_(target), nodes_(nodes), visit_(visit) {}

  /// Bounds a node, and keeps it if it may hold a plan.
  void add(WordNode& node) {
    --nodes_;
    cross_portals(scene_, node);
    if (bound_node(scene_, target_, node)) keep(node);
  }

  /// The least bound of what is left, at most the target.
  double run(const WordQuestion& question) {
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

 private:
  void keep(const WordNode& node) {
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

  void divide(const WordQuestion& question, const WordNode& node) {
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

  void halve(const WordQuestion& question, const WordNode& node, WordNode::Split split,
             int point, int edge) {
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

  /// Where no line fits into a piece.
  void halve_widest(const WordQuestion& question, const WordNode& node) {
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
          point == node.points - 1 ? WordNode::Split::kGoal : WordNode::Split::kBox,
          point, edge);
  }

  bool outside(const PointBox& box) const {
    const double radius = std::hypot(box.half[0].norm(), box.half[1].norm());
    return depth_inside(scene_.outline, box.centre) <
           -(box.half[0].norm() + box.half[1].norm()) - 1e-9 * radius;
  }

  const WordScene& scene_;
  double target_;
  std::int64_t& nodes_;
  const WordVisitor& visit_;
  std::vector<WordNode> pool_;
  std::vector<int> free_;  // places of the pool
  std::vector<OpenNode> heap_;
};

PointBox bounding_box(const std::vector<Vec2>& outline) {
  Vec2 low = outline.front(), high = outline.front();
  for (const Vec2& v : outline) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  PointBox box;
  box.centre = 0.5 * (low + high);
  const Vec2 half = 0.5 * (high - low);
  box.half = {Vec2(half.x(), 0.0), Vec2(0.0, half.y())};
  return box;
}

/// Runs of a single placement whose goal turns by some range, best first.
class SingleRuns {
 public:
  SingleRuns(const WordScene& scene, const WordQuestion& question, double target,
             std::int64_t& nodes, const WordVisitor& visit)
      : scene_(scene),
        question_(question),
        target_(target),
        nodes_(nodes),
        asks_slabs_(question.slabs && !visit),
        barred_(scene.laws->contacts.size()),
        others_(scene, target, nodes, visit) {}

  /// `least`: a bound that is known, of slabs, too, if they were `crossed`.
  void add(int contact, double low, double high, double least = 1.0,
           bool crossed_slabs = false) {
    --nodes_;
    Run run{.contact = contact,
            .turn_low = low,
            .turn_high = high,
            .crossed_slabs = crossed_slabs};
    WordNode node = node_of(run);
    cross_portals(scene_, node);
    if (!bound_node(scene_, target_, node)) return;
    run.bound = std::max(least, node.bound);
    keep(run);
  }

  /// The least bound of what is left, at most the target. What is worst is looked at
  /// first: by its program, then across slabs, then in halves.
  double run() {
    while (!heap_.empty() && nodes_ > 0) {
      Run worst = heap_.front();
      const bool crosses_slabs = asks_slabs_ && !worst.crossed_slabs;
      if (worst.is_bounded && !crosses_slabs &&
          worst.turn_high - worst.turn_low < kNarrowestTurn) {
        break;
      }
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      if (!worst.is_bounded) {
        bound_by_program(worst);
      } else if (crosses_slabs) {
        bound_by_slabs(worst);
        keep(worst);
      } else {
        const auto [contact, low, high, bound, is_bounded, crossed_slabs] = worst;
        const double middle = 0.5 * (low + high);
        add(contact, low, middle, bound, crossed_slabs);
        add(contact, middle, high, bound, crossed_slabs);
      }
    }
    const double left = heap_.empty() ? target_ : heap_.front().bound;
    return std::min(left, others_.run(question_));
  }

 private:
  struct Run {
    int contact = 0;
    double turn_low = 0.0, turn_high = 0.0, bound = 0.0;
    bool is_bounded = false;     // by its program
    bool crossed_slabs = false;  // this one, or one that it is a part of
    bool operator<(const Run& other) const { return bound > other.bound; }
  };

  WordNode node_of(const Run& run) const {
    WordNode node;
    node.points = 2;
    node.placements = 1;
    node.box[0].centre = question_.p_OF;
    node.contact[1] = static_cast<short>(run.contact);
    node.bound = 1.0 + question_.straight / scene_.L;
    set_goal(question_, run.turn_low, run.turn_high, node);
    return node;
  }

  void keep(const Run& run) {
    if (run.bound >= target_) return;
    heap_.push_back(run);
    std::push_heap(heap_.begin(), heap_.end());
  }

  RunQuestion question_of(const Run& run) const {
    return {.laws = scene_.laws,
            .contact = run.contact,
            .c = scene_.c,
            .outline = &scene_.outline,
            .start = question_.p_OF,
            .goal = goal_arc(question_, run.turn_low, run.turn_high),
            .turn_low = run.turn_low,
            .turn_high = run.turn_high,
            .cap = (target_ - 1.0) * scene_.L};
  }

  void bound_by_program(Run& run) {
    const double travel = run_bound(question_of(run));
    if (travel <= 0.0) {  // the goal is not ahead: gravity has to help
      if (asks_slabs_) {
        nodes_ -= kNodesPerSlabs;
        bound_by_slabs(run);
      }
      if (run.bound >= target_) return;
      WordNode node = node_of(run);
      node.bound = std::max(node.bound, run.bound);
      return others_.add(node);
    }
    nodes_ -= kNodesPerRun;
    run.is_bounded = true;
    run.bound = std::max(run.bound, 1.0 + travel / scene_.L);
    keep(run);
  }

  /// All inequalities of an instant together, which the program knows one by one.
  void bound_by_slabs(Run& run) {
    run.crossed_slabs = true;
    if (is_barred(run.contact)) {
      run.bound = target_;
      return;
    }
    const double travel = travel_across_slabs(question_.slabs->law(), question_of(run),
                                              (run.bound - 1.0) * scene_.L);
    run.bound = std::max(run.bound, 1.0 + travel / scene_.L);
  }

  /// From all goals at once: their places are the same after every whole turn.
  bool is_barred(int contact) {
    std::optional<bool>& barred = barred_[contact];
    if (!barred) {
      barred = prehensile::is_barred(question_.slabs->law(), contact, scene_.outline,
                                     question_.p_OF, goal_arcs(question_));
    }
    return *barred;
  }

  const WordScene& scene_;
  const WordQuestion& question_;
  double target_;
  std::int64_t& nodes_;
  bool asks_slabs_;  // not while plans are looked for among the nodes
  std::vector<Run> heap_;
  std::vector<std::optional<bool>> barred_;  // by contact, once it has been asked
  OpenNodes others_;
};

/// All plans of one placement.
double single_runs(const WordScene& scene, const WordQuestion& question, double target,
                   std::int64_t& nodes, const WordVisitor& visit) {
  SingleRuns runs(scene, question, target, nodes, visit);
  const auto pieces = goal_pieces(scene, question, (target - 1.0) * scene.L);
  const int contacts = static_cast<int>(scene.laws->contacts.size());
  for (int contact = 0; contact < contacts; ++contact) {
    for (const TurnPiece& piece : pieces) runs.add(contact, piece.low, piece.high);
  }
  return runs.run();
}

/// Least travel to a piece of the goal set by so many placements, whatever their contacts
/// [m].
double least_way(const WordQuestion& question, const TurnPiece& piece, int placements) {
  if (!question.slabs || placements < kPlacementsOfSlabs) return question.straight;
  return std::max(
      question.straight,
      question.slabs->least(question.p_OF, goal_arc(question, piece.low, piece.high),
                            piece.low, piece.high));
}

/// All words of this many placements.
double words(const WordScene& scene, const WordQuestion& question, int placements,
             double target, std::int64_t& nodes, const WordVisitor& visit) {
  OpenNodes open(scene, target, nodes, visit);
  const auto pieces = goal_pieces(scene, question, (target - placements) * scene.L);
  const int contacts = static_cast<int>(scene.laws->contacts.size());
  WordNode node;
  node.points = placements + 1;
  node.placements = placements;
  node.box[0].centre = question.p_OF;
  const PointBox anywhere = bounding_box(scene.outline);
  for (int i = 1; i < placements; ++i) node.box[i] = anywhere;
  std::vector<WordNode> ends;
  double least = target;
  for (const TurnPiece& piece : pieces) {
    node.bound = placements + least_way(question, piece, placements) / scene.L;
    if (node.bound >= target) continue;
    set_goal(question, piece.low, piece.high, node);
    ends.push_back(node);
    least = std::min(least, node.bound);
  }
  if (ends.empty()) return target;
  std::array<int, kMostPlacements> word{};
  for (;;) {
    const bool repeats = std::adjacent_find(word.begin(), word.begin() + placements) !=
                         word.begin() + placements;
    if (!repeats) {
      if (nodes <= 0) return least;
      for (const WordNode& end : ends) {
        WordNode child = end;
        for (int i = 0; i < placements; ++i) {
          child.contact[i + 1] = static_cast<short>(word[i]);
        }
        open.add(child);
      }
    }
    int i = 0;
    while (i < placements && ++word[i] == contacts) word[i++] = 0;
    if (i == placements) break;
  }
  return open.run(question);
}

}  // namespace

WordScene word_scene(const Model& model, const RunLaws& laws) {
  WordScene scene;
  scene.laws = &laws;
  scene.c = model.c;
  scene.L = longest_placement_length(model);
  scene.outline = model.pad_face;
  scene.portals = portals_of(scene.outline);
  return scene;
}

double word_bound(const WordScene& scene, const WordQuestion& question, double target,
                  std::int64_t& nodes, const WordVisitor& visit) {
  double best = target;
  for (int placements = 1;; ++placements) {
    if (placements + question.straight / scene.L >= best) return best;
    double way = (best - placements) * scene.L;
    for (const TurnPiece& piece : goal_pieces(scene, question, way)) {
      way = std::min(way, least_way(question, piece, placements));
    }
    const double least = placements + way / scene.L;
    if (least >= best) return best;
    if (placements > kMostPlacements || nodes <= 0) return std::min(best, least);
    const double bound = placements == 1
                             ? single_runs(scene, question, best, nodes, visit)
                             : words(scene, question, placements, best, nodes, visit);
    best = std::min(best, bound);
  }
}

}  // namespace prehensile
