#include "planner/bounds/word_node.h"

#include <algorithm>
#include <cmath>

#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kLength = 1e-7;  // [m] by which a piece may violate a law unnoticed

/// Lines are worth their price where the area between paths is worth this share of what
/// the widest box is.
constexpr double kLineWeight = 0.1;

/// One set of the laws of the ends, for one piece.
struct PieceEnds {
  std::array<double, 2> centre{};  // of the two sums of cross products
  std::array<Vec2, 2> gradient_from, gradient_to;
  std::array<double, 2> ends{};  // sums of the boxes' greatest distances from an end [m]
};

/// What the law of a contact says about one piece of the path.
struct Piece {
  const RunLaw* law = nullptr;
  double distance = 0.0;            // of the boxes, rounded down [m]
  double least = 0.0;               // travel [m]
  std::array<double, 2> advance{};  // greatest w_k.(-d) over the boxes
  double area = 0.0;                // at the centres [m^2]
  double remainder = 0.0;           // of the sums
  std::array<PieceEnds, RunLaw::kSets> set;
};

double distance_below(const PointBox& from, const PointBox& to) {
  const Vec2 d = to.centre - from.centre;
  const double length = d.norm();
  if (length == 0.0) return 0.0;
  const auto along = [&](const Vec2& u) {
    return std::abs(d.dot(u)) - from.reach(u) - to.reach(u);
  };
  double least = std::max(0.0, along(d / length));
  const double x = std::max(0.0, along({1.0, 0.0}));
  const double y = std::max(0.0, along({0.0, 1.0}));
  return std::max(least, std::hypot(x, y));
}

double cross_remainder(const PointBox& from, const PointBox& to) {
  double sum = 0.0;
  for (const Vec2& u : from.half) {
    for (const Vec2& v : to.half) sum += std::abs(cross(u, v));
  }
  return sum;
}

double farthest(const PointBox& box, const Vec2& end) {
  return (box.centre - end).norm() + box.half[0].norm() + box.half[1].norm();
}

/// Geometry of a piece; false if no path of any length fits.
bool make_piece(const WordScene& scene, const WordNode& node, int point, Piece& piece) {
  const PointBox& from = node.box[point - 1];
  const PointBox& to = node.box[point];
  const RunLaw& law = scene.laws->contacts[node.contact[point]];
  piece.law = &law;
  piece.distance = distance_below(from, to);
  piece.least = piece.distance;
  const Vec2 d = to.centre - from.centre;
  std::array<double, 2> middle, reach;
  for (int k = 0; k < 2; ++k) {
    middle[k] = -law.w[k].dot(d);
    reach[k] = from.reach(law.w[k]) + to.reach(law.w[k]);
    piece.advance[k] = middle[k] + reach[k] + kLength;
    if (piece.advance[k] < 0.0) {
      if (law.back[k] <= 0.0) return false;
      piece.least = std::max(piece.least, -piece.advance[k] / law.back[k]);
    }
    if (law.back[k] < 0.0 && piece.advance[k] < -law.back[k] * piece.distance) {
      return false;
    }
  }
  const double product = middle[0] * middle[1] / law.jacobian;
  piece.area = std::max(0.0, product);
  const Vec2 area_gradient =
      -(law.w[0] * middle[1] + law.w[1] * middle[0]) / law.jacobian;
  piece.remainder = cross_remainder(from, to) + reach[0] * reach[1] / law.jacobian;
  for (int set = 0; set < RunLaw::kSets; ++set) {
    PieceEnds& ends = piece.set[set];
    for (int k = 0; k < 2; ++k) {
      const EndLaw& end = law.end[set][k];
      const double sign = k == 0 ? -1.0 : 1.0;
      const Vec2 u = from.centre - end.place;
      const Vec2 v = to.centre - end.place;
      ends.centre[k] = cross(u, v) + sign * product;
      ends.gradient_from[k] = -perp(v) - sign * area_gradient;
      ends.gradient_to[k] = perp(u) + sign * area_gradient;
      if (end.slope != 0.0) {
        ends.ends[k] = farthest(from, end.place) + farthest(to, end.place);
      }
    }
  }
  return true;
}

/// Twice the area by which paths that may run back exceed those that may not.
double area_slack(const Piece& piece, double travel) {
  const double back_0 = std::max(0.0, piece.law->back[0]) * travel;
  const double back_1 = std::max(0.0, piece.law->back[1]) * travel;
  if (back_0 == 0.0 && back_1 == 0.0) return 0.0;
  const double a = std::max(0.0, piece.advance[0]);
  const double b = std::max(0.0, piece.advance[1]);
  return (2.0 * (a * back_1 + b * back_0) + 4.0 * back_0 * back_1) / piece.law->jacobian;
}

/// Greatest slack per travel of an end (k = 0: low, 1: high) [m]: every place of a path
/// of this travel is within (sum of the boxes' distances + travel) / 2 of the end.
double slack_rate(const WordScene& scene, const Piece& piece, int set, int k,
                  double most) {
  const EndLaw& end = piece.law->end[set][k];
  if (end.slope == 0.0) return end.per_travel;
  const double distance =
      std::min(scene.laws->reach, 0.5 * (piece.set[set].ends[k] + most));
  return end.per_travel + end.slope * distance;
}

/// Greatest slack of an end of a piece of this travel [m^2]; convex in the travel.
double end_slack(const Piece& piece, const EndLaw& end, double slack, double travel) {
  return std::max(0.0, slack) * travel + std::min(0.0, slack) * piece.least +
         end.per_path * piece.distance + area_slack(piece, travel);
}

/// Turns [rad] of a piece, and of the whole path.
struct Turns {
  double low, high;
};

/// Least path length of pieces with given distances whose turns lie in given ranges and
/// add up to a turn between turn_low and turn_high; from below.
double least_travel(const std::array<Piece, WordNode::kMaxPoints>& piece,
                    const std::array<Turns, WordNode::kMaxPoints>& turns, int points,
                    const Turns& whole, double c) {
  double straight = 0.0, forwards = 0.0, backwards = 0.0, each = 0.0;
  for (int i = 1; i < points; ++i) {
    straight += piece[i].distance;
    forwards += std::max(0.0, turns[i].low);
    backwards += std::max(0.0, -turns[i].high);
    const double forced = std::max({0.0, turns[i].low, -turns[i].high});
    each += std::max(piece[i].least, std::hypot(piece[i].distance, c * forced));
  }
  const double turned = std::max({forwards + backwards, 2.0 * forwards - whole.high,
                                  2.0 * backwards + whole.low, whole.low, -whole.high});
  double travel = std::max(each, std::hypot(straight, c * turned));
  for (const double lambda : {-0.9, -0.5, 0.5, 0.9}) {
    double sum = lambda * c * (lambda > 0.0 ? whole.low : whole.high);
    const double flattest = lambda / std::sqrt(1.0 - lambda * lambda);
    for (int i = 1; i < points; ++i) {
      const double best =
          std::clamp(flattest * piece[i].distance, c * turns[i].low, c * turns[i].high);
      sum += std::hypot(piece[i].distance, best) - lambda * best;
    }
    travel = std::max(travel, sum);
  }
  return travel;
}

/// Turns of the pieces by one set of laws, and the box whose half-edge matters most, kept
/// where it is wider than `widest`; false if their sum is not what is wanted.
bool bound_turns(const WordScene& scene, WordNode& node,
                 const std::array<Piece, WordNode::kMaxPoints>& piece, int set,
                 double spare, const Turns& whole,
                 std::array<Turns, WordNode::kMaxPoints>& turns, double& widest) {
  const int n = node.points;
  const double C = scene.laws->C[set];
  std::array<double, 2> sum{};  // of the two sides over all pieces
  std::array<double, 2> costliest{};
  std::array<std::array<Vec2, 2>, WordNode::kMaxPoints> gradient;
  for (int i = 0; i < n; ++i) gradient[i] = {Vec2::Zero(), Vec2::Zero()};
  for (int i = 1; i < n; ++i) {
    const Piece& p = piece[i];
    const PieceEnds& ends = p.set[set];
    std::array<double, 2> alone;
    for (int k = 0; k < 2; ++k) {
      const double sign = k == 0 ? -1.0 : 1.0;
      const EndLaw& law = p.law->end[set][k];
      const double slack = slack_rate(scene, p, set, k, p.least + spare);
      const double small = end_slack(p, law, slack, p.least);
      const double large = end_slack(p, law, slack, p.least + spare);
      costliest[k] = std::max(costliest[k], large - small);
      sum[k] += ends.centre[k] + sign * (small + p.remainder);
      alone[k] = ends.centre[k] + sign * (large + p.remainder +
                                          node.box[i - 1].reach(ends.gradient_from[k]) +
                                          node.box[i].reach(ends.gradient_to[k]));
      gradient[i - 1][k] += ends.gradient_from[k];
      gradient[i][k] += ends.gradient_to[k];
    }
    turns[i] = {std::max(turns[i].low, alone[0] / C),
                std::min(turns[i].high, alone[1] / C)};
    if (turns[i].low > turns[i].high) return false;
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 2; ++k) {
      sum[k] += (k == 0 ? -1.0 : 1.0) * node.box[i].reach(gradient[i][k]);
    }
    const bool goal = i == n - 1;  // only its arc can be divided
    for (int edge = 0; edge < (goal ? 1 : 2); ++edge) {
      const Vec2 half = goal ? node.goal_arc : node.box[i].half[edge];
      const double effect =
          std::abs(gradient[i][0].dot(half)) + std::abs(gradient[i][1].dot(half));
      const double weight = effect * scene.c / C + 2.0 * half.norm();
      if (weight <= widest || half.isZero(0.0)) continue;
      widest = weight;
      node.split = goal ? WordNode::Split::kGoal : WordNode::Split::kBox;
      node.split_point = static_cast<signed char>(i);
      node.split_edge = static_cast<signed char>(edge);
    }
  }
  return (sum[0] - costliest[0]) / C <= whole.high &&
         (sum[1] + costliest[1]) / C >= whole.low;
}

}  // namespace

bool bound_node(const WordScene& scene, double target, WordNode& node) noexcept {
  const int n = node.points;
  const double cap = (target - node.placements) * scene.L;
  std::array<Piece, WordNode::kMaxPoints> piece;
  double least = 0.0;
  for (int i = 1; i < n; ++i) {
    if (!make_piece(scene, node, i, piece[i])) return false;
    least += piece[i].least;
  }
  const double spare = cap - least;
  if (!(spare > 0.0)) return false;

  const Turns whole{node.turn_low, node.turn_high};
  std::array<Turns, WordNode::kMaxPoints> turns;
  turns.fill({-kInfinity, kInfinity});
  double widest = 0.0;
  for (int set = 0; set < RunLaw::kSets; ++set) {
    if (!bound_turns(scene, node, piece, set, spare, whole, turns, widest)) return false;
  }

  const double travel = least_travel(piece, turns, n, whole, scene.c);
  node.bound = std::max(node.bound, node.placements + travel / scene.L);
  if (node.bound >= target) return false;
  double largest = 0.0;
  for (int i = 1; i < n && n < WordNode::kMaxPoints; ++i) {
    const double worth = kLineWeight * piece[i].area * scene.c / scene.laws->C[1];
    if (worth <= std::max(widest, largest)) continue;
    largest = worth;
    node.split = WordNode::Split::kLine;
    node.split_point = static_cast<signed char>(i);
  }
  return true;
}

void cross_portals(const WordScene& scene, WordNode& node) noexcept {
  for (const Portal& portal : scene.portals) {
    for (int i = 1; i < node.points && node.points < WordNode::kMaxPoints; ++i) {
      const auto side = [&](const PointBox& box) {
        const double at = portal.normal.dot(box.centre - portal.from);
        const double reach = box.reach(portal.normal) + kLength;
        return at > reach ? 1 : at < -reach ? -1 : 0;
      };
      if (side(node.box[i - 1]) * side(node.box[i]) >= 0) continue;
      for (int k = node.points; k > i; --k) {
        node.box[k] = node.box[k - 1];
        node.contact[k] = node.contact[k - 1];
      }
      ++node.points;
      node.box[i].centre = 0.5 * (portal.from + portal.to);
      node.box[i].half = {0.5 * (portal.to - portal.from), Vec2::Zero()};
      ++i;
    }
  }
}

bool add_depth_line(const WordScene& scene, double target, int point, WordNode& node,
                    bool& possible) noexcept {
  possible = true;
  if (node.points >= WordNode::kMaxPoints) return false;
  const PointBox& from = node.box[point - 1];
  const PointBox& to = node.box[point];
  const RunLaw& law = scene.laws->contacts[node.contact[point]];
  const double top = law.n.dot(from.centre) - from.reach(law.n);
  const double bottom = law.n.dot(to.centre) + to.reach(law.n);
  if (top - bottom < 100.0 * kLength) return false;
  const double level = 0.5 * (top + bottom);
  const double cap = (target - node.placements) * scene.L;
  double low = -kInfinity, high = kInfinity;
  {
    double least = kInfinity, most = -kInfinity;
    for (const Vec2& v : scene.outline) {
      least = std::min(least, law.t.dot(v));
      most = std::max(most, law.t.dot(v));
    }
    low = least;
    high = most;
  }
  const double back_0 = std::max(0.0, law.back[0]) * cap;
  const double back_1 = std::max(0.0, law.back[1]) * cap;
  // w_0.(m - p) >= -back_0 on the way from m to p, and likewise for w_1 and to the end.
  const Vec2& w_0 = law.w[0];
  const Vec2& w_1 = law.w[1];
  high = std::min(high, w_0.dot(from.centre) + from.reach(w_0) - law.mu * level + back_0);
  low =
      std::max(low, -(w_1.dot(from.centre) + from.reach(w_1)) + law.mu * level - back_1);
  low = std::max(low, w_0.dot(to.centre) - to.reach(w_0) - law.mu * level - back_0);
  high = std::min(high, -(w_1.dot(to.centre) - to.reach(w_1)) + law.mu * level + back_1);
  low -= kLength;
  high += kLength;
  if (low > high) {
    possible = false;
    return true;
  }
  for (int k = node.points; k > point; --k) {
    node.box[k] = node.box[k - 1];
    node.contact[k] = node.contact[k - 1];
  }
  ++node.points;
  node.box[point].centre = level * law.n + 0.5 * (low + high) * law.t;
  node.box[point].half = {0.5 * (high - low) * law.t, Vec2::Zero()};
  return true;
}

}  // namespace prehensile
