/// A scene and pushes as a general physics engine has to see them: where the hand goes,
/// which contact points there are, and what cannot be carried over.
///
/// Everything is told in the world W of the scene, where the pushers stand still and the
/// hand moves; z is the closing direction. Nothing here asks how the object will move.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "planner/plan.h"

namespace prehensile::mjcf {

/// The scene or a push asks for what the engine's model cannot tell; says which field or
/// push, its value and what was expected.
class NotCarried : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Of H in W.
struct HandPose {
  PlanarPose X_WH;
  double z = 0.0;  ///< [m] along the closing direction: rolls move the hand there
};

/// Where the hand is at the share s of a push, 0 before it begins. `gap` [m]: as far back
/// along the normal of the pusher.
HandPose hand_at(const Model& model, const PlannedPush& planned, double s,
                 double gap = 0.0);

/// Attitude of the object in W: turned about z, and rolled about its own long axis.
Eigen::Quaterniond attitude(const Model& model, double theta, double psi);

/// [m] path of the pad point that rubs most, if the object rides on the pusher.
double rubbed_path(const Model& model, const Push& push);

struct Stage {
  const Model* model = nullptr;  ///< outlives the stage
  std::vector<PlannedPush> pushes;
  std::vector<int> contacts;  ///< of pushes; where there are none, all; in order
  std::vector<double> psi;    ///< [rad] roll of the object, by contact
  ContactPoints points;       ///< of each pad, in H
  bool overhangs = false;     ///< a pad leaves the face in part, and the scene clips it
  bool in_space = false;      ///< loads of the pads shift
  double stiffness = 0.0;     ///< [N/m] of the springs behind a pad, all points together
  double speed = 0.0;         ///< [m/s] of the pad point that rubs most
};

/// `speed` 0: 2 mm/s, 0.2 mm/s where loads shift. Throws NotCarried, also for a speed at
/// which the pushes would take for ever.
Stage stage(const Model& model, const std::vector<PlannedPush>& pushes,
            double speed = 0.0);

/// [s] that a push takes at the speed of the stage.
double seconds_of(const Stage& stage, const PlannedPush& planned);

/// The face runs along the axis of a lying cylinder: the line where it is lowest.
bool is_round_side(const Model& model, const PushContact& contact);

}  // namespace prehensile::mjcf
