/// What measured pushes and slip-force readings can say about a scene: the parameters,
/// the fitting problem, and the scene with the answers in it.
///
/// A push without a measured force is blind to a common factor on all friction in the
/// grasp: the pads' friction is fitted only where forces were measured. How the object
/// moves tells the friction of the pusher, the pressure (by the torque radius), and where
/// the pusher really is.
#pragma once

#include <vector>

#include "primitives/calibration.h"
#include "primitives/measured_push.h"

namespace prehensile {

/// How the spread of the pads' pressure is described.
enum class PressureFit {
  kNone,          ///< as in the scene
  kEdgeLoad,      ///< PadPressure::edge_load
  kTorqueRadius,  ///< pads larger or smaller by a factor k
};

enum class Target {
  kPusherFriction,
  kFingerFriction,  ///< mean of both jaws; their ratio stays
  kEdgeLoad,
  kTorqueRadius,   ///< the factor k
  kRegistrationX,  ///< [m] in H: to be added to the pusher's measured places
  kRegistrationY,
  kForceBias,  ///< [N] of readings of slip forces: reading minus friction force
};

struct CalibrationTarget {
  Target target;
  int pusher = -1;  ///< of kPusherFriction: index in Scene::pushers
};

/// One number that was measured with the force (and torque) at which the object slips in
/// the grasp.
struct SlipReading {
  double grip_force = 0.0;            ///< [N] of each finger, > 0
  std::optional<double> slip_force;   ///< [N], > 0, of a pull through the finger axis
  std::optional<double> slip_torque;  ///< [N m], > 0, of a pure turn about it
};

/// A fitting problem, and what its parameters are. The problem refers to this object's
/// data, which is shared: copies are cheap and may outlive it.
struct SceneFit {
  std::vector<CalibrationTarget> targets;
  FitProblem problem;
  std::vector<std::string> parts;  ///< of the residuals
};

struct SceneFitOptions {
  PressureFit pressure = PressureFit::kEdgeLoad;
  bool registration = true;
  TransitionOptions transition{.tolerance = 1e-5};
  int points_per_pad = 16;
  /// Calls work(i) for each i < count, each once, in any order: threads, if any, are the
  /// caller's. Unset: one after the other.
  std::function<void(int count, const std::function<void(int)>& work)> for_each;
};

/// Residual parts: along the pusher's path [m], across it [m], angle [rad] and, where a
/// force was measured, log of measured over predicted. Throws BadScene.
SceneFit push_fit(const Scene& scene, const std::vector<MeasuredPush>& pushes,
                  const SceneFitOptions& options = {});

/// Residual parts: logs of measured over predicted force and torque.
SceneFit slip_fit(const Scene& scene, const std::vector<SlipReading>& readings);

/// The scene with these values of the parameters; registration and bias are no part of a
/// scene.
Scene with_values(const Scene& scene, const std::vector<CalibrationTarget>& targets,
                  const Eigen::VectorXd& at);

/// [m] registration among these values; zero if none is.
Vec2 registration_of(const std::vector<CalibrationTarget>& targets,
                     const Eigen::VectorXd& at);

}  // namespace prehensile
