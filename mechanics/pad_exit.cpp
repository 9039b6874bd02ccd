/// Rays through the friction body of the pads: where they leave it, and whether gravity
/// lies inside.
#include "mechanics/pad_friction.h"

namespace prehensile {

using pad_kernels::curvature;
using pad_kernels::Curvature;
using pad_kernels::resisting_wrench;

namespace {

constexpr int kNewtonSteps = 80;
constexpr int kHalvings = 30;

/// Two unit vectors at right angles to the unit vector u and to each other (Duff et al.,
/// Building an orthonormal basis, revisited, 2017).
Eigen::Matrix<double, 3, 2> tangent_basis(const PlanarTwist& u) {
  const double sign = std::copysign(1.0, u[2]);
  const double a = -1.0 / (sign + u[2]);
  const double b = u[0] * u[1] * a;
  Eigen::Matrix<double, 3, 2> basis;
  basis << 1.0 + sign * u[0] * u[0] * a, b,  //
      sign * b, sign + u[1] * u[1] * a,      //
      -sign * u[0], -u[1];
  return basis;
}

/// The load factor lambda(u) = (D(u) - w.u)/(e.u) of a unit twist u, an upper bound on
/// the exit, with what a Newton step needs. Its lowest value over e.u > 0 is the exit.
struct LoadFactor {
  PlanarTwist u;
  double along;  ///< e.u
  double lambda;
  PlanarWrench gap;  ///< gradient D - w - lambda e: zero at the exit
  Eigen::Matrix3d hessian;

  LoadFactor(const PaddedColumns& pads, const PlanarWrench& w, const PlanarWrench& e,
             const PlanarTwist& unit)
      : u(unit), along(e.dot(unit)) {
    const Curvature here = curvature(pads, u);
    const PlanarWrench rest = here.gradient - w;
    lambda = rest.dot(u) / along;
    gap = rest - lambda * e;
    hessian = here.hessian;
  }
};

/// Newton's step for lambda on the plane at right angles to u; D has no curvature along
/// u itself. Kept at most 1 long.
PlanarTwist newton_step(const LoadFactor& here) {
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(here.u);
  const Vec2 slope = basis.transpose() * here.gap;
  const Eigen::Matrix<double, 3, 2> turned = here.hessian * basis;
  double xx = basis.col(0).dot(turned.col(0));
  const double xy = basis.col(0).dot(turned.col(1));
  double yy = basis.col(1).dot(turned.col(1));
  double det = xx * yy - xy * xy;
  const double trace = xx + yy;
  if (!(det > 1e-13 * trace * trace)) {
    const double lift = 1e-8 * trace + 1e-30;
    xx += lift;
    yy += lift;
    det = xx * yy - xy * xy;
  }
  Vec2 step((xy * slope.y() - yy * slope.x()) / det,
            (xy * slope.x() - xx * slope.y()) / det);
  const double length = step.norm();
  if (!std::isfinite(length)) step = -slope;
  if (length > 1.0) step /= length;
  return basis * step;
}

}  // namespace

PlanarTwist PadFriction::exit_guess(const PlanarWrench& w,
                                    const PlanarWrench& e) const noexcept {
  const PlanarTwist metric(1.0, 1.0, 1.0 / (torque_radius_ * torque_radius_));
  const double a = e.dot(metric.cwiseProduct(e));
  const double b = e.dot(metric.cwiseProduct(w));
  const double c = w.dot(metric.cwiseProduct(w)) - 1.0;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const PlanarWrench at = w + (root - b) / a * e;
  const PlanarTwist u = metric.cwiseProduct(at);
  return u.dot(e) > 0.0 ? u.normalized() : e.normalized();
}

/// At a pivot the exit needs one particular force of the pivot. Within its bound, the ray
/// leaves here; beyond it, the point gives way in the direction of that force, and
/// `beside` is the twist to which the bend of D at the other points lets it go.
PadFriction::PivotTest PadFriction::test_pivot(int j, const PlanarWrench& w,
                                               const PlanarWrench& e) const noexcept {
  PivotTest test;
  PlanarTwist u = rotation_about(j, 1.0);
  double along = e.dot(u);
  if (std::abs(along) <= 1e-14 * u.norm()) return test;
  if (along < 0.0) {
    u = -u;
    along = -along;
  }
  const Curvature rest = curvature(points(), u);
  const PlanarWrench resisted = rest.gradient - w;
  const double lambda = resisted.dot(u) / along;
  const Vec2 force = (lambda * e - resisted).head<2>();
  const double size = force.norm();
  const double bound = merged_bound(j);
  if (size <= bound * (1.0 + 1e-12)) {
    test.leaves = true;
    test.exit = {true, lambda, u, {j, force}};
    return test;
  }
  const Vec2 away = force / size;
  const double bend = away.dot(rest.hessian.topLeftCorner<2, 2>() * away);
  const double distance = std::min(1.0, (size - bound) / (bend + 1e-30));
  test.beside = u + distance * PlanarTwist(away.x(), away.y(), 0.0);
  test.has_beside = test.beside.dot(e) > 0.0;
  return test;
}

RayExit PadFriction::exit_of_point(const PlanarWrench& w,
                                   const PlanarWrench& e) const noexcept {
  if (std::abs(e[2]) > 1e-12) {
    const double lambda = -w[2] / e[2];
    const Vec2 f = (w + lambda * e).head<2>();
    if (f.norm() > 1.0) return {};
    return {true, lambda, rotation_about(0, std::copysign(1.0, e[2])), {0, f}};
  }
  if (std::abs(w[2]) > 1e-12) return {};
  const double a = e.head<2>().squaredNorm();
  const double b = e.head<2>().dot(w.head<2>());
  const double discriminant = b * b - a * (w.head<2>().squaredNorm() - 1.0);
  if (!(discriminant > 0.0)) return {};
  const double lambda = (std::sqrt(discriminant) - b) / a;
  const Vec2 f = (w + lambda * e).head<2>();
  return {true, lambda, {f.x(), f.y(), 0.0}, {}};
}

RayExit PadFriction::exit(const PlanarWrench& w, const PlanarWrench& direction,
                          const PlanarTwist* guess) const noexcept {
  // Unit direction, and the point of the line nearest to the centre of S: pads far from
  // the pusher would lose digits to large wrenches.
  const double size = direction.norm();
  const PlanarWrench e = direction / size;
  const double ahead = w.dot(e);
  const PlanarWrench foot = w - ahead * e;
  RayExit exit = is_point_ ? exit_of_point(foot, e) : exit_of_pads(foot, e, guess);
  exit.lambda = (exit.lambda - ahead) / size;
  return exit;
}

RayExit PadFriction::exit_of_pads(const PlanarWrench& w, const PlanarWrench& e,
                                  const PlanarTwist* guess) const noexcept {
  const bool use_guess = guess != nullptr && guess->dot(e) > 1e-6 * guess->norm();
  const PlanarTwist start = use_guess ? guess->normalized() : exit_guess(w, e);
  const double enough = 1e-15 * (1.0 + w.norm());
  const double rounding = 1e-14 * (1.0 + w.norm());
  // No exit lies further back than the far side of S.
  const double least = -(w.norm() + 1.0 + reach_);
  int tried = -1;
  // Pad points are tried as pivots once the search is near; a guess may be.
  int far = use_guess ? 0 : 2;
  LoadFactor here(points(), w, e, start);
  int step = 0;
  for (; step < kNewtonSteps; ++step) {
    if (here.gap.norm() <= enough) break;
    if (!(here.lambda >= least)) return {};
    if (const int nearest = step < far ? tried : nearest_to_centre(here.u);
        nearest != tried) {
      tried = nearest;
      const PivotTest test = test_pivot(nearest, w, e);
      if (test.leaves) {
        RayExit exit = test.exit;
        exit.steps = step;
        return exit;
      }
      if (test.has_beside) {
        const LoadFactor beside(points(), w, e, test.beside.normalized());
        if (beside.lambda < here.lambda) here = beside;
      }
    }
    const PlanarTwist stride = newton_step(here);
    const double slope = here.gap.dot(stride) / here.along;
    double share = 1.0;
    bool better = false;
    for (int halving = 0; halving < kHalvings && !better; ++halving, share *= 0.5) {
      const PlanarTwist u = (here.u + share * stride).normalized();
      if (!(e.dot(u) > 0.0)) continue;
      const LoadFactor next(points(), w, e, u);
      better = next.lambda <= here.lambda + 1e-4 * share * slope ||
               (next.lambda <= here.lambda + rounding &&
                next.gap.norm() < 0.5 * here.gap.norm());
      if (better) here = next;
    }
    if (!better) {
      if (step >= far) break;
      far = 0;
    }
  }
  const bool hit = here.gap.norm() <= 1e-9 * (1.0 + w.norm());
  return {hit, here.lambda, here.u, {}, step};
}

/// A force f at every point in proportion to its bound, and a turn of the points, are
/// admissible together for |f| + |moment| reach <= 1: a ball inside S. So if S contains
/// `support`, near a multiple of w beyond w itself, it contains w.
bool PadFriction::proves_held(const PlanarWrench& support,
                              const PlanarWrench& w) const noexcept {
  const double factor = support.dot(w) / w.squaredNorm();
  const PlanarWrench off = support - factor * w;
  return factor > 1.0 + off.head<2>().norm() + std::abs(off[2]) * reach_;
}

bool PadFriction::clearly_holds(const PlanarWrench& w) const noexcept {
  if (w.head<2>().norm() + std::abs(w[2]) * reach_ < 1.0) return true;
  const PlanarTwist u(w[0], w[1], w[2] / (torque_radius_ * torque_radius_));
  return proves_held(resisting_wrench(points(), u), w);
}

bool PadFriction::holds(const PlanarWrench& w, PlanarTwist* unsupported) const noexcept {
  if (is_point_) {
    if (std::abs(w[2]) <= 1e-12 && w.head<2>().norm() < 1.0) return true;
    *unsupported = std::abs(w[2]) > 1e-12
                       ? PlanarTwist(0.0, 0.0, std::copysign(1.0, w[2]))
                       : PlanarTwist(w[0], w[1], 0.0);
    return false;
  }
  if (clearly_holds(w)) return true;
  const RayExit limit = exit(PlanarWrench::Zero(), w, nullptr);
  if (limit.hit && limit.lambda > 1.0) return true;
  const bool has_twist = !limit.u.isZero(0.0);
  // Rounding between close points stops the search short of the limit; what it found
  // still bounds S.
  if (!limit.hit && has_twist && proves_held(resisting_wrench(points(), limit.u), w)) {
    return true;
  }
  *unsupported = has_twist ? limit.u : PlanarTwist(w.normalized());
  return false;
}

void PadFriction::moving_forces(const PlanarTwist& u, const PivotPoint& pivot,
                                Vec2* forces) const noexcept {
  const double pivot_bound = pivot.index < 0 ? 0.0 : merged_bound(pivot.index);
  for (int j = 0; j < count_; ++j) {
    const Vec2 c = point_velocity(u, at(j));
    const bool is_pivot = pivot.index >= 0 && at(j) == at(pivot.index);
    if (is_pivot) {
      forces[j] = b_[j] / pivot_bound * pivot.force;
    } else {
      const double rate = c.norm();
      forces[j] = rate > 0.0 ? Vec2(b_[j] / rate * c) : Vec2(Vec2::Zero());
    }
  }
}

void PadFriction::rest_forces(const PlanarWrench& w, Vec2* forces) const noexcept {
  if (is_point_ || w.isZero(0.0)) {
    for (int j = 0; j < count_; ++j) forces[j] = b_[j] * w.head<2>();
    return;
  }
  const RayExit limit = exit(PlanarWrench::Zero(), w, nullptr);
  moving_forces(limit.u, limit.pivot, forces);
  for (int j = 0; j < count_; ++j) forces[j] /= limit.lambda;
}

}  // namespace prehensile
