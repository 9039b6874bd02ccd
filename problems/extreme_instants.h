/// Stiff and extreme planar instants: the random ones, pushed to the edge one way at a
/// time. Shared by tests and benchmarks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanics/instant.h"
#include "problems/random_instants.h"

namespace prehensile {

struct PlanarExtreme {
  std::string group;  ///< what is extreme: "friction", "mass", "grip", ...
  std::string name;   ///< unique
  std::function<void(RandomInstant&)> apply;
  InstantRange range = {};  ///< of the random instants; points_per_pad is overridden
  /// What every correct answer is, where theory says so; empty: nothing is known.
  std::function<bool(const PlanarInstant&)> expected = {};
};

/// All of them: frictions, masses, grip forces, sizes, rates and accelerations over the
/// ranges that the software claims, pads down to a point, contacts that coincide,
/// pushers that graze, thresholds of sticking and holding at 1 -/+ 1e-6, and numbers too
/// small to be normal.
std::vector<PlanarExtreme> planar_extremes();

/// One instant of an extreme.
RandomInstant extreme_instant(const PlanarExtreme& extreme, std::uint64_t seed,
                              std::uint64_t index, int points_per_pad);

}  // namespace prehensile
