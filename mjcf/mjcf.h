/// A scene and its pushes as one MJCF file, ready to load in MuJoCo (2.2 or later): the
/// contact points of the mechanics here, with contact settings under which MuJoCo's soft
/// contacts come close to rigid Coulomb friction (docs/mujoco.md).
///
/// Frames and units: MuJoCo's world is W of the scene, z up is the closing direction; SI,
/// radians; quaternions are w, x, y, z. `qpos` holds the hand (x, y, z of H in W, and
/// its angle about z), then each pad point along its own slide (0: where it touches),
/// then the object (x, y, z, quaternion of O in W). `ctrl` is the grip force of each
/// finger.
///
/// One key frame per push: the object flush with the pusher, and the hand, which weighs
/// so much that nothing stops it, coasting along the straight push for as long as the
/// numeric `push_<k>_seconds` says.
#pragma once

#include <string>
#include <string_view>

#include "mjcf/stage.h"

namespace prehensile::mjcf {

/// The text. Without pushes: one key frame, the start of the scene at rest.
std::string document(const Stage& stage);

/// `document` for others to run: throws NotCarried also for pushes along arcs, which a
/// coasting hand does not follow.
std::string file_text(const Model& model, const std::vector<PlannedPush>& pushes);

/// What the bodies and joints are called. Pushers: kPusherPrefix and their name.
inline constexpr std::string_view kPusherPrefix = "pusher_";
inline constexpr std::string_view kObject = "object";
inline constexpr int kHandJoints = 4;  ///< the first of qpos: x, y, z, angle about z

}  // namespace prehensile::mjcf
