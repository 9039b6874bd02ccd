/// Whether the pads alone hold gravity by more than a given slack. Part of the
/// certificate: shares no code with the solvers.
///
/// The load of gravity is the least sum |a| of shares with which frictions of the pads
/// make it up, w_g = sum a_i v_i: the gauge of their friction body, which is symmetric. A
/// twist n tells which friction v lowers the sum most, and is itself a bound from below,
/// w_g.n / D(n): column generation with three columns. Both bounds close in on the load
/// in a few sums over the pads unless it is nearly 1.
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "mechanics/certificate.h"
#include "mechanics/certificate_evidence.h"

namespace prehensile {
namespace {

constexpr int kExchanges = 24;

class GravityLoad {
 public:
  GravityLoad(const PlanarGrasp& grasp, const CertificateUnits& units)
      : grasp_(grasp), units_(units), w_g_(units.scaled_wrench(grasp.w_g)) {}

  /// Whether D(u) - w_g.u exceeds this over all unit twists u, or neither bound says.
  std::optional<bool> exceeds(double least) {
    for (int k = 0; k < 3; ++k) frictions_.col(k) = friction(Vec3::Unit(k));
    for (int i = 0; i < kExchanges; ++i) {
      Eigen::Matrix3d inverse;
      bool independent = false;
      frictions_.computeInverseWithCheck(inverse, independent);
      if (!independent) return std::nullopt;
      Vec3 share = inverse * w_g_;
      for (int k = 0; k < 3; ++k) {
        if (share[k] >= 0.0) continue;
        share[k] = -share[k];
        frictions_.col(k) *= -1.0;
        inverse.row(k) *= -1.0;
      }
      // What the shares miss, and a ball of radius `least` about gravity, is made up as
      // well: a unit wrench needs shares of at most this sum.
      const double of_unit = std::sqrt(3.0) * inverse.norm();
      const double missed = (w_g_ - frictions_ * share).norm();
      if (share.sum() + (missed + std::max(0.0, least)) * of_unit < 1.0) return true;
      const Vec3 n = inverse.transpose() * Vec3::Ones();
      const Vec3 v = friction(n);
      if (v.dot(n) - w_g_.dot(n) <= least * n.norm()) return false;
      if (!exchange(share, inverse * v, v)) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  /// The friction of pads with this twist: a point at rest may have none.
  Vec3 friction(const Vec3& u) const {
    Vec3 sum = Vec3::Zero();
    for (int j = 0; j < grasp_.count; ++j) {
      const double x = (grasp_.x[j] - units_.centre.x()) / units_.length;
      const double y = (grasp_.y[j] - units_.centre.y()) / units_.length;
      const double cx = u[0] - u[2] * y;
      const double cy = u[1] + u[2] * x;
      const double square = cx * cx + cy * cy;
      if (!(square > 0.0)) continue;
      const double per_rate = grasp_.bound[j] / std::sqrt(square);
      sum += per_rate * Vec3(cx, cy, x * cy - y * cx);
    }
    return sum / units_.force;
  }

  /// Takes `v` for the friction whose share is used up first; false if none is.
  bool exchange(const Vec3& share, const Vec3& of_v, const Vec3& v) {
    int out = -1;
    double first = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (!(of_v[k] > 0.0)) continue;
      const double at = share[k] / of_v[k];
      if (out >= 0 && !(at < first)) continue;
      out = k;
      first = at;
    }
    if (out < 0) return false;
    frictions_.col(out) = v;
    return true;
  }

  const PlanarGrasp& grasp_;
  const CertificateUnits& units_;
  Vec3 w_g_;
  Eigen::Matrix3d frictions_;
};

}  // namespace

bool gravity_slack_exceeds(const PlanarGrasp& grasp, double least) noexcept {
  const CertificateUnits units = pad_units(grasp);
  if (!units.sane) return false;
  const auto known = GravityLoad(grasp, units).exceeds(least);
  return known ? *known : gravity_slack(grasp) > least;
}

}  // namespace prehensile
