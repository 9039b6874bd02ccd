#include "planner/bounds/run_slopes.h"

#include <cmath>

namespace prehensile {
namespace {

// Places of the laws of a piece in RunNumbers, and of those of the end.
constexpr int kLength = 0;
constexpr int edge(int e) { return 1 + e; }
constexpr int end(int set, int e) { return 3 + 2 * set + e; }
constexpr int turn(int e) { return 7 + e; }
constexpr int border(int e) { return 9 + e; }

constexpr int kEndLength = 0;
constexpr int kDepth = 1;  // at least 0, and at most the rest
constexpr int end_edge(int e) { return 3 + e; }
constexpr int end_end(int set, int e) { return 5 + 2 * set + e; }
constexpr int goal(int i, int direction) { return 9 + kGoalDirections * i + direction; }
constexpr int goal_z(int e) { return 25 + e; }
constexpr int goal_share(int e) { return 27 + e; }
constexpr int kNotNegative = 29;  // the violation

/// Variables of the end, from u of the last piece on.
enum OfEnd { kU, kZ, kTauBefore, kD, kStepU, kShareOfArc, kStepZ, kEndTau, kEndV };

/// The last of kRunPieces + 1 is the rest's.
template <std::size_t kCount>
auto each(const std::array<double, kCount>& values) {
  return Eigen::Map<const PieceValues>(values.data());
}

/// Every third of x.
PieceValues variable(const RunVector& x, int first) {
  return Eigen::Map<const PieceValues, 0, Eigen::InnerStride<3>>(x.data() + first);
}

PieceValues before(const PieceValues& values) {
  PieceValues shifted;
  shifted[0] = 0.0;
  shifted.tail<kRunPieces - 1>() = values.head<kRunPieces - 1>();
  return shifted;
}

struct Steps {
  PieceValues du, dz, mid, tau, path, length;
};

Steps steps_of(const RunVector& x, const RunProgram& p) {
  Steps steps;
  const PieceValues u = variable(x, 0), z = variable(x, 1);
  const PieceValues from = before(u);
  steps.du = u - from;
  steps.dz = z - before(z);
  steps.mid = 0.5 * (u + from);
  steps.tau = variable(x, 2);
  steps.path = (each(p.D).square() + steps.du.square()).sqrt();
  steps.length = (steps.path.square() + steps.dz.square()).sqrt();
  return steps;
}

double sign_of(int e) { return e == 0 ? -1.0 : 1.0; }

}  // namespace

RunSlopes::RunSlopes(const RunProgram& program) : p_(program) {
  for_each_law([](auto& there) { there.setOnes(); }, is_there_);
  for (int e = 0; e < 2; ++e) {
    for (int k = 0; k < kRunPieces; ++k) beside_[e][k] = p_.beside[k][e];
    is_there_.piece[turn(e)] = (beside_[e] > 0.0).cast<double>();
  }
  set_slopes_of_pieces();
  set_slopes_of_end();
}

RunNumbers RunSlopes::slacks_at(const RunVector& x) const {
  RunNumbers slack;
  const Steps s = steps_of(x, p_);
  const double v = x[RunIndex::kV];
  const auto D = each(p_.D);
  slack.piece[kLength] = s.tau - s.length;
  const PieceValues area = (0.5 * p_.area) * (p_.mu * D.square() - s.du.square() / p_.mu);
  for (int e = 0; e < 2; ++e) {
    const double sign = sign_of(e);
    slack.piece[edge(e)] = p_.mu * D + sign * s.du + p_.back[e] * s.tau + v;
    for (int set = 0; set < RunLaw::kSets; ++set) {
      const double ratio = p_.ratio[set];
      slack.piece[end(set, e)] =
          -sign * (ratio * s.dz - (each(p_.h) - p_.lift[set][e]) * s.du -
                   D * (s.mid - p_.end[set][e])) +
          area + (p_.slack[set][e] + each(p_.run_back)) * s.tau +
          p_.per_path[set][e] * s.path + ratio * v;
    }
    const PieceValues turn_slack = D + p_.retreat * s.tau + sign * beside_[e] * s.dz + v;
    slack.piece[turn(e)] = (beside_[e] > 0.0).select(turn_slack, 1.0);
  }
  const PieceValues u = variable(x, 0);
  slack.piece[border(0)] = u - each(p_.border_low) + v;
  slack.piece[border(1)] = each(p_.border_high) - u + v;
  slack.end = end_slacks_at(x);
  return slack;
}

RunSlopes::End RunSlopes::end_slacks_at(const RunVector& x) const {
  End slack;
  const Eigen::Vector3d d(x[RunIndex::kRest], x[RunIndex::kRestU], x[RunIndex::kRestZ]);
  const double tau = x[RunIndex::kRestTau], v = x[RunIndex::kV];
  const double share = x[RunIndex::kShare];
  const double path = d.head<2>().norm();
  slack[kEndLength] = tau - d.norm();
  slack[kDepth] = d[0];
  slack[kDepth + 1] = p_.rest - d[0];
  for (int e = 0; e < 2; ++e) {
    const double sign = sign_of(e);
    slack[end_edge(e)] = p_.mu * d[0] + sign * d[1] + p_.back[e] * tau + v;
    for (int set = 0; set < RunLaw::kSets; ++set) {
      const double h = p_.h[kRunPieces] - p_.lift[set][e];
      slack[end_end(set, e)] = -sign * (p_.ratio[set] * d[2] - h * d[1]) +
                               p_.rest_lever(set, e) * d[0] + p_.per_path[set][e] * path +
                               p_.slack_of(set, e, kRunPieces) * tau + p_.ratio[set] * v;
    }
    slack[goal_z(e)] = sign * (p_.goal_z[e] - x[RunIndex::kLastU + kZ] - d[2]) + v;
    slack[goal_share(e)] = 1.0 - sign * share;
  }
  const Vec2 off(x[RunIndex::kLastU] + d[1] - p_.goal_u - share * p_.arc_u,
                 d[0] - p_.goal_depth - share * p_.arc_depth);
  for (int i = 0; i < 2; ++i) {
    const double room = p_.goal.slack[i] + p_.goal.slope[i] * share + v;
    for (int k = 0; k < kGoalDirections; ++k) {
      slack[goal(i, k)] = room - goal_direction(k).dot(off);
    }
  }
  slack[kNotNegative] = v;
  return slack;
}

/// All that are constant.
void RunSlopes::set_slopes_of_pieces() {
  for (PieceSlopes& by : by_) {
    for (PieceValues& slope : by) slope.setZero();
  }
  by_[kLength][kTau].setOnes();
  for (int e = 0; e < 2; ++e) {
    const double sign = sign_of(e);
    by_[edge(e)][kDu].setConstant(sign);
    by_[edge(e)][kTau].setConstant(p_.back[e]);
    by_[edge(e)][kViolated].setOnes();
    for (int set = 0; set < RunLaw::kSets; ++set) {
      PieceSlopes& by = by_[end(set, e)];
      by[kDz].setConstant(-sign * p_.ratio[set]);
      by[kMid] = sign * each(p_.D);
      by[kTau] = p_.slack[set][e] + each(p_.run_back);
      by[kViolated].setConstant(p_.ratio[set]);
    }
    by_[turn(e)][kDz] = sign * beside_[e];
    by_[turn(e)][kTau] = p_.retreat * is_there_.piece[turn(e)];
    by_[turn(e)][kViolated] = is_there_.piece[turn(e)];
    by_[border(e)][kDu].setConstant(-0.5 * sign);
    by_[border(e)][kMid].setConstant(-sign);
    by_[border(e)][kViolated].setOnes();
  }
}

void RunSlopes::set_slopes_of_end() {
  by_end_.setZero();
  by_end_(kEndLength, kEndTau) = 1.0;
  by_end_(kDepth, kD) = 1.0;
  by_end_(kDepth + 1, kD) = -1.0;
  by_end_(kNotNegative, kEndV) = 1.0;
  for (int e = 0; e < 2; ++e) {
    const double sign = sign_of(e);
    by_end_(end_edge(e), kD) = p_.mu;
    by_end_(end_edge(e), kStepU) = sign;
    by_end_(end_edge(e), kEndTau) = p_.back[e];
    by_end_(end_edge(e), kEndV) = 1.0;
    for (int set = 0; set < RunLaw::kSets; ++set) {
      by_end_(end_end(set, e), kStepZ) = -sign * p_.ratio[set];
      by_end_(end_end(set, e), kEndTau) = p_.slack_of(set, e, kRunPieces);
      by_end_(end_end(set, e), kEndV) = p_.ratio[set];
    }
    by_end_(goal_z(e), kZ) = by_end_(goal_z(e), kStepZ) = -sign;
    by_end_(goal_z(e), kEndV) = 1.0;
    by_end_(goal_share(e), kShareOfArc) = -sign;
  }
  const Vec2 arc(p_.arc_u, p_.arc_depth);
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < kGoalDirections; ++k) {
      const Vec2 w = goal_direction(k);
      by_end_(goal(i, k), kU) = by_end_(goal(i, k), kStepU) = -w.x();
      by_end_(goal(i, k), kD) = -w.y();
      by_end_(goal(i, k), kShareOfArc) = p_.goal.slope[i] + w.dot(arc);
      by_end_(goal(i, k), kEndV) = 1.0;
    }
  }
}

void RunSlopes::linearise(const RunVector& x, const RunNumbers& y) {
  const Steps s = steps_of(x, p_);
  const PieceValues out_u = s.du / s.length, out_z = s.dz / s.length;
  by_[kLength][kDu] = -out_u;
  by_[kLength][kDz] = -out_z;
  const PieceValues y_length = y.piece[kLength] / s.length;
  bend_uu_ = y_length * (1.0 - out_u.square());
  bend_uz_ = -y_length * out_u * out_z;
  bend_zz_ = y_length * (1.0 - out_z.square());
  const PieceValues of_path = (each(p_.D) / s.path).square() / s.path;
  for (int e = 0; e < 2; ++e) {
    for (int set = 0; set < RunLaw::kSets; ++set) {
      const double per_path = p_.per_path[set][e];
      by_[end(set, e)][kDu] = sign_of(e) * (each(p_.h) - p_.lift[set][e]) -
                              (p_.area / p_.mu) * s.du + per_path * s.du / s.path;
      bend_uu_ += y.piece[end(set, e)] * (p_.area / p_.mu - per_path * of_path);
    }
  }
  linearise_end(x, y.end);
}

void RunSlopes::linearise_end(const RunVector& x, const End& y) {
  const Eigen::Vector3d d(x[RunIndex::kRest], x[RunIndex::kRestU], x[RunIndex::kRestZ]);
  const double length = d.norm();
  const double path = d.head<2>().norm();
  constexpr std::array at = {kD, kStepU, kStepZ};
  bend_of_end_.setZero();
  const auto add_bend = [&](double weight, double norm, int count) {
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j <= i; ++j) {
        const double same = i == j ? 1.0 : 0.0;
        bend_of_end_(at[i], at[j]) +=
            weight / norm * (same - d[i] * d[j] / (norm * norm));
      }
    }
  };
  for (int i = 0; i < 3; ++i) by_end_(kEndLength, at[i]) = -d[i] / length;
  add_bend(y[kEndLength], length, 3);
  for (int e = 0; e < 2; ++e) {
    for (int set = 0; set < RunLaw::kSets; ++set) {
      const double per_path = p_.per_path[set][e];
      by_end_(end_end(set, e), kD) = p_.rest_lever(set, e) + per_path * d[0] / path;
      by_end_(end_end(set, e), kStepU) =
          sign_of(e) * (p_.h[kRunPieces] - p_.lift[set][e]) + per_path * d[1] / path;
      add_bend(-per_path * y[end_end(set, e)], path, 2);
    }
  }
}

void RunSlopes::add_squares(const RunNumbers& weights, RunHessian& hessian) const {
  add_squares_of_pieces(weights, hessian);
  add_squares_of_end(weights.end, hessian);
}

void RunSlopes::add_squares_of_pieces(const RunNumbers& weights,
                                      RunHessian& hessian) const {
  std::array<std::array<PieceValues, kOfPiece>, kOfPiece> sum;  // lower triangle
  for (int i = 0; i < kOfPiece; ++i) {
    for (int j = 0; j <= i; ++j) sum[i][j].setZero();
  }
  for (int law = 0; law < RunNumbers::kLaws; ++law) {
    const PieceSlopes& by = by_[law];
    for (int i = 0; i < kOfPiece; ++i) {
      const PieceValues weighted = weights.piece[law] * by[i];
      for (int j = 0; j <= i; ++j) sum[i][j] += weighted * by[j];
    }
  }
  sum[kDu][kDu] += bend_uu_;
  sum[kDz][kDu] += bend_uz_;
  sum[kDz][kDz] += bend_zz_;
  const PieceValues quarter = 0.25 * sum[kMid][kMid];
  const PieceValues uu_0 = quarter - sum[kDu][kDu];
  // Steps are differences of two places, the middle their mean.
  const auto add_row = [&](int i, int piece, const std::array<double, 5>& by_places) {
    for (int j = 0; j < 3; ++j) hessian.add(i, 3 * piece + j, by_places[j + 2]);
    if (piece == 0) return;
    for (int j = 0; j < 2; ++j) hessian.add(i, 3 * piece - 3 + j, by_places[j]);
  };
  for (int k = 0; k < kRunPieces; ++k) {
    const int u = 3 * k, z = u + 1, tau = u + 2;
    const double z_u = sum[kDz][kDu][k] + 0.5 * sum[kMid][kDz][k];
    const double z_u_0 = 0.5 * sum[kMid][kDz][k] - sum[kDz][kDu][k];
    const double zz = sum[kDz][kDz][k];
    add_row(u, k,
            {uu_0[k], -z_u, sum[kDu][kDu][k] + sum[kMid][kDu][k] + quarter[k], 0, 0});
    add_row(z, k, {z_u_0, -zz, z_u, zz, 0.0});
    for (const int row : {kTau, kViolated}) {
      const double by_du = sum[row][kDu][k];
      const double by_mid = 0.5 * sum[row][kMid][k];
      const double by_dz = sum[row][kDz][k];
      const double by_tau = sum[row][kTau][k];
      add_row(row == kTau ? tau : RunIndex::kV, k,
              {by_mid - by_du, -by_dz, by_mid + by_du, by_dz, by_tau});
    }
    hessian.add(RunIndex::kV, RunIndex::kV, sum[kViolated][kViolated][k]);
    if (k == 0) continue;
    hessian.add(u - 3, u - 3, sum[kDu][kDu][k] - sum[kMid][kDu][k] + quarter[k]);
    hessian.add(z - 3, u - 3, -z_u_0);
    hessian.add(z - 3, z - 3, zz);
  }
}

void RunSlopes::add_squares_of_end(const End& weights, RunHessian& hessian) const {
  Eigen::Matrix<double, kOfEnd, kOfEnd> sum = bend_of_end_;
  for (int i = 0; i < kOfEnd; ++i) {
    const End weighted = weights * by_end_.col(i).array();
    for (int j = 0; j <= i; ++j) {
      sum(i, j) += weighted.matrix().dot(by_end_.col(j));
    }
  }
  for (int i = 0; i < kOfEnd; ++i) {
    for (int j = 0; j <= i; ++j) {
      // Those that no law has together lie outside the band.
      if (sum(i, j) == 0.0) continue;
      hessian.add(RunIndex::kLastU + i, RunIndex::kLastU + j, sum(i, j));
    }
  }
}

RunNumbers RunSlopes::along(const RunVector& dx) const {
  RunNumbers change;
  const PieceValues u = variable(dx, 0), z = variable(dx, 1), tau = variable(dx, 2);
  const PieceValues u_0 = before(u);
  const PieceValues du = u - u_0, dz = z - before(z), mid = 0.5 * (u + u_0);
  for (int law = 0; law < RunNumbers::kLaws; ++law) {
    const PieceSlopes& by = by_[law];
    change.piece[law] = by[kDu] * du + by[kDz] * dz + by[kMid] * mid + by[kTau] * tau +
                        by[kViolated] * dx[RunIndex::kV];
  }
  change.end = (by_end_ * dx.tail<kOfEnd>()).array();
  return change;
}

void RunSlopes::add_slopes(const RunNumbers& weights, RunVector& sum) const {
  PieceSlopes total;
  for (PieceValues& slope : total) slope.setZero();
  for (int law = 0; law < RunNumbers::kLaws; ++law) {
    for (int i = 0; i < kOfPiece; ++i) total[i] += weights.piece[law] * by_[law][i];
  }
  for (int k = 0; k < kRunPieces; ++k) {
    const double half = 0.5 * total[kMid][k];
    sum[3 * k] += total[kDu][k] + half;
    sum[3 * k + 1] += total[kDz][k];
    sum[3 * k + 2] += total[kTau][k];
    if (k == 0) continue;
    sum[3 * k - 3] += half - total[kDu][k];
    sum[3 * k - 2] -= total[kDz][k];
  }
  sum[RunIndex::kV] += total[kViolated].sum();
  sum.tail<kOfEnd>() += by_end_.transpose() * weights.end.matrix();
}

RunMultipliers multipliers_of(const RunNumbers& numbers) {
  RunMultipliers y;
  for (int e = 0; e < 2; ++e) {
    for (int k = 0; k < kRunPieces; ++k) {
      y.piece[k].edge[e] = numbers.piece[edge(e)][k];
      y.piece[k].turn[e] = numbers.piece[turn(e)][k];
      y.piece[k].border[e] = numbers.piece[border(e)][k];
      for (int set = 0; set < RunLaw::kSets; ++set) {
        y.piece[k].end[set][e] = numbers.piece[end(set, e)][k];
      }
    }
    PieceMultipliers& rest = y.piece[kRunPieces];
    rest.edge[e] = numbers.end[end_edge(e)];
    for (int set = 0; set < RunLaw::kSets; ++set) {
      rest.end[set][e] = numbers.end[end_end(set, e)];
    }
    y.goal_z[e] = numbers.end[goal_z(e)];
    for (int k = 0; k < kGoalDirections; ++k) y.goal[e][k] = numbers.end[goal(e, k)];
  }
  return y;
}

}  // namespace prehensile
