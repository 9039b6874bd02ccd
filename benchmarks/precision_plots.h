/// Work-precision plots and performance profiles of solver runs.
#pragma once

#include <string>
#include <vector>

namespace prehensile::benchmarks {

/// One solver with one discretisation on one instant.
struct PrecisionRun {
  std::string set;          ///< "planar", "spatial 0.1" or "spatial 10": acceleration
  std::string solver;       ///< "exact", "closed form", "ipopt", ...
  int points = 0;           ///< per pad; 0: none
  int generators = 0;       ///< 0: circular cones
  double compliance = 0.0;  ///< of foundations in V0 / F0; 0: rigid limit or planar
  int instance = 0;
  bool asked = false;   ///< the reference has one answer
  bool solved = false;  ///< by the run's own laws
  double residual = 0.0;
  double force_error = 0.0;  ///< against the reference, over the capacity of the pads
  double twist_error = 0.0;  ///< against the reference, over the push rate
  double time_us = 0.0;
};

/// Runs of one solver and discretisation.
struct PrecisionPoint {
  PrecisionRun example;  ///< set, solver, points, generators, compliance
  int asked = 0;
  int solved = 0;
  double residual = 0.0;  ///< worst of those solved
  double force_median = 0.0, force_p95 = 0.0, twist_median = 0.0, twist_p95 = 0.0;
  double time_median = 0.0;  ///< [us]

  double failed() const { return asked > 0 ? 1.0 - double(solved) / asked : 0.0; }
};

/// In the order of their first runs; of the runs that were asked.
std::vector<PrecisionPoint> points_of(const std::vector<PrecisionRun>& runs);

/// Error (larger of force and twist) against time, log-log: a line per solver and what it
/// varies; solid the 95th percentile, dotted the median.
std::string work_precision_svg(const std::vector<PrecisionPoint>& points,
                               const std::string& set);

/// Dolan and More 2002: for each solver the share of instants that it solves within a
/// factor of the time of the fastest. Instants of `set` with this many points per pad,
/// foundations of `compliance`, circular cones or `generators`.
struct ProfileQuestion {
  std::string set;
  int points = 4;
  double compliance = 1e-2;
  int generators = 8;
};
std::string profile_svg(const std::vector<PrecisionRun>& runs,
                        const ProfileQuestion& question);

}  // namespace prehensile::benchmarks
