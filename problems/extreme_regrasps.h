/// Stiff and extreme regrasps: random ones that pushes can make, pushed to the edge one
/// way at a time. Shared by tests and benchmarks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "problems/random_regrasps.h"

namespace prehensile {

/// What theory says about a problem.
enum class Outlook {
  kUnknown,
  kHasPlan,  ///< the pushes that made it still do
  kHasNone,
  kIsThere,  ///< the start is a goal
};

inline bool must_be_solved(Outlook outlook) {
  return outlook == Outlook::kHasPlan || outlook == Outlook::kIsThere;
}

struct RegraspExtreme {
  std::string group;  ///< what is extreme: "tolerance", "friction", "pushers", ...
  std::string name;   ///< unique
  /// Changes a scene whose goal is where random pushes end: those by lines stick with the
  /// exact pads over the default margin, those by points are followed by the mechanics.
  std::function<Outlook(Scene&)> apply;
};

/// All of them: tolerances from 1e-2 to 1e-6 m, frictions from 0 to 1000, up to 64
/// pushers, slivers, needles and outlines of many vertices, pads from 1e-6 m up to the
/// size of the object and beyond, gravity at the limit of the grip, sizes from 1/1000 to
/// 10 times, starts that are goals, goals that are far away or many turns off, and
/// numbers too small to be normal.
std::vector<RegraspExtreme> regrasp_extremes();

struct ExtremeRegrasp {
  Scene scene;
  Outlook outlook = Outlook::kUnknown;
};

/// One problem of an extreme. The objects take turns: boxes, Ts, convex and concave
/// polygons among walls, boxes among points.
ExtremeRegrasp extreme_regrasp(const RegraspExtreme& extreme, std::uint64_t seed,
                               std::uint64_t index);

}  // namespace prehensile
