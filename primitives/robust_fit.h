/// Parameters of a model from measurements that hold outliers, with intervals and with a
/// word where the data cannot tell.
///
/// Residuals of each part (say normal, tangential, angle) are taken as draws from a
/// Student t distribution of 4 degrees of freedom and of a scale of its own, which is
/// estimated too; the likelihood is maximised by a damped Gauss-Newton method with
/// numerical derivatives (iteratively reweighted least squares: Lange, Little, Taylor,
/// JASA 84, 1989). Intervals are those of the profile likelihood, widened by what the
/// scatter of the rows says beyond the model ("sandwich", clustered by row: the parts of
/// a row are not independent). Nothing is drawn at random; same input, same answer.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace prehensile {

struct FitParameter {
  std::string name;
  double start = 0.0;
  double low = 0.0, high = 0.0;  ///< range, low < high, holds `start`
  double step = 0.0;             ///< > 0, for differences: well above the model's noise
  /// Half width of the interval that is known without data, > 0: less than that has to
  /// be learnt for the data to count.
  double known = std::numeric_limits<double>::infinity();
  std::vector<double> tries;  ///< further values at which the search may begin
};

struct FitProblem {
  std::vector<FitParameter> parameters;
  int rows = 0;
  std::vector<double> resolution;  ///< > 0, one per part: no scale is less
  /// Fills out(part, i) with measured minus predicted of rows[i] at these parameters;
  /// NaN where nothing was measured (the same places for all parameters). `out` has its
  /// size. Must not depend on which other rows are asked for.
  std::function<void(const Eigen::VectorXd& at, std::span<const int> rows,
                     Eigen::MatrixXd& out)>
      residuals;

  int parts() const { return static_cast<int>(resolution.size()); }
};

struct FitOptions {
  int max_iterations = 30;
  double tolerance = 1e-3;  ///< decrease of the negative log likelihood that ends it
  double level = 0.9;       ///< of the intervals, in (0, 1)
  bool try_others = true;   ///< look at FitParameter::tries before descending
};

/// The best parameters.
struct Fit {
  Eigen::VectorXd at;
  std::vector<double> scale;  ///< of each part; NaN: nothing measured
  double objective = 0.0;     ///< negative log likelihood but for a constant
  int evaluations = 0;        ///< of all rows
};

/// One end of an interval reaches a bound of the range: the data set no limit there.
struct FitInterval {
  double low = 0.0, high = 0.0;
  bool open_low = false, open_high = false;
  double half_width() const { return 0.5 * (high - low); }
};

/// A point of a profile likelihood: the value, and by how much the negative log
/// likelihood rises over its least, the others fitted anew; the interval ends where that
/// reaches `limit` of the profile.
struct ProfilePoint {
  double value = 0.0, rise = 0.0;
  Eigen::VectorXd at;  ///< all parameters there
};
struct Profile {
  FitInterval interval;
  double limit = 0.0;
  std::vector<ProfilePoint> points;  ///< ascending in value
};

/// Fits the parameters that are not `held` (empty: none is) to the rows given; the held
/// ones stay at `start`, of all of which the search begins.
Fit fit(const FitProblem& problem, std::span<const int> rows,
        const Eigen::VectorXd& start, const std::vector<bool>& held,
        const FitOptions& options = {});

/// Starting values of all parameters.
Eigen::VectorXd start_of(const FitProblem& problem);

/// Covariance of the parameters that are not held; zero for the held ones. A parameter
/// without influence has a variance of about (1000 known)^2.
struct FitCovariance {
  Eigen::MatrixXd by_scatter;  ///< of the rows about the model; small, not large, where
                               ///< a parameter has no influence
  Eigen::MatrixXd by_model;    ///< inverse of the likelihood's curvature
};
FitCovariance covariance(const FitProblem& problem, std::span<const int> rows,
                         const Fit& best, const std::vector<bool>& held);

/// Profile of one parameter about the best fit.
Profile profile(const FitProblem& problem, std::span<const int> rows, const Fit& best,
                int parameter, const std::vector<bool>& held, const FitCovariance& spread,
                const FitOptions& options = {});

/// Replaces the points by ones at equal distances, from the best fit to a little beyond
/// both ends of the interval, with rises over the least of them: for a picture, as the
/// search for the ends looks there, in no order and hardly elsewhere.
void sample_profile(const FitProblem& problem, std::span<const int> rows, const Fit& best,
                    int parameter, const std::vector<bool>& held, Profile& profile);

/// Quantile of Student's t, share in (0, 1), freedom >= 3; within 1 % (expansion of
/// Abramowitz and Stegun 26.7.5).
double student_quantile(double share, int freedom);

}  // namespace prehensile
