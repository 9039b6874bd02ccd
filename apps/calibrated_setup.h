/// A set-up calibrated on measurements: the fit, what it is worth, and the scene with its
/// numbers.
#pragma once

#include <string>
#include <vector>

#include "io/measurements.h"

namespace prehensile::apps {

struct CalibrateOptions {
  PressureFit pressure = PressureFit::kEdgeLoad;
  bool registration = true;
  double level = 0.9;  ///< of the intervals
  int folds = 5;
  std::uint64_t seed = 1;
  int samples = 60;  ///< of the box of what stayed uncertain, for each measured push
  int jobs = 1;
};

/// Fewer pushes than the second are a weak calibration, fewer than the first none; from
/// 4,806 pushes of plates, calibrated on so many and tested on the rest.
inline constexpr int kWeakCalibration = 10;
inline constexpr int kRealCalibration = 20;

struct CalibratedSetup {
  Scene before, after;  ///< `after` with its CalibrationRecord
  SceneFit fit;
  Calibration calibration;
  Measurements data;
  CalibrateOptions options;
  int misses = 0;                        ///< pushes whose path meets no face
  int scored = 0;                        ///< pushes behind the factors of intervals
  double c_before = 0.0, c_after = 0.0;  ///< [m] torque radius of the pads
  double k = 1.0;  ///< torque radius over that of the same pads under uniform pressure
  std::vector<std::string> warnings;

  bool is_of_pushes() const { return !data.pushes.empty(); }
  /// Mean absolute held-out errors are smaller than those of the scene as it was.
  bool is_better = false;
  bool is_usable() const { return is_better && calibration.told() > 0; }
};

/// Mean of the absolute values of a row of residuals that were measured; NaN: none was.
double mean_error(const Eigen::MatrixXd& residuals, int part);

/// Throws BadInput for too few measurements.
CalibratedSetup calibrate_setup(const Scene& scene, Measurements data,
                                const std::string& source,
                                const CalibrateOptions& options);

}  // namespace prehensile::apps
