/// Runs of the spatial solvers on random instants, measured and judged alike: what the
/// benchmarks of spatial instants share.
#pragma once

#include <cstdint>
#include <string>

#include "benchmarks/converged.h"
#include "benchmarks/natural_map.h"
#include "benchmarks/siconos_peer.h"
#include "mechanics/spatial_instant.h"
#include "mechanics/spatial_reference.h"
#include "problems/random_spatial.h"

namespace prehensile::benchmarks {

inline constexpr double kSuccess = 1e-6;  ///< residual of a run that counts as solved
inline constexpr int kSeconds = 20;       ///< that a peer may take

/// One solver on one instant.
struct SpatialRun {
  const char* solver;
  int generators = 0;  ///< 0: circular
  int points = 0;
  double acceleration = 0.0;
  int instance = 0;
  const char* reference_status = "";
  bool asked = false;  ///< the exact solver has one answer
  bool success = false;
  double force_error = kNan;  ///< of the push force, in capacities of the pads
  double twist_error = kNan;  ///< in push rates, turns by 1 cm
  double residual = kNan;
  /// Distance to the answer that Newton's method in long double finds from this one, the
  /// larger of force and twist, in the same units; set by `measure_distance`.
  double distance = kNan;
  double least_gain = kNan;  ///< see ConvergedAnswer
  SpatialAnswer answer;      ///< of circular cones
  double time_us = kNan;
  int iterations = 0;
};

/// What an answer is compared with.
struct SpatialTruth {
  InstantStatus status = InstantStatus::kNotRun;
  SpatialTwist V_HO = SpatialTwist::Zero();
  SpatialWrench w_push = SpatialWrench::Zero();
};

/// An instant posed with its units: 1 cm, the grip force or the weight, and the rate of
/// the push.
struct SpatialQuestion {
  SpatialProblem problem;
  SpatialScales units;
  double capacity;  ///< of both pads [N]
  SpatialTruth truth;
};

/// `problem` with its exact answer as truth.
SpatialQuestion posed(const SpatialProblem& problem);

/// Moves the truth to what Newton's method in long double makes of it; without effect
/// where that does not converge, or where there is no motion.
void sharpen_truth(SpatialQuestion& q);

/// For runs on circular cones that gave an answer.
void measure_distance(const SpatialQuestion& q, SpatialRun& run);

/// Larger of the errors of push force [capacities] and twist [push rates], turns by 1 cm.
double difference(const SpatialQuestion& q, const SpatialAnswer& a,
                  const SpatialAnswer& b);

/// `batches`: see time_us.
SpatialRun exact_run(const SpatialQuestion& q, int batches,
                     const SpatialSolveOptions& options = {});
SpatialRun pivoting_run(const SpatialQuestion& q, int generators);
SpatialRun ipopt_run(const SpatialQuestion& q, int generators);
SpatialRun siconos_run(const SpatialQuestion& q, SiconosSolver solver);

}  // namespace prehensile::benchmarks
