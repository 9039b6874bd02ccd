/// Calibration: which parameters the data tell, how well, and how much better the model
/// then is on measurements that it was not fitted to. `robust_fit.h` does the fitting;
/// push_calibration.h says what is fitted to pushes and to readings of slip forces.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "primitives/robust_fit.h"

namespace prehensile {

struct CalibrationOptions {
  double level = 0.9;      ///< of the intervals, in (0, 1)
  int folds = 5;           ///< >= 2: each row is predicted once by a fit without its fold
  std::uint64_t seed = 1;  ///< of the folds
};

struct CalibratedParameter {
  double value = 0.0;
  Profile profile;  ///< with the interval; the others that the data tell fitted anew
  /// The interval is narrower than what was known before. If not, the value is that of
  /// the start (or the nearest that the data allow) and not fitted.
  bool told = false;
  int confused_with = -1;    ///< the parameter with which it can be exchanged, if any
  double correlation = 0.0;  ///< with that, -1..1
};

struct Calibration {
  std::vector<CalibratedParameter> parameters;
  Fit fit;  ///< to all rows
  /// Part by row, NaN where not measured: with the starting values, with the values of
  /// the fit, and by fits that did not see the row.
  Eigen::MatrixXd before, after, held_out;
  std::vector<int> fold;                 ///< of each row
  std::vector<Eigen::VectorXd> fold_at;  ///< the parameters fitted without each fold

  int told() const;
};

/// Rows that a fit of so many parameters needs at the very least.
int least_rows(int parameters);

/// The problem must have at least `least_rows` rows.
Calibration calibrate(const FitProblem& problem, const CalibrationOptions& options = {});

}  // namespace prehensile
