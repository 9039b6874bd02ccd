/// Where hand, pads and object are, and how they move, when a push begins. Internal to
/// mjcf.
#pragma once

#include "mjcf/elements.h"
#include "mjcf/stage.h"

namespace prehensile::mjcf {

/// `keyframe` and, for how long the hand coasts, `custom`. Without pushes: the start of
/// the scene, at rest.
void write_key_frames(XMLElement* root, const Stage& stage);

}  // namespace prehensile::mjcf
