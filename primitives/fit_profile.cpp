#include <algorithm>
#include <cmath>

#include "primitives/robust_fit.h"

namespace prehensile {
namespace {

/// Quantile of the normal distribution, by bisection of the complementary error function.
double normal_quantile(double share) {
  double low = -40.0;
  double high = 40.0;
  for (int i = 0; i < 100; ++i) {
    const double z = 0.5 * (low + high);
    (0.5 * std::erfc(-z / std::sqrt(2.0)) < share ? low : high) = z;
  }
  return 0.5 * (low + high);
}

/// Follows the profile from the best fit outwards to where it passes the limit.
class ProfileSide {
 public:
  ProfileSide(const FitProblem& problem, std::span<const int> rows, const Fit& best,
              int parameter, std::vector<bool> held, double limit)
      : problem_(problem),
        rows_(rows),
        best_(best),
        parameter_(parameter),
        held_(std::move(held)),
        limit_(limit) {
    if (held_.empty()) held_.resize(problem.parameters.size(), false);
    held_[static_cast<std::size_t>(parameter)] = true;
    near_ = best.at;
  }

  /// The end of the interval; `open` if the bound comes first.
  double end(double first_step, double bound, bool& open,
             std::vector<ProfilePoint>& points) {
    const double centre = best_.at[parameter_];
    const double direction = bound > centre ? 1.0 : -1.0;
    const double room = std::abs(bound - centre);
    double inner = 0.0, inner_rise = 0.0;
    double outer = std::min(room, std::max(first_step, 1e-6 * room));
    open = false;
    if (room <= 0.0) {
      open = true;
      return bound;
    }
    double outer_rise = rise(centre + direction * outer, points);
    while (outer_rise < limit_ && outer < room) {
      inner = outer;
      inner_rise = outer_rise;
      outer = std::min(room, 2.0 * outer);
      outer_rise = rise(outer < room ? centre + direction * outer : bound, points);
    }
    if (outer_rise < limit_) {
      open = true;
      return bound;
    }
    // Near the fit rises are nearly parabolas, so their roots nearly straight; where a
    // rise begins late or jumps, halving finds it.
    constexpr int kMostSteps = 10;
    for (int i = 0; i < kMostSteps; ++i) {
      const double a = std::sqrt(std::max(0.0, inner_rise));
      const double b = std::sqrt(outer_rise);
      double share = std::clamp((std::sqrt(limit_) - a) / (b - a), 0.05, 0.95);
      if (i % 2 == 1) share = 0.5;
      const double at = inner + share * (outer - inner);
      const double here = rise(centre + direction * at, points);
      (here < limit_ ? inner : outer) = at;
      (here < limit_ ? inner_rise : outer_rise) = here;
      if (std::abs(here - limit_) < 0.05 * limit_) return centre + direction * at;
      if (outer - inner < 0.02 * outer) break;
    }
    return centre + direction * outer;
  }

  /// Points at equal distances from the best fit to `last`.
  void sample(double last, int count, std::vector<ProfilePoint>& points) {
    const double centre = best_.at[parameter_];
    near_ = best_.at;
    for (int i = 1; i <= count; ++i) {
      rise(centre + (last - centre) * i / count, points);
    }
  }

 private:
  double rise(double value, std::vector<ProfilePoint>& points) {
    Eigen::VectorXd start = near_;
    start[parameter_] = value;
    const Fit there = fit(problem_, rows_, start, held_,
                          {.max_iterations = 8, .tolerance = 1e-2, .try_others = false});
    near_ = there.at;
    const double up = there.objective - best_.objective;
    points.push_back({value, up, near_});
    return up;
  }

  const FitProblem& problem_;
  std::span<const int> rows_;
  const Fit& best_;
  int parameter_;
  std::vector<bool> held_;
  double limit_;
  Eigen::VectorXd near_;
};

void sort_points(Profile& profile) {
  std::sort(
      profile.points.begin(), profile.points.end(),
      [](const ProfilePoint& a, const ProfilePoint& b) { return a.value < b.value; });
}

}  // namespace

Profile profile(const FitProblem& problem, std::span<const int> rows, const Fit& best,
                int parameter, const std::vector<bool>& held, const FitCovariance& spread,
                const FitOptions& options) {
  const FitParameter& p = problem.parameters[static_cast<std::size_t>(parameter)];
  const int used = static_cast<int>(held.empty() ? problem.parameters.size()
                                                 : static_cast<std::size_t>(std::count(
                                                       held.begin(), held.end(), false)));
  const int freedom = std::max(3, static_cast<int>(rows.size()) - used);
  const double t = student_quantile(0.5 + 0.5 * options.level, freedom);
  const double spent =
      static_cast<double>(rows.size()) / std::max(1.0, static_cast<double>(freedom));
  double widened = spent;
  const double by_model = spread.by_model(parameter, parameter);
  const double by_scatter = spread.by_scatter(parameter, parameter);
  if (by_model > 0.0 && std::isfinite(by_scatter)) {
    widened *= std::max(1.0, by_scatter / by_model);
  }
  Profile out;
  out.limit = 0.5 * t * t * widened;
  double first = t * std::sqrt(std::max(by_scatter, by_model));
  if (!(first > 0.0) || !std::isfinite(first)) first = 0.1 * (p.high - p.low);
  const double centre = best.at[parameter];
  bool& open_low = out.interval.open_low;
  bool& open_high = out.interval.open_high;
  out.interval.low = ProfileSide(problem, rows, best, parameter, held, out.limit)
                         .end(first, p.low, open_low, out.points);
  out.points.push_back({centre, 0.0, best.at});
  out.interval.high = ProfileSide(problem, rows, best, parameter, held, out.limit)
                          .end(first, p.high, open_high, out.points);
  sort_points(out);
  return out;
}

void sample_profile(const FitProblem& problem, std::span<const int> rows, const Fit& best,
                    int parameter, const std::vector<bool>& held, Profile& profile) {
  constexpr int kPoints = 8;  // of each side
  constexpr double kBeyond = 0.3;
  const FitParameter& p = problem.parameters[static_cast<std::size_t>(parameter)];
  const FitInterval& interval = profile.interval;
  const double beyond = kBeyond * interval.half_width();
  profile.points = {{best.at[parameter], 0.0, best.at}};
  ProfileSide side(problem, rows, best, parameter, held, profile.limit);
  side.sample(std::max(p.low, interval.low - beyond), kPoints, profile.points);
  side.sample(std::min(p.high, interval.high + beyond), kPoints, profile.points);
  sort_points(profile);
  // A rough model lets a fit end a little above its least: rises count from there.
  double least = 0.0;
  for (const ProfilePoint& point : profile.points) least = std::min(least, point.rise);
  for (ProfilePoint& point : profile.points) point.rise -= least;
}

double student_quantile(double share, int freedom) {
  const double z = normal_quantile(share);
  const double n = freedom;
  const double z2 = z * z;
  const double g1 = z * (z2 + 1.0) / 4.0;
  const double g2 = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 =
      z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

}  // namespace prehensile
