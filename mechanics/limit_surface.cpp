#include "mechanics/limit_surface.h"

#include "mechanics/contact_mode.h"
#include "mechanics/motion_in_mode.h"
#include "mechanics/push_verdict.h"

namespace prehensile {
namespace {

/// The ellipsoid in its own units, where it is the unit sphere: every problem of
/// PushModes is a plane, a ray or a line against the sphere.
class UnitSphere {
 public:
  bool is_point() const { return false; }

  double dissipation(const PlanarTwist& u) const { return u.norm(); }

  PlanarWrench resistance(const PlanarTwist& u, const PivotPoint&) const {
    const double square = u.squaredNorm();
    return (square > 0.0 ? 1.0 / std::sqrt(square) : 0.0) * u;
  }

  PivotPoint pivot_at(const PlanarTwist&) const { return {}; }
  void choose_pivot_force(const ScaledPush&, Motion&) const {}

  PlanarTwist scaled_twist(const PlanarTwist& u, const PivotPoint&, double scale) const {
    return scale * u;
  }

  bool holds(const PlanarWrench& w, PlanarTwist* unsupported) const {
    if (w.squaredNorm() < 1.0) return true;
    *unsupported = w.normalized();
    return false;
  }

  RayExit exit(const PlanarWrench& w, const PlanarWrench& e, const PlanarTwist*) const {
    const double a = e.squaredNorm();
    const double b = w.dot(e);
    const double c = w.squaredNorm() - 1.0;
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0.0)) return {};
    const double root = std::sqrt(discriminant);
    const double lambda = b > 0.0 ? -c / (b + root) : (root - b) / a;
    return {true, lambda, w + lambda * e, {}};
  }

  /// On u = a + s d with a at right angles to d, power is sqrt(a^2 + s^2 d^2) - s w.d.
  LowestOnLine lowest(const PlanarTwist& u0, const PlanarTwist& d, const PlanarWrench& w,
                      const PlanarTwist*) const {
    const double dd = d.squaredNorm();
    const double wd = w.dot(d);
    const double rest = dd - wd * wd;
    if (!(rest > 0.0)) return {};
    const PlanarTwist across = u0 - u0.dot(d) / dd * d;
    const double s = wd * std::sqrt(across.squaredNorm() / (dd * rest));
    return {true, across + s * d, {}};
  }

  int slides(const SlideQuestion& question, int capacity, double* roots) const {
    double found[2];
    const int count = std::min(capacity, slides_on_sphere(question, found));
    std::copy_n(found, count, roots);
    return count;
  }

  bool nearest_slide(const SlideQuestion& question, double& root) const {
    SlideQuestion either_side = question;
    either_side.start = -question.slip * std::numeric_limits<double>::infinity();
    double found[2];
    const int count = slides_on_sphere(either_side, found);
    if (count == 0) return false;
    const bool second =
        count == 2 && std::abs(found[1] - root) < std::abs(found[0] - root);
    root = found[second ? 1 : 0];
    return true;
  }
};

}  // namespace

PlanarWrench LimitSurface::friction(const PlanarTwist& V) const noexcept {
  const double turn = c * V[2];
  const double rate = std::sqrt(V[0] * V[0] + V[1] * V[1] + turn * turn);
  return -F / rate * PlanarWrench(V[0], V[1], c * turn);
}

PlanarTwist LimitSurface::sliding_twist(const PlanarWrench& friction) const noexcept {
  return {-friction[0], -friction[1], -friction[2] / (c * c)};
}

double LimitSurface::load(const PlanarWrench& w) const noexcept {
  const double turn = w[2] / c;
  return std::sqrt(w[0] * w[0] + w[1] * w[1] + turn * turn) / F;
}

PlanarInstant solve_limit_surface(const LimitSurface& surface, const PlanarWrench& w_g,
                                  const PlanarDrive& drive) noexcept {
  PlanarInstant answer;
  const bool has_surface = surface.F > 0.0 && surface.c > 0.0 &&
                           std::isfinite(surface.F) && std::isfinite(surface.c);
  answer.status = InstantStatus::kBadInput;
  if (!has_surface || !is_sane(w_g, drive)) return answer;
  const ScaledPush push = scaled(w_g, drive, Vec2::Zero(), surface.c, surface.F);
  if (!(push.units.rate > 0.0) || !is_within_range(push)) return answer;
  report(push, judge_push(UnitSphere{}, push, nullptr, false), answer);
  return answer;
}

MotionInMode solve_limit_surface_in_mode(const LimitSurface& surface,
                                         const PlanarWrench& w_g,
                                         const PlanarDrive& drive,
                                         const ContactModeOfPush& mode) noexcept {
  if (!(surface.F > 0.0 && surface.c > 0.0) || !is_sane(w_g, drive) ||
      !(contact_rate(drive) > 0.0)) {
    return {};
  }
  const ScaledPush push = scaled(w_g, drive, Vec2::Zero(), surface.c, surface.F);
  return motion_in_mode(UnitSphere{}, push, mode, nullptr);
}

}  // namespace prehensile
