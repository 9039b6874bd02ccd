/// The planar regrasps of a published comparison of in-hand planners (Perugini, Lundell,
/// Friedl, Kragic, "Pushing Everything Everywhere All At Once", RA-L 2025): a square and
/// a T of 0.1 m among three walls. The 50 pairs of start and goal are drawn from its
/// ranges.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace prehensile {

inline constexpr int kPublishedRegrasps = 50;

/// Problem `index` in [0, kPublishedRegrasps) with the square or the T.
///
/// Walls with friction 0.9 touch the faces towards -x, -y and +y; gravity along -y of O
/// for all of them; 0.5 kg; finger friction 0.9; 25 N per finger (the published 50 N
/// counts once); disc pads of 9 mm radius, whose torque radius is the published 0.6 x 10
/// mm; overhanging pads count whole; goal test: distance + 0.01 m/rad x angle <= 1 mm.
Scene published_square(int index);
Scene published_tee(int index);

/// The scene with soft points for pads instead of its discs, of their torque radius: the
/// ellipsoid as limit surface, as in that comparison. Other pads stay.
Scene with_soft_points(Scene scene);

/// Where problems beyond the 50 pairs are drawn from.
enum class RegraspRange {
  kPublished,  ///< the ranges of the comparison: goals left of the starts, +-0.2 rad
  kWide,       ///< start and goal anywhere on the object, at any angle
};

/// A random problem with the same object ("square" or else the T), walls, hand and goal
/// test; gravity along -y of O, or none. Start and goal are places where the pads alone
/// hold gravity over the default margin. Deterministic: (range, seed, index) names it.
Scene random_among_walls(bool square, RegraspRange range, bool gravity,
                         std::uint64_t seed, std::uint64_t index);

}  // namespace prehensile
