#include "mechanics/spatial_newton.h"

#include <algorithm>

namespace prehensile {
namespace {

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
void add_stiffness(const ScaledPatch& patch, const PatchSums& sums,
                   RateMatrix& jacobian) {
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

/// Patches of a scaled problem, with their force centres.
class PatchContacts {
 public:
  PatchContacts(const ScaledSpatial& problem, const NewtonStart& start,
                SpatialForces& forces)
      : problem_(problem), force_(forces), pads_only_(start.pads_only) {
    for (int j = 0; j < problem_.padded; ++j) {
      centre_.n[j] = start.forces != nullptr ? start.forces->n[j] : problem_.preload[j];
      centre_.t[j] = start.forces != nullptr ? start.forces->t[j] : 0.0;
      centre_.o[j] = start.forces != nullptr ? start.forces->o[j] : 0.0;
      centre_.s[j] = start.forces != nullptr ? start.forces->s[j] : 0.0;
      force_.s[j] = 0.0;
    }
    close_padding();
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
  }

  double distance_from_laws(const SpatialRates& v) const {
    double worst = 0.0;
    for (int k = 0; k < problem_.patch_count; ++k) {
      const ScaledPatch& patch = problem_.patch[k];
      if (is_left_out(patch)) continue;
      const LocalRates y = patch.relative_rates(v);
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

  void add_forces(const SpatialRates& v, double r, SpatialRates& balance,
                  RateMatrix& jacobian) {
    for (int k = 0; k < problem_.patch_count; ++k) {
      const ScaledPatch& patch = problem_.patch[k];
      if (is_left_out(patch)) continue;
      const LocalRates y = patch.relative_rates(v);
      const PatchSums sums = project(patch, y, r);
      subtract_wrench(patch, sums.wrench, balance);
      add_stiffness(patch, sums, jacobian);
    }
  }

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

  PatchSums project(const ScaledPatch& patch, const LocalRates& y, double r) {
    using spatial_kernels::project;
    if (patch.soft) {
      return patch.given ? project<true, true>(problem_, patch, y, centre_, r, force_)
                         : project<true, false>(problem_, patch, y, centre_, r, force_);
    }
    return patch.given ? project<false, true>(problem_, patch, y, centre_, r, force_)
                       : project<false, false>(problem_, patch, y, centre_, r, force_);
  }

  SpatialForces centre_;
  const ScaledSpatial& problem_;
  SpatialForces& force_;
  bool pads_only_;
};

}  // namespace

NewtonResult run_newton(const ScaledSpatial& problem, const NewtonStart& start,
                        double tolerance, int max_steps, SpatialForces& forces,
                        int& steps) noexcept {
  PatchContacts contacts(problem, start, forces);
  const RateBalance balance{problem.M, problem.f, problem.freedoms, problem.has_inertia};
  const ProximalStart from{start.v, start.r, start.e, start.pace, start.added_mass};
  return ProximalIteration(balance, contacts).run(from, tolerance, max_steps, steps);
}

}  // namespace prehensile
