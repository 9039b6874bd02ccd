/// Stiff and extreme spatial instants: the random ones, pushed to the edge one way at a
/// time. Shared by tests and benchmarks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanics/spatial_instant.h"
#include "problems/random_spatial.h"

namespace prehensile {

struct SpatialExtreme {
  std::string group;  ///< what is extreme: "friction", "mass", "grip", ...
  std::string name;   ///< unique
  std::function<void(SpatialProblem&)> apply;
  double allowed = 0.01;       ///< share of instants that may run out of iterations
  double acceleration = -1.0;  ///< [m/s^2]; below 0: as asked
  /// What every correct answer is, where theory says so; empty: nothing is known.
  std::function<bool(const SpatialInstant&)> expected = {};
};

/// All of them: frictions, masses, grip forces, sizes, rates and accelerations over the
/// ranges that the software claims, pads down to a point, contacts that coincide or have
/// all but parallel normals, pushers that graze, wedges against a fixed jaw, thresholds
/// at 1 -/+ 1e-6, and numbers too small to be normal.
std::vector<SpatialExtreme> spatial_extremes();

/// One instant of an extreme.
SpatialProblem extreme_spatial(const SpatialExtreme& extreme, std::uint64_t seed,
                               std::uint64_t index, int points_per_pad,
                               double acceleration);

}  // namespace prehensile
