/// What the answers about both kinds of cross-section have in common. Internal to
/// cross_section.cpp and prism_instant.cpp.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "mechanics/cross_section.h"

namespace prehensile {

/// Units of a section in which its solver works.
struct SectionUnits {
  double force = 1.0;   ///< [N]
  double rate = 1.0;    ///< [m/s]
  double length = 1.0;  ///< [m]
};

/// Of (v_z, v_u, roll rate, jaw rate).
inline CrossSectionMotion in_si(const std::array<double, 4>& v,
                                const SectionUnits& units) {
  return {v[0] * units.rate, v[1] * units.rate, v[2] * units.rate / units.length,
          v[3] * units.rate};
}

/// `Forces` has arrays `normal` and `tangential`.
template <class Forces>
Forces in_si(Forces forces, const SectionUnits& units) {
  for (double& f : forces.normal) f *= units.force;
  for (double& f : forces.tangential) f *= units.force;
  return forces;
}

/// The solution to report first: the one that turns most, so that a caller who wants to
/// roll sees it; the first of those that turn alike, to within `same`.
template <class Solutions>
void put_fastest_first(Solutions& solutions, double same) {
  int best = 0;
  for (int i = 1; i < solutions.count; ++i)
    if (std::abs(solutions.found[i].motion[2]) >
        std::abs(solutions.found[best].motion[2]) + same)
      best = i;
  std::swap(solutions.found[0], solutions.found[best]);
}

}  // namespace prehensile
