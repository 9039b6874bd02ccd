#include "planner/word_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/segment.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostPlacements = 6;
constexpr double kWidestTurn = 0.5;  // [rad] of a first goal piece
constexpr double kNarrowestTurn = 1e-3;

bool worse(const WordNode& a, const WordNode& b) { return a.bound > b.bound; }

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

/// Nodes of one search, best first.
class OpenNodes {
 public:
  OpenNodes(const WordScene& scene, double target, std::int64_t& nodes)
      : scene_(scene), target_(target), nodes_(nodes) {}

  void add(WordNode node) {
    --nodes_;
    cross_portals(scene_, node);
    if (bound_node(scene_, target_, node)) {
      heap_.push_back(node);
      std::push_heap(heap_.begin(), heap_.end(), worse);
    }
  }

  /// The least bound of what is left, at most the target.
  double run(const WordQuestion& question) {
    while (!heap_.empty() && nodes_ > 0) {
      std::pop_heap(heap_.begin(), heap_.end(), worse);
      const WordNode node = heap_.back();
      if (node.split == WordNode::Split::kNone) return node.bound;
      heap_.pop_back();
      divide(question, node);
    }
    return heap_.empty() ? target_ : std::min(target_, heap_.front().bound);
  }

 private:
  void divide(const WordQuestion& question, const WordNode& node) {
    if (node.split == WordNode::Split::kLine) {
      WordNode child = node;
      bool possible = true;
      if (add_depth_line(scene_, target_, node.split_point, child, possible)) {
        if (possible) add(child);
        return;
      }
      child.points = node.points;
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
      heap_.push_back(last);
      std::push_heap(heap_.begin(), heap_.end(), worse);
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
  std::vector<WordNode> heap_;
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
  const int first = static_cast<int>(std::ceil((-most - high) / (2.0 * kPi)));
  const int last = static_cast<int>(std::floor((most - low) / (2.0 * kPi)));
  for (int k = first; k <= last; ++k) pieces(low + 2.0 * kPi * k, high + 2.0 * kPi * k);
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
                            set_goal(question, low, high, node);
                            open.add(node);
                          });
    }
    int i = 0;
    while (i < placements && ++word[i] == contacts) word[i++] = 0;
    if (i == placements) break;
  }
  return open.run(question);
}

bool on_side(const std::vector<Vec2>& outline, std::size_t from, std::size_t to,
             const Vec2& origin, const Vec2& normal) {
  for (std::size_t i = from; i != to; i = (i + 1) % outline.size()) {
    if (normal.dot(outline[i] - origin) < -1e-9) return false;
  }
  return true;
}

bool is_reflex(const std::vector<Vec2>& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vec2& v = outline[i];
  return cross(v - outline[(i + n - 1) % n], outline[(i + 1) % n] - v) < 0.0;
}

bool parts(const std::vector<Vec2>& outline, std::size_t i, std::size_t j,
           const Vec2& normal) {
  return (on_side(outline, i, j, outline[i], normal) &&
          on_side(outline, j, i, outline[i], -normal)) ||
         (on_side(outline, i, j, outline[i], -normal) &&
          on_side(outline, j, i, outline[i], normal));
}

/// Of each notch the shortest diagonal that parts the outline into the two sides of its
/// line, if there is one.
std::vector<Portal> portals_of(const std::vector<Vec2>& outline) {
  constexpr std::size_t kMostVertices = 64;
  std::vector<Portal> portals;
  const std::size_t n = outline.size();
  if (n > kMostVertices) return portals;
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_reflex(outline, i)) continue;
    Portal best;
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i || (j + 1) % n == i || (i + 1) % n == j) continue;
      const Vec2 along = outline[j] - outline[i];
      const Vec2 normal = perp(along).normalized();
      if (along.norm() >= length || !parts(outline, i, j, normal)) continue;
      if (!segment_inside(outline, outline[i], outline[j])) continue;
      length = along.norm();
      best = {outline[i], outline[j], normal};
    }
    const bool known = std::any_of(portals.begin(), portals.end(), [&](const Portal& p) {
      return p.from == best.to && p.to == best.from;
    });
    if (std::isfinite(length) && !known) portals.push_back(best);
  }
  return portals;
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
    best = std::min(best, words(scene, question, placements, best, nodes));
  }
}

}  // namespace prehensile
