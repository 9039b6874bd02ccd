#include "benchmarks/converged.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace prehensile::benchmarks {
namespace {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Vec3L = Eigen::Matrix<Real, 3, 1>;
using Mat3L = Eigen::Matrix<Real, 3, 3>;
using Row3 = Eigen::Matrix<Real, 3, Eigen::Dynamic>;
using Eigen::Index;

constexpr Real kConverged = 1e-16L;
constexpr int kSteps = 60;

/// One point: its rates are rows * x + known, along (n, t, o), in units.
struct PointLaw {
  Row3 rows;
  Vec3L known;
  Real mu;
  Real compliance;
  Real preload;
};

/// Unknowns: six rates of the object about the origin, the jaws' rates, three forces per
/// point, all in units.
struct Laws {
  Index freedoms = 0;
  Matrix inertia;
  Vector load;
  std::vector<PointLaw> point;

  Index size() const { return freedoms + 3 * static_cast<Index>(point.size()); }
};

Vec3L widened(const Vec3& v) { return v.cast<Real>(); }

Laws laws_of(const SpatialProblem& q, const SpatialScales& units) {
  const JawFreedoms jaws = jaw_freedoms(q);
  const Real length = units.length;
  const Real force = units.force;
  const Real rate = units.rate;
  Laws laws;
  laws.freedoms = 6 + jaws.count;
  laws.inertia = Matrix::Zero(laws.freedoms, laws.freedoms);
  laws.load = Vector::Zero(laws.freedoms);
  // Turns are measured by the rate of a point one unit of length away.
  const auto lever = [length](Index i) { return i < 3 ? 1.0L : length; };
  for (Index i = 0; i < 6; ++i) {
    laws.load[i] = static_cast<Real>(q.w_g[i]) / (force * lever(i));
    for (Index k = 0; k < 6; ++k) {
      laws.inertia(i, k) =
          static_cast<Real>(q.inertia(i, k)) * rate / (force * lever(i) * lever(k));
    }
  }
  for (int i = 0; i < jaws.count; ++i) {
    laws.load[6 + i] = jaws.effort[i] / force;
    for (int k = 0; k < jaws.count; ++k) {
      const Real share = static_cast<Real>(jaws.jaw1[i]) * jaws.jaw1[k] +
                         static_cast<Real>(jaws.jaw2[i]) * jaws.jaw2[k];
      laws.inertia(6 + i, 6 + k) = q.jaw_mass * share * rate / force;
    }
  }
  for (int k = 0; k < q.patch_count; ++k) {
    const ContactPatch& patch = q.patch[k];
    const bool pusher = patch.body == ContactBody::kPusher;
    const bool founded = patch.pressure == PressureLaw::kFoundation;
    const auto& jaw = patch.body == ContactBody::kJaw1 ? jaws.jaw1 : jaws.jaw2;
    Mat3L frame;
    frame << widened(patch.n).transpose(), widened(patch.t).transpose(),
        widened(patch.n).cross(widened(patch.t)).transpose();
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const Vec3L p = widened(q.p_HC(i)) / length;
      PointLaw law{Row3::Zero(3, laws.freedoms), Vec3L::Zero(), patch.mu,
                   founded ? static_cast<Real>(patch.compliance) * force / rate : 0.0L,
                   founded ? static_cast<Real>(q.preload[i]) / force : 0.0L};
      law.rows.leftCols(3) = frame;
      for (Index axis = 0; axis < 3; ++axis) {
        law.rows.col(3 + axis) = frame * Vec3L::Unit(axis).cross(p);
      }
      for (int j = 0; j < jaws.count && !pusher; ++j) law.rows(0, 6 + j) = -jaw[j];
      if (pusher) {
        const Vec3L v = widened(q.V_HP.head<3>()) +
                        widened(q.V_HP.tail<3>()).cross(widened(q.p_HC(i)));
        law.known = -(frame * v) / rate;
      }
      laws.point.push_back(law);
    }
  }
  return laws;
}

/// Projection on the cone and its derivative.
Vec3L projected(const Vec3L& y, Real mu, Mat3L& slope) {
  const Eigen::Matrix<Real, 2, 1> tangent = y.tail<2>();
  const Real t = tangent.norm();
  slope.setIdentity();
  if (t <= mu * y[0]) return y;
  slope.setZero();
  if (mu * t <= -y[0]) return Vec3L::Zero();
  const Real share = 1.0L / (1.0L + mu * mu);
  const Real n = share * (y[0] + mu * t);
  const Eigen::Matrix<Real, 2, 1> along = tangent / t;
  slope(0, 0) = share;
  slope.bottomLeftCorner<2, 1>() = share * mu * along;
  slope.topRightCorner<1, 2>() = share * mu * along.transpose();
  slope.bottomRightCorner<2, 2>() =
      share * mu * mu * along * along.transpose() +
      mu * n / t * (Eigen::Matrix<Real, 2, 2>::Identity() - along * along.transpose());
  Vec3L on_cone;
  on_cone << n, mu * n * along;
  return on_cone;
}

/// Residual at x; its Jacobian too, where wanted.
Vector residual_at(const Laws& laws, const Vector& x, Matrix* jacobian) {
  const Index n = laws.freedoms;
  Vector residual = Vector::Zero(laws.size());
  residual.head(n) = laws.load - laws.inertia * x.head(n);
  if (jacobian) {
    jacobian->setZero(laws.size(), laws.size());
    jacobian->topLeftCorner(n, n) = -laws.inertia;
  }
  Index at = n;
  for (const PointLaw& law : laws.point) {
    const Vec3L f = x.segment<3>(at);
    Vec3L c = law.rows * x.head(n) + law.known;
    c[0] += law.compliance * (f[0] - law.preload);
    const Real slip = c.tail<2>().norm();
    Mat3L bent = Mat3L::Identity();  // of c + mu |c_t| n by c
    if (slip > 0.0L)
      bent.topRightCorner<1, 2>() = law.mu / slip * c.tail<2>().transpose();
    c[0] += law.mu * slip;
    Mat3L slope;
    residual.segment<3>(at) = f - projected(f - c, law.mu, slope);
    residual.head(n) += law.rows.transpose() * f;
    if (jacobian) {
      Mat3L by_force = Mat3L::Zero();
      by_force(0, 0) = law.compliance;
      jacobian->block(0, at, n, 3) = law.rows.transpose();
      jacobian->block(at, 0, 3, n) = slope * bent * law.rows;
      jacobian->block<3, 3>(at, at) =
          Mat3L::Identity() - slope * (Mat3L::Identity() - bent * by_force);
    }
    at += 3;
  }
  return residual;
}

}  // namespace

ConvergedAnswer converged_from(const SpatialProblem& problem, const SpatialScales& units,
                               const SpatialAnswer& start) {
  ConvergedAnswer converged;
  converged.residual = std::numeric_limits<double>::quiet_NaN();
  if (!start.given) return converged;
  const Laws laws = laws_of(problem, units);
  Vector x = Vector::Zero(laws.size());
  for (Index i = 0; i < 6; ++i) {
    x[i] = start.V_HO[i] * (i < 3 ? 1.0 : units.length) / units.rate;
  }
  for (Index i = 6; i < laws.freedoms; ++i) {
    x[i] = start.jaw_rate[static_cast<std::size_t>(i - 6)] / units.rate;
  }
  for (std::size_t i = 0; i < laws.point.size(); ++i) {
    x.segment<3>(laws.freedoms + 3 * static_cast<Index>(i)) =
        widened(start.force[i]) / static_cast<Real>(units.force);
  }
  Matrix jacobian;
  Vector residual = residual_at(laws, x, &jacobian);
  for (int step = 0; step < kSteps && residual.lpNorm<Eigen::Infinity>() > kConverged;
       ++step) {
    x -= jacobian.fullPivLu().solve(residual);
    residual = residual_at(laws, x, &jacobian);
  }
  converged.residual = static_cast<double>(residual.lpNorm<Eigen::Infinity>());
  if (!(converged.residual <= static_cast<double>(kConverged))) return converged;
  converged.least_gain = Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian.cast<double>())
                             .singularValues()
                             .tail<1>()[0];
  converged.answer = start;
  for (Index i = 0; i < 6; ++i) {
    converged.answer.V_HO[i] =
        static_cast<double>(x[i]) * units.rate / (i < 3 ? 1.0 : units.length);
  }
  for (Index i = 6; i < laws.freedoms; ++i) {
    converged.answer.jaw_rate[static_cast<std::size_t>(i - 6)] =
        static_cast<double>(x[i]) * units.rate;
  }
  for (std::size_t i = 0; i < laws.point.size(); ++i) {
    converged.answer.force[i] =
        units.force *
        x.segment<3>(laws.freedoms + 3 * static_cast<Index>(i)).cast<double>();
  }
  return converged;
}

}  // namespace prehensile::benchmarks
