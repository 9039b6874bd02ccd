/// Random regrasps that are feasible by construction: the goal is where a random sequence
/// of sticking pushes (and a roll) ends, each checked with the exact pads over the
/// default margin. Deterministic: (family, seed, index) names a problem.
#pragma once

#include <cstdint>

#include "primitives/push.h"

namespace prehensile {

enum class RegraspFamily {
  kBox,       ///< disc pads on a box of random size
  kTee,       ///< disc pads on a T of random proportions
  kCylinder,  ///< pads that touch a can along a line; the goal may ask for a roll
};

/// A scene with a goal, and the pushes that reach it.
struct RandomRegrasp {
  Scene scene;
  std::vector<Push> pushes;  ///< 1 to 5 of at least 5 mm, and at most one roll
  int pushers = 0;           ///< distinct pushers among the pushes in the pad plane
};

/// Sizes 40-150 mm, mass 0.05-0.6 kg (log-uniform), friction 0.3-1 of fingers and
/// pushers, fingers that could carry 1.5-10 times the weight (log-uniform), pads of 5-12
/// mm radius, 2 to 4 line pushers on different faces, gravity in any direction (a can:
/// onto one of its long sides) or, for one in ten, none. Even indices use at least two
/// pushers.
RandomRegrasp random_regrasp(RegraspFamily family, std::uint64_t seed,
                             std::uint64_t index);

}  // namespace prehensile
