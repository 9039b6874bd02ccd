#include "planner/run_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
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
    const double r = std::hypot(D, x);
    slope = s * x / r + a + 2.0 * q * x;
    const double curvature = s * D * D / (r * r * r) + 2.0 * q;
    if (!(curvature > 0.0)) break;
    const double next = std::clamp(x - slope / curvature, -most, most);
    if (std::abs(next - x) <= 1e-13 * most) break;
    // Beyond the inflections of the slope whole steps overshoot.
    x = std::abs(next - x) > D ? x + std::copysign(D, next - x) : next;
  }
  slope = s * x / std::hypot(D, x) + a + 2.0 * q * x;
  const double value = s * std::hypot(D, x) + a * x + q * x * x;
  return value - std::max(slope * (x + most), slope * (x - most));
}

/// What the multipliers of the ends of a piece add up to.
struct EndSums {
  double difference = 0.0, turning = 0.0, both = 0.0, per_path = 0.0;
  double length = 1.0;  // multiplier of the length
};

EndSums sums_of(const RunProgram& p, const PieceMultipliers& m, const Pairs& slack) {
  EndSums sums;
  sums.length -= p.back[0] * m.edge[0] + p.back[1] * m.edge[1];
  for (int set = 0; set < RunLaw::kSets; ++set) {
    const Pair& y = m.end[set];
    sums.difference += y[0] - y[1];
    sums.turning += p.ratio[set] * (y[0] - y[1]);
    sums.both += y[0] + y[1];
    sums.per_path -= p.per_path[set][0] * y[0] + p.per_path[set][1] * y[1];
    sums.length -= slack[set][0] * y[0] + slack[set][1] * y[1];
  }
  return sums;
}

/// Least value of the last piece, which is homogeneous in its steps but for its depth.
double least_of_rest(const RunProgram& p, const PieceMultipliers& m, double later,
                     double turn) {
  const EndSums sums = sums_of(p, m, p.rest_slack);
  double depth = -p.mu * (m.edge[0] + m.edge[1]);
  for (int set = 0; set < RunLaw::kSets; ++set) {
    for (int k = 0; k < 2; ++k) depth -= p.rest_lever(set, k) * m.end[set][k];
  }
  const double u = m.edge[0] - m.edge[1] + p.h[kRunPieces] * sums.difference + later;
  const double z = turn - sums.turning;
  if (sums.length < std::abs(z)) return -kInfinity;
  const double s = std::sqrt(sums.length * sums.length - z * z) + sums.per_path;
  if (s < std::abs(u)) return -kInfinity;
  return std::min(0.0, p.rest * (depth + std::sqrt(s * s - u * u)));
}

/// Value of the dual; -infinity outside its domain.
double dual_value(const RunProgram& p, const RunMultipliers& y) {
  // What a step of u does to all that comes after its piece.
  double later = y.goal_u[1] - y.goal_u[0];
  const double turn = y.goal_z[1] - y.goal_z[0];
  double value = y.goal_u[0] * p.goal_u[0] - y.goal_u[1] * p.goal_u[1] +
                 y.goal_z[0] * p.goal_z[0] - y.goal_z[1] * p.goal_z[1] +
                 least_of_rest(p, y.piece[kRunPieces], later, turn);
  for (int i = kRunPieces - 1; i >= 0; --i) {
    const PieceMultipliers& m = y.piece[i];
    const EndSums sums = sums_of(p, m, p.slack);
    later += m.border[1] - m.border[0];
    const double u =
        m.edge[0] - m.edge[1] + (p.h[i] + 0.5 * p.D) * sums.difference + later;
    const double z = turn - sums.turning;
    later += p.D * sums.difference;
    if (sums.length < std::abs(z)) return -kInfinity;
    const double s = std::sqrt(sums.length * sums.length - z * z) + sums.per_path;
    value += least_of_step(s, p.D, u, 0.5 * p.area * sums.both / p.mu, p.widest_step) -
             (m.edge[0] + m.edge[1]) * p.mu * p.D -
             sums.both * 0.5 * p.area * p.mu * p.D * p.D + m.border[0] * p.border_low[i] -
             m.border[1] * p.border_high[i];
    for (int set = 0; set < RunLaw::kSets; ++set) {
      value += p.D * (m.end[set][1] * p.end[set][1] - m.end[set][0] * p.end[set][0]);
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
    for (Pair& end : piece.end) scale(end);
  }
  scale(result.goal_u);
  scale(result.goal_z);
  return result;
}

}  // namespace

RunProgram::RunProgram(const RunQuestion& question) {
  const RunLaw& law = question.laws->contacts[question.contact];
  const double start = -law.n.dot(question.start);
  const double u_start = law.t.dot(question.start);
  const double reach = question.goal.reach(law.n) + kRounding;
  const double last = -law.n.dot(question.goal.centre) - reach;
  is_ahead = last > start + kShallowest;
  if (!is_ahead) return;
  mu = law.mu;
  D = (last - start) / kRunPieces;
  rest = 2.0 * reach;
  back = law.back;
  area = question.chords_only ? 0.0 : 1.0;
  const double most_back = std::max({0.0, back[0], back[1]});
  const double longest = std::max(D, question.cap - (kRunPieces - 1) * D);
  widest_step = mu * D + most_back * longest;
  const double widest_rest = mu * rest + most_back * longest;
  const double run_back =
      area * running_back(law, mu * D + widest_step, mu * D + widest_step, longest);
  const double rest_back =
      area * running_back(law, mu * rest + widest_rest, mu * rest + widest_rest, longest);
  for (int set = 0; set < RunLaw::kSets; ++set) {
    ratio[set] = question.laws->C[set] / question.c;
    for (int k = 0; k < 2; ++k) {
      const EndLaw& of_end = law.end[set][k];
      const double own = of_end.per_travel + of_end.slope * question.laws->reach;
      end[set][k] = law.t.dot(of_end.place) - u_start;
      slack[set][k] = own + run_back;
      rest_slack[set][k] = own + rest_back;
      per_path[set][k] = of_end.per_path;
    }
  }
  const double face = law.n.dot(law.end[0][0].place);
  for (int k = 0; k < kRunPieces; ++k) {
    h[k] = -(start + (k + 0.5) * D) - face;
    borders_at(*question.outline, law, start + (k + 1) * D, border_low[k],
               border_high[k]);
    border_low[k] -= u_start + kRounding;
    border_high[k] -= u_start - kRounding;
  }
  h[kRunPieces] = -last - face;
  const double u_goal = law.t.dot(question.goal.centre) - u_start;
  const double u_reach = question.goal.reach(law.t) + kRounding;
  goal_u = {u_goal - u_reach, u_goal + u_reach};
  rest_u = {std::max(border_low[kRunPieces - 1], goal_u[0] - widest_rest),
            std::min(border_high[kRunPieces - 1], goal_u[1] + widest_rest)};
  goal_z = {question.c * question.turn_low - kRounding,
            question.c * question.turn_high + kRounding};
}

/// Multipliers that are not quite optimal, or those of a goal out of reach, may lie
/// outside the domain; a little less of them does not.
double dual_bound(const RunProgram& program, const RunMultipliers& y) {
  constexpr std::array<double, 5> kFactors = {1.0, 0.99, 0.95, 0.8, 0.5};
  double best = -kInfinity;
  for (const double factor : kFactors) {
    best = std::max(best, dual_value(program, factor < 1.0 ? scaled(y, factor) : y));
    if (best > -kInfinity) break;
  }
  return best;
}

}  // namespace prehensile
