/// A second opinion: a plan replayed by MuJoCo, with the same contact points and none of
/// the mechanics here. It knows the scene, where each push moves the hand, and what the
/// plan says the outcome is.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "planner/plan.h"

namespace prehensile::mjcf {

struct MujocoOptions {
  double speed = 0.0;  ///< [m/s] of the pad point that rubs most; 0: see `stage`
  /// Called after every push with its index; may be empty.
  std::function<void(int)> on_push;
};

/// What MuJoCo makes of one push. The object goes on from where its own push before left
/// it; the hand goes where the plan says.
struct MujocoPush {
  Grasp end;
  double position_error = kNan;  ///< [m] end against the plan's
  double angle_error = kNan;     ///< [rad] roll included
  /// The same of the object's motion in this push alone: what it adds to the errors of
  /// the pushes before.
  double position_added = kNan;
  double angle_added = kNan;
  double peak_force =
      kNan;  ///< [N] greatest push force, averaged over 50 ms or 2 % of it
  double force_error = kNan;   ///< relative to the plan's greatest push force
  double out_of_plane = kNan;  ///< [m] of O from the middle between the jaws, at the end
  double tilt = kNan;          ///< [rad] of the object out of the pad plane, at the end
  double seconds = kNan;       ///< simulated, approach included
  std::string trouble;         ///< what MuJoCo warned of; empty: nothing
};

struct MujocoReplay {
  std::vector<MujocoPush> pushes;
  double speed = kNan;     ///< [m/s] that was used
  bool overhangs = false;  ///< the pads overhang: points are lost whole there
  bool in_space = false;   ///< the loads of the pads shift
};

/// Throws NotCarried (mjcf/stage.h), and where this build has no MuJoCo (`has_mujoco`)
/// std::runtime_error.
MujocoReplay mujoco_replay(const Model& model, const Plan& plan,
                           const MujocoOptions& options = {});

/// Loads a text and makes a step from each key frame; empty, or what is wrong.
std::string load_error(const std::string& mjcf_text);

bool has_mujoco();

/// "2.2.2"; empty without MuJoCo.
std::string mujoco_version();

}  // namespace prehensile::mjcf
