#include "problems/enumerated_instant.h"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace prehensile {
namespace {

constexpr int kScan = 720;       ///< of a line of twists
constexpr int kStarts = 40;      ///< on the sphere of twists
constexpr double kObeys = 1e-9;  ///< slack of inequalities, in units

/// The instant in units of pad capacity, pad size and push rate, about the pads' centre.
class Enumeration {
 public:
  explicit Enumeration(const RandomInstant& instant)
      : grasp_(instant.grasp), drive_(instant.drive) {
    for (int j = 0; j < grasp_.count; ++j) force_ += grasp_.bound[j];
    for (int j = 0; j < grasp_.count; ++j) centre_ += grasp_.bound[j] / force_ * place(j);
    for (int j = 0; j < grasp_.count; ++j) {
      length_ += grasp_.bound[j] / force_ * (place(j) - centre_).norm();
    }
    for (int i = 0; i < drive_.count; ++i) {
      rate_ = std::max(rate_, point_velocity(drive_.V_HP, drive_.p_HC[i]).norm());
    }
    for (int j = 0; j < grasp_.count; ++j) {
      r_.push_back((place(j) - centre_) / length_);
      b_.push_back(grasp_.bound[j] / force_);
    }
    for (int i = 0; i < drive_.count; ++i) {
      p_.push_back((drive_.p_HC[i] - centre_) / length_);
    }
    const Vec2 f = grasp_.w_g.head<2>() / force_;
    w_ << f, (grasp_.w_g[2] / force_ - cross(centre_, f)) / length_;
    V_ << point_velocity(drive_.V_HP, centre_) / rate_, drive_.V_HP[2] * length_ / rate_;
    n_ = drive_.n_H;
    t_ = perp(n_);
  }

  std::vector<EnumeratedMotion> run() {
    if (p_.size() == 2) {
      both_stick();
      for (const double side : {1.0, -1.0}) both_slip(side);
    }
    for (std::size_t i = 0; i < p_.size(); ++i) {
      one_sticks(i);
      for (const double side : {1.0, -1.0}) one_slips(i, side);
    }
    return found_;
  }

 private:
  Vec2 place(int j) const { return {grasp_.x[j], grasp_.y[j]}; }

  /// Wrench by which the pads resist a twist (object on pads).
  Vec3 resistance(const Vec3& u) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const Vec2 c = point_velocity(u, r_[j]);
      const double size = c.norm();
      if (size > 0.0) sum += wrench_of(r_[j], b_[j] / size * c);
    }
    return sum;
  }

  Eigen::Matrix3d stiffness(const Vec3& u) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t j = 0; j < r_.size(); ++j) {
      const Vec2 c = point_velocity(u, r_[j]);
      const double size = c.norm();
      if (size <= 0.0) continue;
      const Vec3 across = wrench_of(r_[j], perp(c) / size);
      sum += b_[j] / size * across * across.transpose();
    }
    return sum;
  }

  double normal_rate(std::size_t i, const Vec3& u) const {
    return n_.dot(point_velocity(u - V_, p_[i]));
  }
  double slip_rate(std::size_t i, const Vec3& u) const {
    return t_.dot(point_velocity(u - V_, p_[i]));
  }

  void keep(const Vec3& u, const Vec3& w_push) {
    const Vec3 V(u[0], u[1], u[2] / length_);
    EnumeratedMotion motion;
    motion.V_HO << rate_ * (V.head<2>() - V[2] * perp(centre_)), rate_ * V[2];
    const Vec2 f = force_ * w_push.head<2>();
    motion.w_push << f, force_ * length_ * w_push[2] + cross(centre_, f);
    for (const Vec3& known : twists_) {
      if ((known - u).norm() < 1e-7 * (1.0 + u.norm())) return;
    }
    twists_.push_back(u);
    found_.push_back(motion);
  }

  /// Loads (normal, tangential sum) of both ends of a line under a wrench, and whether
  /// they are pressed and inside the cone.
  void judge_line(const Vec3& u, double side) {
    const Vec3 w = resistance(u) - w_;
    const double normal = n_.dot(w.head<2>());
    const double tangential = t_.dot(w.head<2>());
    const Vec2 apart = p_[1] - p_[0];
    const double moment = w[2] - cross(p_[0], Vec2(w.head<2>()));
    // Both tangential forces act along the line through the ends.
    const double second = moment / cross(apart, n_);
    if (second < -kObeys || normal - second < -kObeys) return;
    if (side == 0.0 && std::abs(tangential) > drive_.mu * normal + kObeys) return;
    keep(u, w);
  }

  void both_stick() { judge_line(V_, 0.0); }

  /// Twists V + s t; along them the friction law is one equation in s.
  void both_slip(double side) {
    const Vec3 d(t_.x(), t_.y(), 0.0);
    const Vec2 m = t_ + side * drive_.mu * n_;
    scan(d, Vec3(m.x(), m.y(), 0.0), [&](const Vec3& u, const Vec3&) {
      if (side * slip_rate(0, u) > 0.0) judge_line(u, side);
    });
  }

  /// Twists V + s (turn about the point); no moment about the point.
  void one_sticks(std::size_t i) {
    const Vec3 d(p_[i].y(), -p_[i].x(), 1.0);
    scan(d, d, [&](const Vec3& u, const Vec3& resisted) {
      const Vec3 w = resisted - w_;
      const double normal = n_.dot(w.head<2>());
      if (normal < -kObeys) return;
      if (std::abs(t_.dot(w.head<2>())) > drive_.mu * normal + kObeys) return;
      if (parts_elsewhere(i, u)) keep(u, w);
    });
  }

  bool parts_elsewhere(std::size_t i, const Vec3& u) const {
    return p_.size() == 1 || normal_rate(1 - i, u) >= -kObeys;
  }

  /// Every zero of z.(resistance - gravity) on the line V + s d, s = tan(angle), by
  /// bisection. It may be a jump: a pad point that becomes the centre of rotation.
  template <class Use>
  void scan(const Vec3& d, const Vec3& z, const Use& use) {
    const double size = d.norm();
    const auto twist = [&](double angle) {
      return Vec3(std::cos(angle) * V_ + std::sin(angle) / size * d);
    };
    const auto off = [&](double angle) { return z.dot(resistance(twist(angle)) - w_); };
    const double step = std::numbers::pi / kScan;
    for (int k = 0; k < kScan; ++k) {
      double low = -0.5 * std::numbers::pi + k * step + 1e-9;
      double high = low + step;
      if (k == kScan - 1) high = 0.5 * std::numbers::pi - 1e-9;
      double at_low = off(low);
      const double at_high = off(high);
      if ((at_low < 0.0) == (at_high < 0.0)) continue;
      for (int halving = 0; halving < 80; ++halving) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        const double at_middle = off(middle);
        ((at_middle < 0.0) == (at_low < 0.0) ? low : high) = middle;
      }
      at_low = off(low);
      const double jump = off(high) - at_low;
      const double share = jump != 0.0 ? std::clamp(-at_low / jump, 0.0, 1.0) : 0.0;
      const Vec3 resisted =
          (1.0 - share) * resistance(twist(low)) + share * resistance(twist(high));
      use(Vec3(twist(low) / std::cos(low)), resisted);
    }
  }

  /// Directions u whose resistance is w + lambda e: on the unit sphere by Newton's method
  /// from many starts, and about every pad point.
  void one_slips(std::size_t i, double side) {
    const Vec3 e = wrench_of(p_[i], n_ - side * drive_.mu * t_);
    for (std::size_t j = 0; j < r_.size(); ++j) turn_about(i, side, e, j);
    for (int k = 0; k < kStarts; ++k) {
      const double z = 1.0 - 2.0 * (k + 0.5) / kStarts;
      const double ring = std::sqrt(1.0 - z * z);
      const double angle = 2.399963229728653 * k;
      Vec3 u(ring * std::cos(angle), ring * std::sin(angle), z);
      double lambda = 0.0;
      if (newton(e, u, lambda)) accept_slip(i, side, e, u, lambda);
    }
  }

  void turn_about(std::size_t i, double side, const Vec3& e, std::size_t j) {
    for (const double turn : {1.0, -1.0}) {
      const Vec3 u = turn * Vec3(r_[j].y(), -r_[j].x(), 1.0);
      Eigen::Matrix3d columns;
      columns << wrench_of(r_[j], Vec2(1.0, 0.0)), wrench_of(r_[j], Vec2(0.0, 1.0)), -e;
      Vec3 others = Vec3::Zero();
      double bound = 0.0;
      for (std::size_t k = 0; k < r_.size(); ++k) {
        const Vec2 c = point_velocity(u, r_[k]);
        if (c.norm() > 1e-12) {
          others += wrench_of(r_[k], b_[k] / c.norm() * c);
        } else {
          bound += b_[k];
        }
      }
      const Vec3 x = columns.fullPivLu().solve(Vec3(w_ - others));
      if (!(x.head<2>().norm() <= bound)) continue;
      accept_slip(i, side, e, u, x[2]);
    }
  }

  void accept_slip(std::size_t i, double side, const Vec3& e, const Vec3& direction,
                   double lambda) {
    if (lambda < -kObeys) return;
    const double approach = n_.dot(point_velocity(V_, p_[i]));
    const double scale = approach / n_.dot(point_velocity(direction, p_[i]));
    if (!(scale > 0.0) || !std::isfinite(scale)) return;
    const Vec3 u = scale * direction;
    if (side * slip_rate(i, u) < -kObeys || !parts_elsewhere(i, u)) return;
    keep(u, lambda * e);
  }

  /// resistance(u) = w + lambda e and |u| = 1, by damped least squares.
  bool newton(const Vec3& e, Vec3& u, double& lambda) const {
    const auto off = [&](const Vec3& at, double l) {
      return Vec3(resistance(at) - w_ - l * e);
    };
    lambda = e.dot(resistance(u) - w_) / e.squaredNorm();
    Vec3 rest = off(u, lambda);
    double damping = 1e-3;
    for (int step = 0; step < 100 && rest.norm() > 1e-13; ++step) {
      Eigen::Matrix<double, 4, 4> J = Eigen::Matrix<double, 4, 4>::Zero();
      J.topLeftCorner<3, 3>() = stiffness(u);
      J.topRightCorner<3, 1>() = -e;
      J.bottomLeftCorner<1, 3>() = u.transpose();
      Eigen::Vector4d right;
      right << -rest, 0.0;
      const Eigen::Matrix4d normal =
          J.transpose() * J + damping * damping * Eigen::Matrix4d::Identity();
      const Eigen::Vector4d x =
          normal.ldlt().solve(Eigen::Vector4d(J.transpose() * right));
      const Vec3 next = (u + x.head<3>()).normalized();
      const double next_lambda = lambda + x[3];
      const Vec3 there = off(next, next_lambda);
      if (there.norm() < rest.norm()) {
        u = next;
        lambda = next_lambda;
        rest = there;
        damping *= 0.2;
      } else {
        damping = std::max(4.0 * damping, 1e-8);
        if (damping > 1e6) break;
      }
    }
    return rest.norm() <= 1e-11;
  }

  const PlanarGrasp& grasp_;
  const PlanarDrive& drive_;
  double force_ = 0.0, length_ = 0.0, rate_ = 0.0;
  Vec2 centre_ = Vec2::Zero();
  std::vector<Vec2> r_, p_;
  std::vector<double> b_;
  Vec3 w_ = Vec3::Zero();
  Vec3 V_ = Vec3::Zero();
  Vec2 n_, t_;
  std::vector<Vec3> twists_;
  std::vector<EnumeratedMotion> found_;
};

}  // namespace

std::vector<EnumeratedMotion> enumerate_motions(const RandomInstant& instant) {
  return Enumeration(instant).run();
}

}  // namespace prehensile
