#include "planner/bounds/run_program.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/segment.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kRounding = 1e-7;    // [m] by which a run may violate a law unnoticed
constexpr double kShallowest = 1e-4;  // [m] depth below which there is nothing to cut

/// Least and greatest t.p on the outline at a depth.
void borders_at(const std::vector<Vec2>& outline, const RunLaw& law, double depth,
                double& low, double& high) {
  low = kInfinity;
  high = -kInfinity;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& p = outline[i];
    const Vec2& q = outline[(i + 1) % outline.size()];
    const double a = -law.n.dot(p) - depth;
    const double b = -law.n.dot(q) - depth;
    if (std::min(a, b) > kRounding || std::max(a, b) < -kRounding) continue;
    const double share =
        std::abs(b - a) > kRounding ? std::clamp(a / (a - b), 0.0, 1.0) : 0.5;
    const bool along = std::abs(b - a) <= kRounding;
    const double at = law.t.dot(p + share * (q - p));
    low = std::min(low, along ? std::min(law.t.dot(p), law.t.dot(q)) : at);
    high = std::max(high, along ? std::max(law.t.dot(p), law.t.dot(q)) : at);
  }
}

/// Slack of the ends per tau because a path may run back: twice the area that it may gain
/// in a piece of these greatest advances, over its travel.
double running_back(const RunLaw& law, double advance_0, double advance_1,
                    double travel) {
  const double back_0 = std::max(0.0, law.back[0]);
  const double back_1 = std::max(0.0, law.back[1]);
  if (back_0 == 0.0 && back_1 == 0.0) return 0.0;
  return (2.0 * (advance_0 * back_1 + advance_1 * back_0) +
          4.0 * back_0 * back_1 * travel) /
         law.jacobian;
}

/// Least value of s hypot(D, x) + a x + q x^2 for |x| <= most, from below.
double least_of_step(double s, double D, double a, double q, double most) {
  double x = 0.0;
  double slope = a;
  for (int i = 0; i < 30; ++i) {
    const double r = std::sqrt(D * D + x * x);
    slope = s * x / r + a + 2.0 * q * x;
    const double curvature = s * D * D / (r * r * r) + 2.0 * q;
    if (!(curvature > 0.0)) break;
    const double next = std::clamp(x - slope / curvature, -most, most);
    if (std::abs(next - x) <= 1e-13 * most) break;
    // Beyond the inflections of the slope whole steps overshoot.
    x = std::abs(next - x) > D ? x + std::copysign(D, next - x) : next;
  }
  const double r = std::sqrt(D * D + x * x);
  slope = s * x / r + a + 2.0 * q * x;
  const double value = s * r + a * x + q * x * x;
  return value - std::max(slope * (x + most), slope * (x - most));
}

/// Depths below the start at which a run is cut: as far from each other as the corners of
/// the outline let them, which a piece could cut off. Each goes to the level next to it,
/// on the narrow side.
void set_levels(const std::vector<Vec2>& outline, const RunLaw& law, double start,
                double depth, std::array<double, kRunPieces>& level) {
  constexpr double kBeside = 2e-6;  // [m]
  const double D = depth / kRunPieces;
  for (int k = 0; k < kRunPieces; ++k) level[k] = (k + 1) * D;
  const auto width_at = [&](double at) {
    double low = 0.0, high = 0.0;
    borders_at(outline, law, at, low, high);
    return high - low;
  };
  for (const Vec2& corner : outline) {
    const double at = -law.n.dot(corner);
    const int k = static_cast<int>(std::lround((at - start) / D)) - 1;
    if (k < 0 || k + 1 >= kRunPieces) continue;
    const bool narrow_before = width_at(at - kBeside) <= width_at(at + kBeside);
    const double moved = at - start + (narrow_before ? -kBeside : kBeside);
    const double before = k > 0 ? level[k - 1] : 0.0;
    if (moved - before > 0.1 * D && level[k + 1] - moved > 0.1 * D) level[k] = moved;
  }
}

/// What the multipliers of the ends of a piece add up to.
struct EndSums {
  double difference = 0.0, lifted = 0.0, turning = 0.0, both = 0.0, per_path = 0.0;
  double length = 1.0;  // multiplier of the length
};

EndSums sums_of(const RunProgram& p, const RunMultipliers& multipliers, int piece) {
  const PieceMultipliers& m = multipliers.piece[piece];
  EndSums sums;
  sums.length -=
      p.back[0] * m.edge[0] + p.back[1] * m.edge[1] + p.retreat * (m.turn[0] + m.turn[1]);
  for (int set = 0; set < RunLaw::kSets; ++set) {
    const Pair& y = m.end[set];
    sums.difference += y[0] - y[1];
    sums.lifted += p.lift[set][0] * y[0] - p.lift[set][1] * y[1];
    sums.turning += p.ratio[set] * (y[0] - y[1]);
    sums.both += y[0] + y[1];
    sums.per_path -= p.per_path[set][0] * y[0] + p.per_path[set][1] * y[1];
    sums.length -= p.slack_of(set, 0, piece) * y[0] + p.slack_of(set, 1, piece) * y[1];
  }
  return sums;
}

/// Coefficients of where a run ends, and the least of what is left of the goal.
struct EndTerms {
  double u = 0.0, depth = 0.0, least = 0.0;
};

EndTerms terms_of_goal(const RunProgram& p, const RunMultipliers& y) {
  EndTerms terms;
  double share = 0.0;
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < kGoalDirections; ++k) {
      const double y_k = y.goal[i][k];
      const Vec2 w = goal_direction(k);
      terms.u += w.x() * y_k;
      terms.depth += w.y() * y_k;
      terms.least -= y_k * (p.goal.slack[i] + w.dot(Vec2(p.goal_u, p.goal_depth)));
      share -= y_k * (p.goal.slope[i] + w.dot(Vec2(p.arc_u, p.arc_depth)));
    }
  }
  terms.least -= std::abs(share);
  return terms;
}

/// Least value of the last piece, which is homogeneous in its steps but for its depth.
double least_of_rest(const RunProgram& p, const RunMultipliers& y, const EndTerms& goal,
                     double turn) {
  const PieceMultipliers& m = y.piece[kRunPieces];
  const EndSums sums = sums_of(p, y, kRunPieces);
  double depth = goal.depth - p.mu * (m.edge[0] + m.edge[1]);
  for (int set = 0; set < RunLaw::kSets; ++set) {
    for (int k = 0; k < 2; ++k) depth -= p.rest_lever(set, k) * m.end[set][k];
  }
  const double u =
      m.edge[0] - m.edge[1] + p.h[kRunPieces] * sums.difference - sums.lifted + goal.u;
  const double z = turn - sums.turning;
  if (sums.length < std::abs(z)) return -kInfinity;
  const double s = std::sqrt(sums.length * sums.length - z * z) + sums.per_path;
  if (s < std::abs(u)) return -kInfinity;
  return std::min(0.0, p.rest * (depth + std::sqrt(s * s - u * u)));
}

/// Value of the dual; -infinity outside its domain.
double dual_value(const RunProgram& p, const RunMultipliers& y) {
  // What a step of u does to all that comes after its piece.
  const EndTerms goal = terms_of_goal(p, y);
  double later = goal.u;
  const double turn = y.goal_z[1] - y.goal_z[0];
  double value = goal.least + y.goal_z[0] * p.goal_z[0] - y.goal_z[1] * p.goal_z[1] +
                 least_of_rest(p, y, goal, turn);
  for (int i = kRunPieces - 1; i >= 0; --i) {
    const PieceMultipliers& m = y.piece[i];
    const EndSums sums = sums_of(p, y, i);
    const double D = p.D[i];
    later += m.border[1] - m.border[0];
    const double u = m.edge[0] - m.edge[1] + (p.h[i] + 0.5 * D) * sums.difference -
                     sums.lifted + later;
    const double z =
        turn - sums.turning + p.beside[i][0] * m.turn[0] - p.beside[i][1] * m.turn[1];
    later += D * sums.difference;
    if (sums.length < std::abs(z)) return -kInfinity;
    const double s = std::sqrt(sums.length * sums.length - z * z) + sums.per_path;
    value += least_of_step(s, D, u, 0.5 * p.area * sums.both / p.mu, p.widest_step[i]) -
             (m.edge[0] + m.edge[1]) * p.mu * D - (m.turn[0] + m.turn[1]) * D -
             sums.both * 0.5 * p.area * p.mu * D * D + m.border[0] * p.border_low[i] -
             m.border[1] * p.border_high[i];
    for (int set = 0; set < RunLaw::kSets; ++set) {
      value += D * (m.end[set][1] * p.end[set][1] - m.end[set][0] * p.end[set][0]);
    }
  }
  return value;
}

RunMultipliers scaled(const RunMultipliers& y, double factor) {
  RunMultipliers result = y;
  const auto scale = [factor](Pair& pair) {
    for (double& value : pair) value *= factor;
  };
  for (PieceMultipliers& piece : result.piece) {
    scale(piece.edge);
    scale(piece.border);
    scale(piece.turn);
    for (Pair& end : piece.end) scale(end);
  }
  for (auto& directions : result.goal) {
    for (double& value : directions) value *= factor;
  }
  scale(result.goal_z);
  return result;
}

}  // namespace

RunProgram::RunProgram(const RunQuestion& question) {
  const RunLaw& law = question.laws->contacts[question.contact];
  const double start = -law.n.dot(question.start);
  const double u_start = law.t.dot(question.start);
  goal = question.goal;
  for (double& slack_of_goal : goal.slack) slack_of_goal += kRounding;
  const double reach = goal.reach(law.n);
  const double last = -law.n.dot(goal.centre) - reach;
  is_ahead = last > start + kShallowest;
  if (!is_ahead) return;
  mu = law.mu;
  rest = 2.0 * reach;
  back = law.back;
  area = question.chords_only ? 0.0 : 1.0;
  set_levels(*question.outline, law, start, last - start, level);
  set_laws(question, law, u_start);
  const double face = law.level;
  for (int k = 0; k < kRunPieces; ++k) {
    h[k] = -(start + level[k] - 0.5 * D[k]) - face;
    borders_at(*question.outline, law, start + level[k], border_low[k], border_high[k]);
    border_low[k] -= u_start + kRounding;
    border_high[k] -= u_start - kRounding;
  }
  h[kRunPieces] = -last - face;
  goal_u = law.t.dot(goal.centre) - u_start;
  arc_u = law.t.dot(goal.arc);
  goal_depth = reach;
  arc_depth = -law.n.dot(goal.arc);
  const double u_reach = goal.reach(law.t);
  rest_u = {std::max(border_low[kRunPieces - 1], goal_u - u_reach - widest_rest),
            std::min(border_high[kRunPieces - 1], goal_u + u_reach + widest_rest)};
  goal_z = {question.c * question.turn_low - kRounding,
            question.c * question.turn_high + kRounding};
  set_beside(question, law, start, u_start);
}

/// How far, at least, the face is beside the way in each piece: by the outline and by the
/// cones from the start and to the goal, at depths to which a path may have run back.
void RunProgram::set_beside(const RunQuestion& question, const RunLaw& law, double start,
                            double u_start) {
  retreat = law.retreat();
  const double back_up = std::max(0.0, back[0]) * question.cap;
  const double back_down = std::max(0.0, back[1]) * question.cap;
  const double goal_reach = goal.reach(law.t);
  const double deepest = level[kRunPieces - 1] + rest;
  for (int k = 0; k < kRunPieces; ++k) {
    const double to = level[k];
    const double from = level[k] - D[k] - retreat * question.cap;
    const Extent outline =
        extent_across(*question.outline, -law.n, law.t, start + from - kRounding,
                      start + to + kRounding);
    const double high =
        std::min({outline.high - u_start, mu * to + back_up,
                  goal_u + goal_reach + mu * (deepest - from) + back_down});
    const double low = std::max({outline.low - u_start, -mu * to - back_down,
                                 goal_u - goal_reach - mu * (deepest - from) - back_up});
    beside[k] = {law.face[0] - u_start - high - kRounding,
                 low - (law.face[1] - u_start) - kRounding};
    for (double& distance : beside[k]) {
      distance = std::max(0.0, distance) / question.c;
    }
  }
}

/// The laws of the contact in the units of the program; what a piece may run back by
/// depends on the travel that all others leave.
void RunProgram::set_laws(const RunQuestion& question, const RunLaw& law,
                          double u_start) {
  const double depth = level[kRunPieces - 1];
  const double most_back = std::max({0.0, back[0], back[1]});
  const auto widest = [&](double D_of_piece, double others) {
    return mu * D_of_piece + most_back * std::max(D_of_piece, question.cap - others);
  };
  const auto back_of = [&](double D_of_piece, double others) {
    const double advance = mu * D_of_piece + widest(D_of_piece, others);
    return area * running_back(law, advance, advance,
                               std::max(D_of_piece, question.cap - others));
  };
  for (int k = 0; k < kRunPieces; ++k) {
    D[k] = level[k] - (k > 0 ? level[k - 1] : 0.0);
    widest_step[k] = widest(D[k], depth - D[k]);
    run_back[k] = back_of(D[k], depth - D[k]);
  }
  widest_rest = widest(rest, depth);
  run_back[kRunPieces] = back_of(rest, depth);
  for (int set = 0; set < RunLaw::kSets; ++set) {
    ratio[set] = question.laws->C[set] / question.c;
    for (int k = 0; k < 2; ++k) {
      const EndLaw& of_end = law.end[set][k];
      end[set][k] = law.t.dot(of_end.place) - u_start;
      lift[set][k] = law.n.dot(of_end.place) - law.level;
      slack[set][k] = of_end.per_travel + of_end.slope * question.laws->reach;
      per_path[set][k] = of_end.per_path;
    }
  }
}

double GoalArc::widest() const {
  const auto at = [this](double share) {
    return std::min(slack[0] + slope[0] * share, slack[1] + slope[1] * share);
  };
  double most = std::max({0.0, at(-1.0), at(1.0)});
  if (slope[0] != slope[1]) {
    const double crossing = (slack[1] - slack[0]) / (slope[0] - slope[1]);
    if (std::abs(crossing) < 1.0) most = std::max(most, at(crossing));
  }
  return most;
}

/// Multipliers that are not quite optimal, or those of a goal out of reach, may lie
/// outside the domain; a little less of them does not.
double dual_bound(const RunProgram& program, const RunMultipliers& y) {
  constexpr std::array<double, 7> kFactors = {1.0, 0.99, 0.95, 0.8, 0.5, 0.25, 0.1};
  double best = -kInfinity;
  for (const double factor : kFactors) {
    best = std::max(best, dual_value(program, factor < 1.0 ? scaled(y, factor) : y));
    if (best > -kInfinity) break;
  }
  return best;
}

}  // namespace prehensile
