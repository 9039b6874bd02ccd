#include "planner/word_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/portals.h"
#include "planner/run_bound.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostPlacements = 6;
constexpr double kWidestTurn = 0.5;  // [rad] of a first goal piece
constexpr double kNarrowestTurn = 1e-3;
constexpr std::int64_t kNodesPerRun = 500;  // as long as a bound of a run takes

/// A node that is open: best first, of equal ones the older.
struct OpenNode {
  double bound;
  int index;
  bool operator<(const OpenNode& other) const {  // heaps keep the greatest in front
    return bound != other.bound ? bound > other.bound : index > other.index;
  }
};

/// Greatest distance of the goal's place from the nominal one at these turns [m].
double place_slack(const WordQuestion& question, double turn_low, double turn_high) {
  const WordGoal& goal = question.goal;
  const bool nearly_any = goal.turn_high - goal.turn_low > kPi;
  if (goal.slack_per_turn == 0.0 || nearly_any) return goal.place_slack;
  const double middle = 0.5 * (goal.turn_low + goal.turn_high) - question.theta;
  const double from = std::remainder(turn_low - middle, 2.0 * kPi);
  const double to = from + turn_high - turn_low;
  const double off = std::max({0.0, from, -to});
  return std::max(0.0, goal.place_slack - goal.slack_per_turn * off);
}

/// Puts the goal's place at the end of the chain: the finger axis ends in O at
/// -R(-theta) place_H, an arc.
void set_goal(const WordQuestion& question, double turn_low, double turn_high,
              WordNode& node) {
  node.turn_low = turn_low;
  node.turn_high = turn_high;
  const double theta = question.theta + 0.5 * (turn_low + turn_high);
  const double half = 0.5 * (turn_high - turn_low);
  const Vec2 place = -rotated(-theta, question.goal.place_H);
  const Vec2 tangent = -perp(place);  // of the arc, per radian
  const double radius = place.norm();
  PointBox& box = node.box[node.points - 1];
  box.centre = place;
  node.goal_arc = half > kNarrowestTurn ? Vec2(half * tangent) : Vec2(Vec2::Zero());
  const double slack = place_slack(question, turn_low, turn_high);
  const double along = radius * half + slack;
  const double across = 0.5 * radius * half * half + slack;
  const Vec2 u = radius > 0.0 ? Vec2(tangent / radius) : Vec2(1.0, 0.0);
  box.half = {along * u, across * perp(u)};
}

/// The goal's places for these turns, as a run sees them.
GoalArc goal_arc(const WordQuestion& question, double turn_low, double turn_high) {
  const WordGoal& goal = question.goal;
  const double theta = question.theta + 0.5 * (turn_low + turn_high);
  const double half = 0.5 * (turn_high - turn_low);
  GoalArc arc;
  arc.centre = -rotated(-theta, goal.place_H);
  arc.arc = -half * perp(arc.centre);
  const double bulge = 0.5 * arc.centre.norm() * half * half;
  arc.slack.fill(bulge + goal.place_slack);
  if (goal.slack_per_turn == 0.0 || goal.turn_high - goal.turn_low > kPi) return arc;
  // What the angle is off is taken from what the place may be off.
  const double off =
      std::remainder(theta - 0.5 * (goal.turn_low + goal.turn_high), 2.0 * kPi);
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? -1.0 : 1.0;
    arc.slack[i] += side * goal.slack_per_turn * off;
    arc.slope[i] = side * goal.slack_per_turn * half;
  }
  return arc;
}

/// Nodes of one search, best first.
class OpenNodes {
 public:
  OpenNodes(const WordScene& scene, double target, std::int64_t& nodes)
      : scene_(scene), target_(target), nodes_(nodes) {}

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

/// Every winding of the goal within reach of the cap, in pieces of at most kWidestTurn.
template <class Use>
void for_each_goal_piece(const WordScene& scene, const WordQuestion& question,
                         double travel, const Use& use) {
  const double most = travel / scene.c;
  const auto pieces = [&](double low, double high) {
    low = std::max(low, -most);
    high = std::min(high, most);
    if (low > high) return;
    const int count = 1 + static_cast<int>((high - low) / kWidestTurn);
    for (int i = 0; i < count; ++i) {
      use(low + (high - low) * i / count, low + (high - low) * (i + 1) / count);
    }
  };
  if (question.goal.any_turn) {
    pieces(-most, most);
    return;
  }
  const double low = question.goal.turn_low - question.theta;
  const double high = question.goal.turn_high - question.theta;
  if (question.goal.one_winding) return pieces(low, high);
  const int first = static_cast<int>(std::ceil((-most - high) / (2.0 * kPi)));
  const int last = static_cast<int>(std::floor((most - low) / (2.0 * kPi)));
  for (int k = first; k <= last; ++k) pieces(low + 2.0 * kPi * k, high + 2.0 * kPi * k);
}

/// Runs of a single placement whose goal turns by some range, best first.
class SingleRuns {
 public:
  SingleRuns(const WordScene& scene, const WordQuestion& question, double target,
             std::int64_t& nodes)
      : scene_(scene),
        question_(question),
        target_(target),
        nodes_(nodes),
        others_(scene, target, nodes) {}

  void add(int contact, double low, double high) {
    --nodes_;
    Run run{.contact = contact, .turn_low = low, .turn_high = high};
    WordNode node;
    node.points = 2;
    node.placements = 1;
    node.box[0].centre = question_.p_OF;
    node.contact[1] = static_cast<signed char>(contact);
    node.bound = 1.0 + question_.straight / scene_.L;
    set_goal(question_, low, high, node);
    const WordNode whole = node;
    cross_portals(scene_, node);
    if (!bound_node(scene_, target_, node)) return;
    const double travel = run_bound({.laws = scene_.laws,
                                     .contact = contact,
                                     .c = scene_.c,
                                     .outline = &scene_.outline,
                                     .start = question_.p_OF,
                                     .goal = goal_arc(question_, low, high),
                                     .turn_low = low,
                                     .turn_high = high,
                                     .cap = (target_ - 1.0) * scene_.L});
    if (travel <= 0.0) {  // the goal is not ahead: gravity has to help
      WordNode piece = whole;
      return others_.add(piece);
    }
    nodes_ -= kNodesPerRun;
    run.bound = std::max(node.bound, 1.0 + travel / scene_.L);
    if (run.bound >= target_) return;
    heap_.push_back(run);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// The least bound of what is left, at most the target.
  double run() {
    while (!heap_.empty() && nodes_ > 0) {
      const Run worst = heap_.front();
      const double middle = 0.5 * (worst.turn_low + worst.turn_high);
      if (worst.turn_high - worst.turn_low < kNarrowestTurn) break;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      add(worst.contact, worst.turn_low, middle);
      add(worst.contact, middle, worst.turn_high);
    }
    const double left = heap_.empty() ? target_ : heap_.front().bound;
    return std::min(left, others_.run(question_));
  }

 private:
  struct Run {
    int contact = 0;
    double turn_low = 0.0, turn_high = 0.0, bound = 0.0;
    bool operator<(const Run& other) const { return bound > other.bound; }
  };

  const WordScene& scene_;
  const WordQuestion& question_;
  double target_;
  std::int64_t& nodes_;
  std::vector<Run> heap_;
  OpenNodes others_;
};

/// All plans of one placement.
double single_runs(const WordScene& scene, const WordQuestion& question, double target,
                   std::int64_t& nodes) {
  SingleRuns runs(scene, question, target, nodes);
  const int contacts = static_cast<int>(scene.laws->contacts.size());
  for (int contact = 0; contact < contacts; ++contact) {
    for_each_goal_piece(scene, question, (target - 1.0) * scene.L,
                        [&](double low, double high) { runs.add(contact, low, high); });
  }
  return runs.run();
}

/// All words of this many placements.
double words(const WordScene& scene, const WordQuestion& question, int placements,
             double target, std::int64_t& nodes) {
  OpenNodes open(scene, target, nodes);
  const int contacts = static_cast<int>(scene.laws->contacts.size());
  WordNode node;
  node.points = placements + 1;
  node.placements = placements;
  node.box[0].centre = question.p_OF;
  const PointBox anywhere = bounding_box(scene.outline);
  for (int i = 1; i < placements; ++i) node.box[i] = anywhere;
  node.bound = placements + question.straight / scene.L;
  std::array<int, kMostPlacements> word{};
  for (;;) {
    bool repeats = false;
    for (int i = 0; i < placements; ++i) {
      node.contact[i + 1] = static_cast<signed char>(word[i]);
      repeats = repeats || (i > 0 && word[i] == word[i - 1]);
    }
    if (!repeats) {
      if (nodes <= 0) return std::min(target, node.bound);
      for_each_goal_piece(scene, question, (target - placements) * scene.L,
                          [&](double low, double high) {
                            WordNode piece = node;
                            set_goal(question, low, high, piece);
                            open.add(piece);
                          });
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
  scene.L = model.L;
  scene.outline = model.pad_face;
  scene.portals = portals_of(scene.outline);
  return scene;
}

double word_bound(const WordScene& scene, const WordQuestion& question, double target,
                  std::int64_t& nodes) {
  double best = target;
  for (int placements = 1;; ++placements) {
    const double least = placements + question.straight / scene.L;
    if (least >= best) return best;
    if (placements > kMostPlacements || nodes <= 0) return std::min(best, least);
    const double bound = placements == 1
                             ? single_runs(scene, question, best, nodes)
                             : words(scene, question, placements, best, nodes);
    best = std::min(best, bound);
  }
}

}  // namespace prehensile
