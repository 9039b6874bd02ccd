#include "mechanics/proximal_newton.h"

#include <Eigen/LU>

namespace prehensile {
namespace {

constexpr int kStepsPerCentre = 25;
constexpr int kHalvings = 20;

/// One contact force as a function of the rate of its point, and its derivative.
struct Projected {
  Vec2 force;                 ///< along (n, t) for the pusher, (x, y) for a finger point
  Eigen::Matrix2d stiffness;  ///< - d force / d rate
};

/// Nearest vector to y in a disc.
Projected project_on_disc(const Vec2& y, double bound, double r) {
  const double length = y.norm();
  if (length <= bound) return {y, Eigen::Matrix2d::Identity() / r};
  const Vec2 across = perp(y) / length;
  return {bound / length * y, bound / (r * length) * (across * across.transpose())};
}

/// Unilateral normal force, then friction clamped to that bound. (Not the projection on
/// the cone: Coulomb friction is not associated with the normal direction.)
Projected project_on_cone(const Vec2& y, double mu, double r) {
  Projected result{Vec2::Zero(), Eigen::Matrix2d::Zero()};
  if (y.x() <= 0.0) return result;
  const double bound = mu * y.x();
  result.force.x() = y.x();
  result.stiffness(0, 0) = 1.0 / r;
  if (std::abs(y.y()) <= bound) {
    result.force.y() = y.y();
    result.stiffness(1, 1) = 1.0 / r;
  } else {
    const double side = std::copysign(mu, y.y());
    result.force.y() = side * y.x();
    result.stiffness(1, 0) = side / r;
  }
  return result;
}

class Iteration {
 public:
  Iteration(const PadFriction& pads, const ScaledPush& push, const Eigen::Matrix3d& M)
      : pads_(pads), push_(push), M_(M) {
    for (int i = 0; i < push.count; ++i) {
      rows_[i].row(0) = wrench_of(push.p[i], push.n).transpose();
      rows_[i].row(1) = wrench_of(push.p[i], push.t).transpose();
    }
  }

  void start_at(const PlanarTwist& u) {
    u_ = before_ = u;
    pusher_centre_.fill(Vec2::Zero());
    for (int j = 0; j < pads_.count(); ++j) finger_centre_[j].setZero();
    evaluate(u_);
  }

  /// Newton's method for the present force centres.
  bool settle(double tolerance, int& steps, int max_steps) {
    for (int step = 0; step < kStepsPerCentre && steps < max_steps; ++step, ++steps) {
      if (balance_.norm() <= tolerance) return true;
      const PlanarTwist stride = -jacobian_.partialPivLu().solve(balance_);
      if (!stride.allFinite()) return false;
      if (!line_search(stride)) return balance_.norm() <= 10.0 * tolerance;
    }
    return balance_.norm() <= tolerance;
  }

  void move_centres() {
    pusher_centre_ = pusher_force_;
    for (int j = 0; j < pads_.count(); ++j) finger_centre_[j] = finger_force_[j];
    before_ = u_;
  }

  void set_prox(double r, double e) {
    r_ = r;
    e_ = e;
    evaluate(u_);
  }

  /// Distance of forces and rates from the laws, whatever the force centres.
  double natural_map() const {
    const PlanarTwist relative = u_ - push_.V;
    PlanarWrench rest = M_ * u_ - push_.w_g;
    double worst = 0.0;
    for (int i = 0; i < push_.count; ++i) {
      const Vec2 y = pusher_force_[i] - rows_[i] * relative;
      const Vec2& force = pusher_force_[i];
      const double bound = push_.mu * force.x();
      worst = std::max(worst, std::abs(force.x() - std::max(0.0, y.x())));
      worst = std::max(worst, std::abs(force.y() - std::clamp(y.y(), -bound, bound)));
      rest -= rows_[i].transpose() * force;
    }
    for (int j = 0; j < pads_.count(); ++j) {
      const Vec2 c = point_velocity(u_, pads_.at(j));
      const Vec2& force = finger_force_[j];
      const Vec2 projected = project_on_disc(force - c, pads_.bound(j), 1.0).force;
      worst = std::max(worst, (force - projected).norm());
      rest -= wrench_of(pads_.at(j), force);
    }
    return std::max(worst, rest.norm());
  }

  void write(NewtonAnswer& answer) const {
    answer.u = u_;
    for (int i = 0; i < push_.count; ++i) {
      answer.normal[i] = pusher_force_[i].x();
      answer.tangential[i] = pusher_force_[i].y();
    }
    for (int j = 0; j < pads_.count(); ++j) answer.finger[j] = finger_force_[j];
  }

 private:
  void evaluate(const PlanarTwist& u) {
    balance_ = M_ * u - push_.w_g + e_ * (u - before_);
    jacobian_ = M_;
    jacobian_.diagonal().array() += e_;
    const PlanarTwist relative = u - push_.V;
    for (int i = 0; i < push_.count; ++i) {
      const Vec2 y = pusher_centre_[i] - rows_[i] * relative / r_;
      const Projected at = project_on_cone(y, push_.mu, r_);
      pusher_force_[i] = at.force;
      balance_ -= rows_[i].transpose() * at.force;
      jacobian_ += rows_[i].transpose() * at.stiffness * rows_[i];
    }
    Eigen::Matrix<double, 2, 3> row;
    for (int j = 0; j < pads_.count(); ++j) {
      const Vec2 p = pads_.at(j);
      const Vec2 y = finger_centre_[j] - point_velocity(u, p) / r_;
      const Projected at = project_on_disc(y, pads_.bound(j), r_);
      finger_force_[j] = at.force;
      balance_ -= wrench_of(p, at.force);
      row << 1.0, 0.0, -p.y(), 0.0, 1.0, p.x();
      jacobian_ += row.transpose() * at.stiffness * row;
    }
  }

  bool line_search(const PlanarTwist& stride) {
    const PlanarTwist from = u_;
    const double before = balance_.norm();
    double share = 1.0;
    for (int halving = 0; halving < kHalvings; ++halving, share *= 0.5) {
      evaluate(from + share * stride);
      if (balance_.norm() <= (1.0 - 1e-4 * share) * before) {
        u_ = from + share * stride;
        return true;
      }
    }
    evaluate(from);
    return false;
  }

  const PadFriction& pads_;
  const ScaledPush& push_;
  const Eigen::Matrix3d M_;
  std::array<Eigen::Matrix<double, 2, 3>, 2> rows_;
  double r_ = 0.3;
  double e_ = 0.0;
  PlanarTwist u_ = PlanarTwist::Zero();
  PlanarTwist before_ = PlanarTwist::Zero();
  PlanarWrench balance_ = PlanarWrench::Zero();
  Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Zero();
  std::array<Vec2, 2> pusher_centre_{Vec2::Zero(), Vec2::Zero()};
  std::array<Vec2, 2> pusher_force_{Vec2::Zero(), Vec2::Zero()};
  std::array<Vec2, PlanarGrasp::kCapacity> finger_centre_;
  std::array<Vec2, PlanarGrasp::kCapacity> finger_force_;
};

/// One run from zero forces; `pace` scales the rates at which contacts are probed.
void run(Iteration& iteration, const PlanarTwist& start, double pace, double tolerance,
         int max_steps, NewtonAnswer& answer) {
  double r = 0.3 * pace;
  double e = 0.0;
  double residual = std::numeric_limits<double>::infinity();
  iteration.start_at(start);
  while (answer.steps < max_steps) {
    iteration.set_prox(r, e);
    const double wanted =
        std::max(0.1 * tolerance, std::min(1e-3, 0.1 * residual * residual));
    const bool settled = iteration.settle(wanted, answer.steps, max_steps);
    const double now = iteration.natural_map();
    if (std::isfinite(now)) residual = now;
    if (residual <= tolerance) break;
    if (settled) {
      iteration.move_centres();
      r = std::max(1e-4 * pace, 0.3 * r);
      e *= 0.2;
    } else {
      e = std::max(10.0 * e, 0.1 / pace);
      r = std::min(3.0 * pace, 2.0 * r);
    }
    ++answer.steps;
  }
  answer.residual = residual;
  answer.converged = residual <= tolerance;
}

}  // namespace

NewtonAnswer solve_proximal_newton(const PadFriction& pads, const ScaledPush& push,
                                   const Eigen::Matrix3d& M, const PlanarTwist& start,
                                   double tolerance, int max_steps) noexcept {
  NewtonAnswer answer;
  Iteration iteration(pads, push, M);
  // An object that falls reaches the rate at which inertia matters, M u = w: other paces.
  const double fall = 1.0 / std::max(M.topLeftCorner<2, 2>().norm(), 1e-12);
  const std::array<double, 8> kPaces = {1.0, 30.0,       fall,       1.0, std::sqrt(fall),
                                        1e3, 0.1 * fall, 10.0 * fall};
  constexpr std::size_t kAttempts = kPaces.size();
  for (std::size_t k = 0; k < kAttempts && !answer.converged; ++k) {
    const int left = max_steps - answer.steps;
    const int budget =
        answer.steps + left / static_cast<int>(std::min<std::size_t>(4, kAttempts - k));
    const bool from_pusher = k == 3 || k == 6;
    const PlanarTwist from = k == 0        ? start
                             : from_pusher ? push.V
                                           : PlanarTwist(PlanarTwist::Zero());
    run(iteration, from, kPaces[k], tolerance, budget, answer);
  }
  iteration.write(answer);
  return answer;
}

}  // namespace prehensile
