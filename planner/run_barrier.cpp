#include "planner/run_barrier.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kViolation = 1e3;  // cost of what is violated, per m
constexpr int kMostSteps = 30;      // of Newton's method, for one weight
constexpr double kSmallProduct = 1e-100;

}  // namespace

void RunBarrier::start() {
  x_.setZero();
  const double u = p_.goal_u;
  const double z = 0.5 * (p_.goal_z[0] + p_.goal_z[1]);
  const double depth = p_.level[kRunPieces - 1];
  for (int k = 0; k < kRunPieces; ++k) {
    const double share = p_.level[k] / depth;
    x_[3 * k] = share * u;
    x_[3 * k + 1] = share * z;
    x_[3 * k + 2] = 1.5 * std::hypot(depth, u, z) * p_.D[k] / depth;
  }
  x_[kRest] = 0.5 * p_.rest;
  x_[kRestTau] = p_.rest;
  const double worst = least_slack();
  x_[kV] = std::max(0.0, -worst) * 1.5 + depth / kRunPieces;
}

bool RunBarrier::centre(double weight) {
  for (int i = 0; i < kMostSteps; ++i) {
    double value = 0.0;
    if (!assemble(weight, value, true)) return false;
    if (!hessian_.factor()) return false;
    const Vector step = -hessian_.solve(gradient_);
    const double decrement = -gradient_.dot(step);
    if (!(decrement >= 0.0)) return false;
    if (decrement < 1e-4 * weight) return true;
    const Vector from = x_;
    double share = 1.0;
    for (int halvings = 0;; ++halvings, share *= 0.5) {
      if (halvings > 30) {
        x_ = from;
        return true;
      }
      x_ = from + share * step;
      double next = 0.0;
      if (assemble(weight, next, false) && next <= value - 0.1 * share * decrement) break;
    }
  }
  return true;
}

double RunBarrier::objective() const {
  double sum = kViolation * x_[kV] + x_[kRestTau];
  for (int k = 0; k < kRunPieces; ++k) sum += x_[3 * k + 2];
  return sum;
}

/// One constraint g >= 0: its share of the barrier; false where it is violated. `slope`
/// gives its Gradient, where that is needed.
template <typename Slope>
bool RunBarrier::take(double g, const Slope& slope, double* multiplier) {
  if (only_least_) {
    least_ = std::min(least_, g);
    return true;
  }
  if (!(g > 0.0)) return false;
  product_ *= g;
  if (!(product_ > kSmallProduct && product_ < 1.0 / kSmallProduct)) count_logarithms();
  if (!derivatives_) return true;
  const double y = weight_ / g;
  if (multiplier) *multiplier = y;
  const Gradient by = slope();
  for (int i = 0; i < by.count; ++i) {
    gradient_[by.index[i]] -= y * by.value[i];
    const double scaled = y / g * by.value[i];
    for (int j = 0; j <= i; ++j) {
      hessian_.add(by.index[i], by.index[j], scaled * by.value[j]);
    }
  }
  return true;
}

/// A logarithm takes longer than all the rest of a constraint: one for many.
void RunBarrier::count_logarithms() {
  value_ -= weight_ * std::log(product_);
  product_ = 1.0;
}

/// Adds y times the second derivative of sqrt(sum of squares of three differences);
/// `to` and `from` are variables, -1: none.
void RunBarrier::add_curvature_of_length(double y, const std::array<double, 3>& d,
                                         const std::array<int, 3>& to,
                                         const std::array<int, 3>& from, double length) {
  if (!derivatives_) return;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double second =
          y * ((i == j ? 1.0 : 0.0) - d[i] * d[j] / (length * length)) / length;
      add_second(to[i], to[j], second);
      add_second(to[i], from[j], -second);
      add_second(from[i], to[j], -second);
      add_second(from[i], from[j], second);
    }
  }
}

void RunBarrier::add_second(int i, int j, double value) {
  if (j >= 0) hessian_.add(i, j, value);
}

bool RunBarrier::take_piece(int k) {
  PieceMultipliers& y = y_.piece[k];
  const int u = 3 * k, z = u + 1, tau = u + 2;
  const int u_0 = k > 0 ? u - 3 : -1, z_0 = k > 0 ? z - 3 : -1;
  const double from_u = k > 0 ? x_[u_0] : 0.0;
  const double du = x_[u] - from_u;
  const double dz = x_[z] - (k > 0 ? x_[z_0] : 0.0);
  const double mean_u = from_u + 0.5 * du;
  const double D = p_.D[k];
  const double path = std::sqrt(D * D + du * du);
  const double length = std::sqrt(path * path + dz * dz);
  const auto slope_of = [&](double by_du, double by_dz, double by_mean, double by_tau,
                            double by_v) {
    Gradient slope;
    if (k > 0) {
      slope.add(u_0, -by_du + 0.5 * by_mean);
      slope.add(z_0, -by_dz);
    }
    slope.add(u, by_du + 0.5 * by_mean);
    slope.add(z, by_dz);
    slope.add(tau, by_tau);
    slope.add(kV, by_v);
    return slope;
  };
  double y_length = 0.0;
  const auto by_length = [&] {
    return slope_of(-du / length, -dz / length, 0.0, 1.0, 0.0);
  };
  if (!take(x_[tau] - length, by_length, &y_length)) return false;
  add_curvature_of_length(y_length, {D, du, dz}, {-1, u, z}, {-1, u_0, z_0}, length);
  for (int e = 0; e < 2; ++e) {
    const double sign = e == 0 ? -1.0 : 1.0;
    const double edge = p_.mu * D + sign * du + p_.back[e] * x_[tau] + x_[kV];
    const auto by_edge = [&] { return slope_of(sign, 0.0, 0.0, p_.back[e], 1.0); };
    if (!take(edge, by_edge, &y.edge[e])) return false;
    const double side = -sign;  // of the ends
    for (int set = 0; set < RunLaw::kSets; ++set) {
      const double ratio = p_.ratio[set];
      const double per_path = p_.per_path[set][e];
      const double area = 0.5 * p_.area * (p_.mu * D * D - du * du / p_.mu);
      const double end =
          side * (ratio * dz - p_.h[k] * du - D * (mean_u - p_.end[set][e])) + area +
          p_.slack_of(set, e, k) * x_[tau] + per_path * path + ratio * x_[kV];
      const auto by_end = [&] {
        return slope_of(-side * p_.h[k] - p_.area * du / p_.mu + per_path * du / path,
                        side * ratio, -side * D, p_.slack_of(set, e, k), ratio);
      };
      if (!take(end, by_end, &y.end[set][e])) return false;
      if (!derivatives_) continue;
      const double second =
          y.end[set][e] * (p_.area / p_.mu - per_path * D * D / (path * path * path));
      add_second(u, u, second);
      add_second(u, u_0, -second);
      add_second(u_0, u, -second);
      add_second(u_0, u_0, second);
    }
    if (p_.beside[k][e] > 0.0) {
      const double turn = p_.beside[k][e] * side;
      const auto by_turn = [&] { return slope_of(0.0, -turn, 0.0, p_.retreat, 1.0); };
      if (!take(D + p_.retreat * x_[tau] - turn * dz + x_[kV], by_turn, &y.turn[e])) {
        return false;
      }
    }
    const double at = e == 0 ? x_[u] - p_.border_low[k] : p_.border_high[k] - x_[u];
    const auto by_border = [&] {
      Gradient slope;
      slope.add(u, side);
      slope.add(kV, 1.0);
      return slope;
    };
    if (!take(at + x_[kV], by_border, &y.border[e])) return false;
  }
  return true;
}

bool RunBarrier::take_rest() {
  PieceMultipliers& y = y_.piece[kRunPieces];
  const int depth = kRest, u = kRestU, z = kRestZ, tau = kRestTau;
  const std::array<double, 3> d{x_[depth], x_[u], x_[z]};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const auto by_length = [&] {
    Gradient slope;
    slope.add(depth, -d[0] / length);
    slope.add(u, -d[1] / length);
    slope.add(z, -d[2] / length);
    slope.add(tau, 1.0);
    return slope;
  };
  double y_length = 0.0;
  if (!take(x_[tau] - length, by_length, &y_length)) return false;
  add_curvature_of_length(y_length, d, {depth, u, z}, {-1, -1, -1}, length);
  const auto by_depth = [&](double sign) {
    Gradient slope;
    slope.add(depth, sign);
    return slope;
  };
  if (!take(
          d[0], [&] { return by_depth(1.0); }, nullptr) ||
      !take(
          p_.rest - d[0], [&] { return by_depth(-1.0); }, nullptr)) {
    return false;
  }
  for (int e = 0; e < 2; ++e) {
    const double sign = e == 0 ? -1.0 : 1.0;
    const double edge = p_.mu * d[0] + sign * d[1] + p_.back[e] * x_[tau] + x_[kV];
    const auto by_edge = [&] {
      Gradient slope;
      slope.add(depth, p_.mu);
      slope.add(u, sign);
      slope.add(tau, p_.back[e]);
      slope.add(kV, 1.0);
      return slope;
    };
    if (!take(edge, by_edge, &y.edge[e])) return false;
    for (int set = 0; set < RunLaw::kSets; ++set) {
      if (!take_rest_end(set, e, d, y.end[set][e])) return false;
    }
  }
  return true;
}

bool RunBarrier::take_rest_end(int set, int e, const std::array<double, 3>& d,
                               double& y) {
  const double side = e == 0 ? 1.0 : -1.0;
  const double ratio = p_.ratio[set];
  const double per_path = p_.per_path[set][e];
  const double path = std::hypot(d[0], d[1]);
  const auto by_end = [&] {
    Gradient slope;
    slope.add(kRest, p_.rest_lever(set, e) + per_path * d[0] / path);
    slope.add(kRestU, -side * p_.h[kRunPieces] + per_path * d[1] / path);
    slope.add(kRestZ, side * ratio);
    slope.add(kRestTau, p_.slack_of(set, e, kRunPieces));
    slope.add(kV, ratio);
    return slope;
  };
  const double slack = side * (ratio * d[2] - p_.h[kRunPieces] * d[1]) +
                       p_.rest_lever(set, e) * d[0] + per_path * path +
                       p_.slack_of(set, e, kRunPieces) * x_[kRestTau] + ratio * x_[kV];
  if (!take(slack, by_end, &y)) return false;
  add_curvature_of_length(-per_path * y, {d[0], d[1], 0.0}, {kRest, kRestU, -1},
                          {-1, -1, -1}, path);
  return true;
}

bool RunBarrier::take_goal() {
  const int u = kRest - 3, z = kRest - 2;
  const double share = x_[kShare];
  const Vec2 arc(p_.arc_u, p_.arc_depth);
  const Vec2 off =
      Vec2(x_[u] + x_[kRestU] - p_.goal_u, x_[kRest] - p_.goal_depth) - share * arc;
  for (int i = 0; i < 2; ++i) {
    const double room = p_.goal.slack[i] + p_.goal.slope[i] * share + x_[kV];
    for (int k = 0; k < kGoalDirections; ++k) {
      const Vec2 w = goal_direction(k);
      const auto by_direction = [&] {
        Gradient slope;
        slope.add(u, -w.x());
        slope.add(kRest, -w.y());
        slope.add(kRestU, -w.x());
        slope.add(kShare, p_.goal.slope[i] + w.dot(arc));
        slope.add(kV, 1.0);
        return slope;
      };
      if (!take(room - w.dot(off), by_direction, &y_.goal[i][k])) return false;
    }
  }
  const double end_z = x_[z] + x_[kRestZ];
  for (int e = 0; e < 2; ++e) {
    const double side = e == 0 ? -1.0 : 1.0;
    const auto by_z = [&] {
      Gradient slope;
      slope.add(z, -side);
      slope.add(kRestZ, -side);
      slope.add(kV, 1.0);
      return slope;
    };
    const auto by_share = [&] {
      Gradient slope;
      slope.add(kShare, -side);
      return slope;
    };
    if (!take(side * (p_.goal_z[e] - end_z) + x_[kV], by_z, &y_.goal_z[e]) ||
        !take(1.0 - side * share, by_share, nullptr)) {
      return false;
    }
  }
  return true;
}

bool RunBarrier::take_all() {
  for (int k = 0; k < kRunPieces; ++k) {
    if (!take_piece(k)) return false;
  }
  const auto by_violation = [&] {
    Gradient slope;
    slope.add(kV, 1.0);
    return slope;
  };
  return take_rest() && take_goal() && take(x_[kV], by_violation, nullptr);
}

/// Least of all constraints, by which v has to be raised at the start.
double RunBarrier::least_slack() {
  only_least_ = true;
  derivatives_ = false;
  least_ = kInfinity;
  take_all();
  only_least_ = false;
  // The laws of the ends are in m^2, v counts `ratio` of that.
  return least_ / std::min({1.0, p_.ratio[0], p_.ratio[1]});
}

bool RunBarrier::assemble(double weight, double& value, bool derivatives) {
  weight_ = weight;
  derivatives_ = derivatives;
  value_ = objective();
  if (derivatives) {
    gradient_.setZero();
    hessian_.set_zero();
    for (int k = 0; k < kRunPieces; ++k) gradient_[3 * k + 2] = 1.0;
    gradient_[kRestTau] = 1.0;
    gradient_[kV] = kViolation;
  }
  product_ = 1.0;
  const bool inside = take_all();
  count_logarithms();
  value = value_;
  return inside;
}

}  // namespace prehensile
