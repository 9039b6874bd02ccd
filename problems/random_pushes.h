/// Random pushes for tests and benchmarks: boxes in any attitude to gravity, held off
/// their centre and pushed at one face. Deterministic: (seed, index) names a push.
#pragma once

#include <cstdint>

#include "primitives/push.h"

namespace prehensile {

struct RandomPush {
  Scene scene;  ///< one pusher, `scene.start` is the start of the push
  LinearPush push;
};

/// What is drawn. Boxes of half-sides 20-60 mm and 0.05-0.5 kg; disc pads of radius 4-12
/// mm or rectangles of such sides, fingers alike with friction 0.3-0.9 (the mean of two
/// draws), grip 10-60 N, the finger axis
/// in the middle half of the box; a point, a line of 10-50 mm or a wall with friction
/// 0.1-0.9; a push of 2-30 mm within 60 degrees of the face's normal, half of them
/// turning by up to 0.5 rad. Half the pads are clipped where they overhang. Some of these
/// grasps do not hold gravity, at the start or later.
RandomPush random_push(std::uint64_t seed, std::uint64_t index);

/// The same push in space: fingers that differ (0.3-0.9 each), a box 10-40 mm thick,
/// gravity in any direction, the centre of mass off the mid-plane by up to 3 mm, and at
/// any height of the face a point or a line, or an upright edge or a plane of 4-20 mm
/// along the closing direction. Two scenes of ten have one jaw that stands still.
RandomPush random_spatial_push(std::uint64_t seed, std::uint64_t index);

}  // namespace prehensile
