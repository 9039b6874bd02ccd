#include "mechanics/spatial_newton.h"

#include <algorithm>

namespace prehensile {
namespace {

constexpr int kStepsPerCentre = 25;
constexpr int kHalvings = 12;
constexpr double kLeastProx = 1e-7;
constexpr double kRunsAway = 1e7;  ///< rates that only a falling object reaches

using Matrix8 = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;

/// Solves the leading n x n system in place by elimination with row exchange; false where
/// it is singular. Whole rows are combined, so that they may go in lanes.
bool solve_small(Matrix8& A, SpatialRates& x, int n) {
  for (int k = 0; k < n; ++k) {
    int best = k;
    double size = std::abs(A(k, k));
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(A(i, k)) > size) {
        best = i;
        size = std::abs(A(i, k));
      }
    }
    if (!(size > 0.0)) return false;
    if (best != k) {
      A.row(k).swap(A.row(best));
      std::swap(x[k], x[best]);
    }
    const double per_pivot = 1.0 / A(k, k);
    for (int i = k + 1; i < n; ++i) {
      const double factor = A(i, k) * per_pivot;
      if (factor == 0.0) continue;
      A.row(i) -= factor * A.row(k);
      x[i] -= factor * x[k];
    }
    A(k, k) = per_pivot;
  }
  for (int k = n - 1; k >= 0; --k) {
    double rest = x[k];
    for (int j = k + 1; j < n; ++j) rest -= A(k, j) * x[j];
    x[k] = rest * A(k, k);
  }
  return x.allFinite();
}

/// Adds a patch's wrench to the balance, with its sign turned, and to the jaws.
void subtract_wrench(const ScaledPatch& patch, const LocalRates& w,
                     SpatialRates& balance) {
  const double h = patch.height;
  balance.head<3>() -= patch.Q * Vec3(w[0], w[3], w[4]);
  balance.segment<3>(3) -= patch.Q * Vec3(w[5], w[1] - h * w[4], w[2] + h * w[3]);
  balance[6] += patch.closing[0] * w[0];
  balance[7] += patch.closing[1] * w[0];
}

/// Turns a patch's stiffness into H. In the axes of the patch, the local rates are linear
/// in the object's (u | w) about the centre: only v_t = u_t + h w_o and v_o = u_o - h w_t
/// mix, which leaves few products.
void add_stiffness(const ScaledPatch& patch, const PatchSums& sums, Matrix8& jacobian) {
  const auto& N = sums.K_nn;
  const auto& C = sums.K_tn;
  const auto& T = sums.K_tt;
  const double h = patch.height;
  // Rows and columns in the order (n, t, o).
  Eigen::Matrix3d uu, uw, wu, ww;
  uu(0, 0) = N[0];
  uu(0, 1) = uu(0, 2) = 0.0;
  uu(1, 0) = C[0];
  uu(1, 1) = T[0];
  uu(1, 2) = T[1];
  uu(2, 0) = C[3];
  uu(2, 1) = T[1];
  uu(2, 2) = T[3];
  uw(0, 0) = 0.0;
  uw(0, 1) = N[1];
  uw(0, 2) = N[2];
  uw(1, 0) = T[2];
  uw(1, 1) = C[1] - h * T[1];
  uw(1, 2) = C[2] + h * T[0];
  uw(2, 0) = T[4];
  uw(2, 1) = C[4] - h * T[3];
  uw(2, 2) = C[5] + h * T[1];
  wu(0, 0) = C[6];
  wu(0, 1) = T[2];
  wu(0, 2) = T[4];
  wu(1, 0) = N[1] - h * C[3];
  wu(1, 1) = -h * T[1];
  wu(1, 2) = -h * T[3];
  wu(2, 0) = N[2] + h * C[0];
  wu(2, 1) = h * T[0];
  wu(2, 2) = h * T[1];
  ww(0, 0) = T[5];
  ww(0, 1) = C[7] - h * T[4];
  ww(0, 2) = C[8] + h * T[2];
  ww(1, 0) = -h * T[4];
  ww(1, 1) = N[3] - h * uw(2, 1);
  ww(1, 2) = N[4] - h * uw(2, 2);
  ww(2, 0) = h * T[2];
  ww(2, 1) = N[4] + h * uw(1, 1);
  ww(2, 2) = N[5] + h * uw(1, 2);
  const Eigen::Matrix3d& Q = patch.Q;
  const Eigen::Matrix3d Qt = Q.transpose();
  jacobian.topLeftCorner<3, 3>() += (Q * uu) * Qt;
  jacobian.block<3, 3>(0, 3) += (Q * uw) * Qt;
  jacobian.block<3, 3>(3, 0) += (Q * wu) * Qt;
  jacobian.block<3, 3>(3, 3) += (Q * ww) * Qt;
  if (patch.body == ContactBody::kPusher) return;
  const Vec3 force = Q * uu.col(0);
  const Vec3 moment = Q * wu.col(0);
  const Vec3 by_turn = Q * Vec3(0.0, N[1], N[2]);
  for (int i = 0; i < 2; ++i) {
    const double a = patch.closing[i];
    if (a == 0.0) continue;
    for (int row = 0; row < 3; ++row) {
      jacobian(row, 6 + i) -= a * force[row];
      jacobian(3 + row, 6 + i) -= a * moment[row];
      jacobian(6 + i, row) -= a * N[0] * Q(row, 0);
      jacobian(6 + i, 3 + row) -= a * by_turn[row];
    }
    for (int j = 0; j < 2; ++j) jacobian(6 + i, 6 + j) += a * patch.closing[j] * N[0];
  }
}

class Iteration {
 public:
  Iteration(const ScaledSpatial& problem, SpatialForces& forces)
      : problem_(problem), force_(forces) {}

  void start_at(const NewtonStart& start) {
    pads_only_ = start.pads_only;
    added_mass_ = start.added_mass;
    v_ = before_ = start.v;
    for (int j = 0; j < problem_.padded; ++j) {
      centre_.n[j] = start.forces != nullptr ? start.forces->n[j] : problem_.preload[j];
      centre_.t[j] = start.forces != nullptr ? start.forces->t[j] : 0.0;
      centre_.o[j] = start.forces != nullptr ? start.forces->o[j] : 0.0;
      centre_.s[j] = start.forces != nullptr ? start.forces->s[j] : 0.0;
      force_.s[j] = 0.0;
    }
    close_padding();
  }

  void set_prox(double r, double e) {
    r_ = r;
    e_ = e;
    evaluate(v_);
  }

  /// Newton's method for the present force centres.
  bool settle(double tolerance, int& steps, int max_steps) {
    const int n = problem_.freedoms;
    for (int step = 0; step < kStepsPerCentre && steps < max_steps; ++step, ++steps) {
      if (balance_.norm() <= tolerance) return true;
      SpatialRates stride = -balance_;
      if (!solve_small(jacobian_, stride, n)) return false;
      if (!line_search(stride)) return balance_.norm() <= 10.0 * tolerance;
    }
    return balance_.norm() <= tolerance;
  }

  void move_centres() {
    const auto copy = [this](const ScaledSpatial::Column& from,
                             ScaledSpatial::Column& to) {
      std::copy_n(from.begin(), problem_.padded, to.begin());
    };
    copy(force_.n, centre_.n);
    copy(force_.t, centre_.t);
    copy(force_.o, centre_.o);
    copy(force_.s, centre_.s);
    close_padding();
    before_ = v_;
  }

  double natural_map() const {
    double worst = (balance_ - e_ * (v_ - before_)).norm();
    for (int k = 0; k < problem_.patch_count; ++k) {
      const ScaledPatch& patch = problem_.patch[k];
      if (is_left_out(patch)) continue;
      const LocalRates y = patch.relative_rates(v_);
      worst = std::max(worst,
                       spatial_kernels::distance_from_laws(problem_, patch, y, force_));
    }
    return worst;
  }

  double largest_force() const {
    double most = 0.0;
    for (int k = 0; k < problem_.patch_count; ++k) {
      const ScaledPatch& patch = problem_.patch[k];
      if (is_left_out(patch)) continue;
      for (int j = 0; j < patch.count; ++j) {
        most = std::max(most, force_.n[patch.first + j]);
      }
    }
    return most;
  }

  const SpatialRates& v() const { return v_; }

 private:
  bool is_left_out(const ScaledPatch& patch) const {
    return pads_only_ && patch.body == ContactBody::kPusher;
  }

  /// Padding never touches.
  void close_padding() {
    for (int k = 0; k < problem_.patch_count; ++k) {
      const ScaledPatch& patch = problem_.patch[k];
      for (int j = patch.count; j < patch.padded; ++j) centre_.n[patch.first + j] = -1e30;
    }
  }

  PatchSums project(const ScaledPatch& patch, const LocalRates& y) {
    using spatial_kernels::project;
    if (patch.soft) {
      return patch.given ? project<true, true>(problem_, patch, y, centre_, r_, force_)
                         : project<true, false>(problem_, patch, y, centre_, r_, force_);
    }
    return patch.given ? project<false, true>(problem_, patch, y, centre_, r_, force_)
                       : project<false, false>(problem_, patch, y, centre_, r_, force_);
  }

  void evaluate(const SpatialRates& v) {
    balance_ = e_ * (v - before_) - problem_.f;
    jacobian_.setZero();
    jacobian_.diagonal().setConstant(e_ + added_mass_);
    if (added_mass_ > 0.0) balance_ += added_mass_ * v;
    if (problem_.has_inertia) {
      balance_ += problem_.M * v;
      jacobian_ += problem_.M;
    }
    for (int k = 0; k < problem_.patch_count; ++k) {
      const ScaledPatch& patch = problem_.patch[k];
      if (is_left_out(patch)) continue;
      const LocalRates y = patch.relative_rates(v);
      const PatchSums sums = project(patch, y);
      subtract_wrench(patch, sums.wrench, balance_);
      add_stiffness(patch, sums, jacobian_);
    }
    for (int i = problem_.freedoms; i < 8; ++i) balance_[i] = 0.0;
  }

  bool line_search(const SpatialRates& stride) {
    const SpatialRates from = v_;
    const double before = balance_.norm();
    double share = 1.0;
    for (int halving = 0; halving < kHalvings; ++halving, share *= 0.5) {
      const SpatialRates there = from + share * stride;
      evaluate(there);
      if (balance_.norm() <= (1.0 - 1e-4 * share) * before) {
        v_ = there;
        return true;
      }
    }
    evaluate(from);
    return false;
  }

  SpatialForces centre_;
  Matrix8 jacobian_ = Matrix8::Zero();
  SpatialRates v_ = SpatialRates::Zero();
  SpatialRates before_ = SpatialRates::Zero();
  SpatialRates balance_ = SpatialRates::Zero();
  const ScaledSpatial& problem_;
  SpatialForces& force_;
  double r_ = 1.0;
  double e_ = 0.0;
  double added_mass_ = 0.0;
  bool pads_only_ = false;
};

}  // namespace

NewtonResult run_newton(const ScaledSpatial& problem, const NewtonStart& start,
                        double tolerance, int max_steps, SpatialForces& forces,
                        int& steps) noexcept {
  Iteration iteration(problem, forces);
  iteration.start_at(start);
  double r = start.r * start.pace;
  double e = start.e;
  NewtonResult result;
  const bool has_mass = problem.has_inertia || start.added_mass > 0.0;
  double residual = std::numeric_limits<double>::infinity();
  while (true) {
    iteration.set_prox(r, e);
    const double wanted =
        std::max(0.1 * tolerance, std::min(1e-2, 0.1 * residual * residual));
    const bool settled = iteration.settle(wanted, steps, max_steps);
    const double now = iteration.natural_map();
    if (std::isfinite(now)) residual = now;
    if (residual <= tolerance || steps >= max_steps) break;
    if (!has_mass && !(iteration.v().norm() < kRunsAway)) {
      result.runs_away = true;
      break;
    }
    if (settled) {
      iteration.move_centres();
      r = std::max(kLeastProx * start.pace, 0.3 * r);
      e *= 0.2;
    } else {
      e = std::max(10.0 * e, 0.1 / start.pace);
      r = std::min(3.0 * start.pace, 2.0 * r);
    }
    ++steps;
  }
  result.v = iteration.v();
  result.residual = residual;
  result.largest_force = iteration.largest_force();
  result.converged = residual <= tolerance;
  return result;
}

}  // namespace prehensile
