/// How firmly the pads alone hold gravity. Part of the certificate: shares no code with
/// the solvers.
///
/// D(u) - w_g.u over unit twists u is the gap between gravity and the supporting plane of
/// the friction body with normal u: its least value is the distance of gravity from the
/// boundary (negative outside). Outside, the problem is convex in the cone of twists
/// where it is negative. Inside it is not, but its minima are of two kinds: turning about
/// a pad point (flat parts of the boundary, all of them tried), and smooth ones, found by
/// descent from the best of many starts.
#include <algorithm>

#include <Eigen/Eigenvalues>

#include "mechanics/certificate.h"
#include "mechanics/certificate_evidence.h"

namespace prehensile {
namespace {

constexpr int kDescents = 4;
constexpr int kSpread = 48;
constexpr int kDescentSteps = 60;

/// Over the friction force: gravity that changes no slack by a digit counts as none. Its
/// square may be no number any more.
constexpr double kNoGravity = 1e-30;

/// D and its derivatives at a twist, in certificate units.
struct Dissipated {
  double power = 0.0;
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

class SlackSearch {
 public:
  SlackSearch(const PlanarGrasp& grasp, const CertificateUnits& units)
      : grasp_(grasp), units_(units), w_g_(units.scaled_wrench(grasp.w_g)) {
    if (w_g_.norm() < kNoGravity) w_g_.setZero();
  }

  Vec3 least(double* slack) {
    // Even spread over half the sphere (golden angle).
    for (int k = 0; k < kSpread; ++k) {
      const double z = (k + 0.5) / kSpread;
      const double r = std::sqrt(1.0 - z * z);
      try_both(
          {r * std::cos(2.399963229728653 * k), r * std::sin(2.399963229728653 * k), z});
    }
    if (!w_g_.isZero(0.0)) try_both(w_g_.normalized());
    for (int j = 0; j < grasp_.count; ++j) {
      const Vec2 r = lever(j);
      try_both(Vec3(r.y(), -r.x(), 1.0).normalized());
    }
    const std::array<Start, kDescents> starts = best_;
    for (const Start& start : starts) {
      if (!std::isfinite(start.slack)) continue;
      descend(start.u, false);
      // The ratio D / (w.u) has one valley: no grasp that fails is taken for one that
      // holds.
      if (w_g_.dot(start.u) > 0.0) descend(start.u, true);
    }
    *slack = best_[0].slack;
    return best_[0].u;
  }

 private:
  struct Start {
    double slack = std::numeric_limits<double>::infinity();
    Vec3 u = Vec3::UnitX();
  };

  Vec2 lever(int j) const {
    return (Vec2(grasp_.x[j], grasp_.y[j]) - units_.centre) / units_.length;
  }

  Dissipated dissipated(const Vec3& u) const {
    Dissipated sum;
    for (int j = 0; j < grasp_.count; ++j) {
      const Vec2 r = lever(j);
      const Vec2 c(u[0] - u[2] * r.y(), u[1] + u[2] * r.x());
      const double rate = c.norm();
      if (rate <= 1e-15) continue;
      const double bound = grasp_.bound[j] / units_.force;
      const Vec3 along(c.x(), c.y(), r.x() * c.y() - r.y() * c.x());
      const Vec3 across(-c.y(), c.x(), r.x() * c.x() + r.y() * c.y());
      sum.power += bound * rate;
      sum.gradient += bound / rate * along;
      sum.hessian += bound / (rate * rate * rate) * (across * across.transpose());
    }
    return sum;
  }

  double power(const Vec3& u) const {
    double sum = 0.0;
    for (int j = 0; j < grasp_.count; ++j) {
      const Vec2 r = lever(j);
      const Vec2 c(u[0] - u[2] * r.y(), u[1] + u[2] * r.x());
      sum += grasp_.bound[j] / units_.force * c.norm();
    }
    return sum;
  }

  double slack_at(const Vec3& u) const { return power(u) - w_g_.dot(u); }

  void keep(const Vec3& u, double slack) {
    Start candidate{slack, u};
    for (Start& kept : best_) {
      if (candidate.slack < kept.slack) std::swap(candidate, kept);
    }
  }

  /// D is even, so of u and -u the one along gravity has less slack.
  void try_both(const Vec3& u) {
    const Vec3 along = w_g_.dot(u) < 0.0 ? Vec3(-u) : u;
    keep(along, slack_at(along));
  }

  /// Newton's method on the unit sphere, with the step bent downhill where the function
  /// is not convex; `ratio` minimises D/(w.u) instead.
  void descend(Vec3 u, bool ratio) {
    double value = merit(u, ratio);
    for (int step = 0; step < kDescentSteps; ++step) {
      const Dissipated at = dissipated(u);
      const double pull = w_g_.dot(u);
      const double load = ratio ? at.power / pull : 1.0;
      const Vec3 slope = at.gradient - load * w_g_;
      const double curve = ratio ? 0.0 : at.power - pull;
      const Vec3 stride = downhill(u, slope, at.hessian, curve);
      double share = 1.0;
      bool better = false;
      for (; share > 1e-6 && !better; share *= 0.5) {
        const Vec3 next = (u + share * stride).normalized();
        const double there = merit(next, ratio);
        better = there < value;
        if (better) {
          u = next;
          value = there;
        }
      }
      if (!better) break;
    }
    keep(u, slack_at(u));
  }

  double merit(const Vec3& u, bool ratio) const {
    if (!ratio) return slack_at(u);
    const double pull = w_g_.dot(u);
    return pull > 0.0 ? power(u) / pull : std::numeric_limits<double>::infinity();
  }

  static Vec3 downhill(const Vec3& u, const Vec3& slope, const Eigen::Matrix3d& hessian,
                       double curve) {
    const Eigen::Matrix3d tangent = Eigen::Matrix3d::Identity() - u * u.transpose();
    const Eigen::Matrix3d bent =
        tangent * hessian * tangent - curve * tangent + u * u.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes;
    modes.computeDirect(bent);
    Vec3 stride = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vec3 mode = modes.eigenvectors().col(k);
      const double stiffness = std::max(std::abs(modes.eigenvalues()[k]), 1e-9);
      stride -= mode.dot(tangent * slope) / stiffness * mode;
    }
    const double length = stride.norm();
    return length > 0.5 ? Vec3(0.5 / length * stride) : stride;
  }

  const PlanarGrasp& grasp_;
  const CertificateUnits& units_;
  Vec3 w_g_;
  std::array<Start, kDescents> best_;
};

}  // namespace

double gravity_slack(const PlanarGrasp& grasp, PlanarTwist* worst) noexcept {
  const CertificateUnits units = pad_units(grasp);
  if (!units.sane) return kNan;
  double slack = 0.0;
  const Vec3 u = SlackSearch(grasp, units).least(&slack);
  if (worst != nullptr) *worst = units.twist(u);
  return slack;
}

}  // namespace prehensile
