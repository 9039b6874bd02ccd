#include "primitives/robust_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace prehensile {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFreedom = 4.0;  ///< of the t distribution of the residuals

/// Residuals of all parts at some parameters, their scales and the objective.
struct Point {
  VectorXd at;
  MatrixXd residuals;
  std::vector<double> scale;
  double objective = 0.0;
};

/// Scale of greatest likelihood: where the mean of (nu + 1) u / (nu + u), u = (r / s)^2,
/// is one; the mean falls with s.
double scale_of(const std::vector<double>& r, double least) {
  const auto mean = [&](double s) {
    double sum = 0.0;
    for (const double value : r) {
      const double u = (value / s) * (value / s);
      sum += (kFreedom + 1.0) * u / (kFreedom + u);
    }
    return sum / static_cast<double>(r.size());
  };
  double high = least;
  for (const double value : r) high = std::max(high, 2.0 * std::abs(value));
  double low = least;
  if (mean(low) <= 1.0) return low;
  for (int i = 0; i < 60 && high > low * (1.0 + 1e-12); ++i) {
    const double middle = std::sqrt(low * high);
    (mean(middle) > 1.0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double loss(double r, double scale) {
  const double u = (r / scale) * (r / scale);
  return 0.5 * (kFreedom + 1.0) * std::log1p(u / kFreedom);
}

class Fitter {
 public:
  Fitter(const FitProblem& problem, std::span<const int> rows,
         const std::vector<bool>& held)
      : problem_(problem), rows_(rows) {
    for (int i = 0; i < static_cast<int>(problem.parameters.size()); ++i) {
      if (held.empty() || !held[static_cast<std::size_t>(i)]) free_.push_back(i);
    }
  }

  Point point(const VectorXd& at) {
    Point out;
    out.at = at;
    out.residuals.resize(problem_.parts(), static_cast<Eigen::Index>(rows_.size()));
    problem_.residuals(at, rows_, out.residuals);
    ++evaluations_;
    for (int part = 0; part < problem_.parts(); ++part) {
      std::vector<double> measured;
      for (const double r : out.residuals.row(part)) {
        if (!std::isnan(r)) measured.push_back(r);
      }
      out.scale.push_back(std::numeric_limits<double>::quiet_NaN());
      if (measured.empty()) continue;
      const double least = problem_.resolution[static_cast<std::size_t>(part)];
      const double scale = scale_of(measured, least);
      out.scale.back() = scale;
      out.objective += static_cast<double>(measured.size()) * std::log(scale);
      for (const double r : measured) out.objective += loss(r, scale);
    }
    return out;
  }

  /// Derivative of the residuals by a parameter, over `step` to both sides where the
  /// range allows: mirrored problems have mirrored answers.
  MatrixXd derivative(const Point& at, int parameter) {
    const FitParameter& p = problem_.parameters[static_cast<std::size_t>(parameter)];
    VectorXd up = at.at;
    VectorXd down = at.at;
    up[parameter] = std::min(p.high, up[parameter] + p.step);
    down[parameter] = std::max(p.low, down[parameter] - p.step);
    MatrixXd r_up(at.residuals.rows(), at.residuals.cols());
    MatrixXd r_down = r_up;
    problem_.residuals(up, rows_, r_up);
    problem_.residuals(down, rows_, r_down);
    evaluations_ += 2;
    return (r_up - r_down) / (up[parameter] - down[parameter]);
  }

  Point descend(Point now, const FitOptions& options) {
    double damping = 1e-3;
    for (int i = 0; i < options.max_iterations && !free_.empty(); ++i) {
      const double before = now.objective;
      if (!step(now, damping)) break;
      if (before - now.objective < options.tolerance) break;
    }
    return now;
  }

  /// The best of the tries, one parameter after the other.
  Point best_start(Point now) {
    for (const int j : free_) {
      for (const double value : problem_.parameters[static_cast<std::size_t>(j)].tries) {
        VectorXd other = now.at;
        other[j] = value;
        const Point there = point(other);
        if (there.objective < now.objective) now = there;
      }
    }
    return now;
  }

  const std::vector<int>& free() const { return free_; }
  int evaluations() const { return evaluations_; }

 private:
  /// One damped step downhill; false if there is none.
  bool step(Point& now, double& damping) {
    const int n = static_cast<int>(free_.size());
    MatrixXd H = MatrixXd::Zero(n, n);
    VectorXd g = VectorXd::Zero(n);
    std::vector<MatrixXd> J;
    J.reserve(free_.size());
    for (const int j : free_) J.push_back(derivative(now, j));
    for (Eigen::Index row = 0; row < now.residuals.cols(); ++row) {
      for (Eigen::Index part = 0; part < now.residuals.rows(); ++part) {
        const double r = now.residuals(part, row);
        if (std::isnan(r)) continue;
        const double s = now.scale[static_cast<std::size_t>(part)];
        const double w = (kFreedom + 1.0) / (kFreedom + (r / s) * (r / s)) / (s * s);
        for (int a = 0; a < n; ++a) {
          const double Ja = J[static_cast<std::size_t>(a)](part, row);
          g[a] += w * Ja * r;
          for (int b = 0; b < n; ++b) {
            H(a, b) += w * Ja * J[static_cast<std::size_t>(b)](part, row);
          }
        }
      }
    }
    for (int tries = 0; tries < 8; ++tries) {
      MatrixXd A = H;
      for (int a = 0; a < n; ++a) {
        // A parameter without influence stays where it is.
        const double step =
            problem_
                .parameters[static_cast<std::size_t>(free_[static_cast<std::size_t>(a)])]
                .step;
        A(a, a) += damping * H(a, a) + 1e-6 / (step * step);
      }
      const VectorXd delta = A.ldlt().solve(-g);
      VectorXd next = now.at;
      for (int a = 0; a < n; ++a) {
        const int j = free_[static_cast<std::size_t>(a)];
        const FitParameter& p = problem_.parameters[static_cast<std::size_t>(j)];
        next[j] = std::clamp(next[j] + delta[a], p.low, p.high);
      }
      if (next.allFinite() && next != now.at) {
        Point there = point(next);
        if (there.objective < now.objective) {
          now = std::move(there);
          damping = std::max(1e-6, 0.1 * damping);
          return true;
        }
      }
      damping = std::max(1e-3, 10.0 * damping);
    }
    return false;
  }

  const FitProblem& problem_;
  std::span<const int> rows_;
  std::vector<int> free_;
  int evaluations_ = 0;
};

Fit result_of(const Point& point, int evaluations) {
  return {point.at, point.scale, point.objective, evaluations};
}

}  // namespace

Eigen::VectorXd start_of(const FitProblem& problem) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(problem.parameters.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    out[i] = problem.parameters[static_cast<std::size_t>(i)].start;
  }
  return out;
}

Fit fit(const FitProblem& problem, std::span<const int> rows,
        const Eigen::VectorXd& start, const std::vector<bool>& held,
        const FitOptions& options) {
  Fitter fitter(problem, rows, held);
  Point now = fitter.point(start);
  if (options.try_others) now = fitter.best_start(now);
  now = fitter.descend(now, options);
  return result_of(now, fitter.evaluations());
}

FitCovariance covariance(const FitProblem& problem, std::span<const int> rows,
                         const Fit& best, const std::vector<bool>& held) {
  Fitter fitter(problem, rows, held);
  const Point at = fitter.point(best.at);
  const int n = static_cast<int>(fitter.free().size());
  const auto all = static_cast<Eigen::Index>(problem.parameters.size());
  FitCovariance out{MatrixXd::Zero(all, all), MatrixXd::Zero(all, all)};
  if (n == 0) return out;
  std::vector<MatrixXd> J;
  for (const int j : fitter.free()) J.push_back(fitter.derivative(at, j));
  MatrixXd H = MatrixXd::Zero(n, n);
  MatrixXd B = MatrixXd::Zero(n, n);
  int counted = 0;
  // The mean curvature of the loss of each part: single ones may be negative.
  std::vector<double> curvature(static_cast<std::size_t>(problem.parts()), 0.0);
  for (int part = 0; part < problem.parts(); ++part) {
    const double s = at.scale[static_cast<std::size_t>(part)];
    int measured = 0;
    for (const double r : at.residuals.row(part)) {
      if (std::isnan(r)) continue;
      const double u = (r / s) * (r / s);
      curvature[static_cast<std::size_t>(part)] +=
          (kFreedom + 1.0) * (kFreedom - u) / ((kFreedom + u) * (kFreedom + u)) / (s * s);
      ++measured;
    }
    // Of residuals with more outliers than the distribution has it might vanish.
    curvature[static_cast<std::size_t>(part)] = std::max(
        curvature[static_cast<std::size_t>(part)] / std::max(1, measured), 0.2 / (s * s));
  }
  for (Eigen::Index row = 0; row < at.residuals.cols(); ++row) {
    VectorXd score = VectorXd::Zero(n);
    bool any = false;
    for (Eigen::Index part = 0; part < at.residuals.rows(); ++part) {
      const double r = at.residuals(part, row);
      if (std::isnan(r)) continue;
      any = true;
      const double s = at.scale[static_cast<std::size_t>(part)];
      const double w = (kFreedom + 1.0) / (kFreedom + (r / s) * (r / s)) / (s * s);
      for (int a = 0; a < n; ++a) {
        const double Ja = J[static_cast<std::size_t>(a)](part, row);
        score[a] += w * r * Ja;
        for (int b = 0; b < n; ++b) {
          H(a, b) += curvature[static_cast<std::size_t>(part)] * Ja *
                     J[static_cast<std::size_t>(b)](part, row);
        }
      }
    }
    counted += any;
    B += score * score.transpose();
  }
  // A parameter without influence has a variance that is large, not none.
  for (int a = 0; a < n; ++a) {
    const FitParameter& p = problem.parameters[static_cast<std::size_t>(
        fitter.free()[static_cast<std::size_t>(a)])];
    const double unit = std::isfinite(p.known) ? p.known : p.high - p.low;
    H(a, a) += 1e-6 / (unit * unit);
  }
  // The scores of the rows that made the fit are too small by what the fit used up.
  const double spent =
      static_cast<double>(counted) / static_cast<double>(std::max(1, counted - n));
  const MatrixXd inverse = H.ldlt().solve(MatrixXd::Identity(n, n));
  const MatrixXd model = spent * inverse;
  const MatrixXd scatter = spent * inverse * B * inverse;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const auto i = static_cast<std::size_t>(a);
      const auto k = static_cast<std::size_t>(b);
      out.by_model(fitter.free()[i], fitter.free()[k]) = model(a, b);
      out.by_scatter(fitter.free()[i], fitter.free()[k]) = scatter(a, b);
    }
  }
  return out;
}

}  // namespace prehensile
