#include "primitives/calibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Parameters whose estimates move together more than this can be exchanged.
constexpr double kConfused = 0.95;

/// So much less of - log L is a better place, and so often a fit begins anew there.
constexpr double kBetter = 0.1;
constexpr int kMostRestarts = 3;

class Calibrator {
 public:
  Calibrator(const FitProblem& problem, const CalibrationOptions& options)
      : problem_(problem),
        options_(options),
        count_(static_cast<int>(problem.parameters.size())),
        rows_(static_cast<std::size_t>(problem.rows)),
        held_(static_cast<std::size_t>(count_), false),
        start_(start_of(problem)) {
    std::iota(rows_.begin(), rows_.end(), 0);
    fit_options_.level = options.level;
    out_.parameters.resize(static_cast<std::size_t>(count_));
  }

  Calibration run() {
    fit_told_parameters();
    for (int j = 0; j < count_; ++j) {
      CalibratedParameter& parameter = out_.parameters[static_cast<std::size_t>(j)];
      parameter.value = out_.fit.at[j];
      parameter.told = !held_[static_cast<std::size_t>(j)];
    }
    out_.before = residuals(start_of(problem_), rows_);
    out_.after = residuals(out_.fit.at, rows_);
    hold_out();
    return std::move(out_);
  }

 private:
  const FitParameter& at(int j) const {
    return problem_.parameters[static_cast<std::size_t>(j)];
  }

  MatrixXd residuals(const VectorXd& values, const std::vector<int>& rows) const {
    MatrixXd out(problem_.parts(), static_cast<Eigen::Index>(rows.size()));
    problem_.residuals(values, rows, out);
    return out;
  }

  /// Fits, and takes out one parameter after the other that the data do not tell: first
  /// by the curvature, then by the profile.
  void fit_told_parameters() {
    while (true) {
      out_.fit = fit(problem_, rows_, start_, held_, fit_options_);
      const FitCovariance spread = covariance(problem_, rows_, out_.fit, held_);
      int worst = -1;
      double worst_share = 1.0;
      for (int j = 0; j < count_; ++j) {
        if (held_[static_cast<std::size_t>(j)]) continue;
        const double share = width_by_curvature(spread, j) / at(j).known;
        if (share > worst_share) {
          worst = j;
          worst_share = share;
        }
      }
      if (worst >= 0) note_confusion(spread, worst);
      if (worst < 0) worst = profile_all(spread);
      if (worst < 0 && (begins_at_better_place() || samples_better_place())) continue;
      if (worst < 0) return;
      if (is_unset(worst)) {
        out_.parameters[static_cast<std::size_t>(worst)].profile =
            profile(problem_, rows_, out_.fit, worst, held_, spread, fit_options_);
      }
      hold(worst);
    }
  }

  /// A profile that falls below the fit has found a better place: the next fit begins
  /// there. False if there is none, or it happened too often.
  bool begins_at_better_place() {
    double least = -kBetter;
    bool found = false;
    for (int j = 0; j < count_; ++j) {
      if (held_[static_cast<std::size_t>(j)]) continue;
      for (const ProfilePoint& point :
           out_.parameters[static_cast<std::size_t>(j)].profile.points) {
        if (point.rise >= least) continue;
        least = point.rise;
        start_ = point.at;
        found = true;
      }
    }
    return found && ++restarts_ <= kMostRestarts;
  }

  /// The same of profiles that are sampled evenly, which look nearer to the fit.
  bool samples_better_place() {
    double most = kBetter;
    bool found = false;
    for (int j = 0; j < count_; ++j) {
      if (held_[static_cast<std::size_t>(j)]) continue;
      Profile& profile = out_.parameters[static_cast<std::size_t>(j)].profile;
      sample_profile(problem_, rows_, out_.fit, j, held_, profile);
      const auto by_rise = [](const ProfilePoint& a, const ProfilePoint& b) {
        return a.rise < b.rise;
      };
      const auto least = std::ranges::min_element(profile.points, by_rise);
      const auto of_fit =
          std::ranges::find(profile.points, out_.fit.at[j], &ProfilePoint::value);
      if (of_fit->rise <= most) continue;
      most = of_fit->rise;
      start_ = least->at;
      found = true;
    }
    return found && ++restarts_ <= kMostRestarts;
  }

  bool is_unset(int j) const {
    return out_.parameters[static_cast<std::size_t>(j)].profile.points.empty();
  }

  void hold(int j) {
    const FitInterval& interval =
        out_.parameters[static_cast<std::size_t>(j)].profile.interval;
    held_[static_cast<std::size_t>(j)] = true;
    start_[j] = std::clamp(at(j).start, interval.low, interval.high);
    for (int other = 0; other < count_; ++other) {
      if (held_[static_cast<std::size_t>(other)]) continue;
      out_.parameters[static_cast<std::size_t>(other)].profile = {};
    }
  }

  double width_by_curvature(const FitCovariance& spread, int j) const {
    const int freedom = std::max(3, problem_.rows - free_count());
    const double variance = std::max(spread.by_scatter(j, j), spread.by_model(j, j));
    return student_quantile(0.5 + 0.5 * options_.level, freedom) * std::sqrt(variance);
  }

  int free_count() const {
    return static_cast<int>(std::count(held_.begin(), held_.end(), false));
  }

  /// Profiles of all that are fitted; the first that is wider than what was known, or -1.
  int profile_all(const FitCovariance& spread) {
    for (int j = 0; j < count_; ++j) {
      if (held_[static_cast<std::size_t>(j)]) continue;
      CalibratedParameter& parameter = out_.parameters[static_cast<std::size_t>(j)];
      parameter.profile =
          profile(problem_, rows_, out_.fit, j, held_, spread, fit_options_);
      if (parameter.profile.interval.half_width() > at(j).known) {
        note_confusion(spread, j);
        return j;
      }
    }
    return -1;
  }

  void note_confusion(const FitCovariance& spread, int j) {
    CalibratedParameter& parameter = out_.parameters[static_cast<std::size_t>(j)];
    for (int other = 0; other < count_; ++other) {
      if (other == j || held_[static_cast<std::size_t>(other)]) continue;
      const double correlation =
          spread.by_model(j, other) /
          std::sqrt(spread.by_model(j, j) * spread.by_model(other, other));
      if (std::abs(correlation) < std::max(kConfused, std::abs(parameter.correlation))) {
        continue;
      }
      parameter.correlation = correlation;
      parameter.confused_with = other;
    }
  }

  /// Each row is predicted by a fit without its fold.
  void hold_out() {
    std::vector<int> order = rows_;
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::make_pair(random_point(options_.seed, static_cast<std::uint64_t>(a))[0],
                            a) <
             std::make_pair(random_point(options_.seed, static_cast<std::uint64_t>(b))[0],
                            b);
    });
    out_.fold.assign(rows_.size(), 0);
    const int folds = std::min(options_.folds, problem_.rows);
    for (std::size_t i = 0; i < order.size(); ++i) {
      out_.fold[static_cast<std::size_t>(order[i])] = static_cast<int>(i) % folds;
    }
    out_.held_out = MatrixXd::Zero(problem_.parts(), problem_.rows);
    for (int fold = 0; fold < folds; ++fold) {
      std::vector<int> fitted, left_out;
      for (const int row : rows_) {
        (out_.fold[static_cast<std::size_t>(row)] == fold ? left_out : fitted)
            .push_back(row);
      }
      out_.fold_at.push_back(fit(problem_, fitted, start_, held_, fit_options_).at);
      const MatrixXd r = residuals(out_.fold_at.back(), left_out);
      for (std::size_t i = 0; i < left_out.size(); ++i) {
        out_.held_out.col(left_out[i]) = r.col(static_cast<Eigen::Index>(i));
      }
    }
  }

  const FitProblem& problem_;
  CalibrationOptions options_;
  int count_;
  std::vector<int> rows_;
  std::vector<bool> held_;
  VectorXd start_;
  FitOptions fit_options_;
  int restarts_ = 0;
  Calibration out_;
};

}  // namespace

int Calibration::told() const {
  return static_cast<int>(
      std::count_if(parameters.begin(), parameters.end(),
                    [](const CalibratedParameter& parameter) { return parameter.told; }));
}

int least_rows(int parameters) { return std::max(4, parameters + 2); }

Calibration calibrate(const FitProblem& problem, const CalibrationOptions& options) {
  return Calibrator(problem, options).run();
}

}  // namespace prehensile
