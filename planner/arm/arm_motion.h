/// What the robot has to do for a plan: poses of hand and tool against the fixed pushers,
/// grip force and expected loads over time.
///
/// The pushers stand still in W and the hand moves: X_WH(t) = X_WP * inverse(X_HP(t)). A
/// push is a straight move in the frame of the pusher, as its mechanics assumes: the
/// finger axis runs on a straight line in P while the hand turns at a rate proportional
/// to its speed. Joint-space or hand-frame interpolation between the ends is another
/// motion. Every phase starts and ends at rest with bounded speed and acceleration.
///
/// W as in the scene: z along the closing direction, the object's mid-plane at z = 0.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "planner/plan.h"

namespace prehensile {

/// How fast and how far; all > 0. Speeds and accelerations are those that neither the
/// hand's origin nor the tool's exceeds.
struct ArmLimits {
  double push_speed = 0.02;        ///< [m/s]
  double approach_speed = 0.03;    ///< [m/s] also of the retreat
  double transit_speed = 0.10;     ///< [m/s] between two placements
  double acceleration = 0.2;       ///< [m/s^2]
  double turn_speed = 0.5;         ///< [rad/s]
  double turn_acceleration = 2.0;  ///< [rad/s^2]
  double clearance = 0.03;         ///< [m] from the pusher before and after a placement
  double grip_seconds = 0.5;       ///< [s] that a change of the grip force takes
  double rate = 100.0;             ///< [Hz] of the samples; each phase ends on a sample
  /// Longer motions are only counted, not sampled.
  std::int64_t most_samples = 1'000'000;
  double guard_factor = 1.5;  ///< guard over greatest expected load, see ArmSample
};

enum class ArmPhase {
  kTransit,   ///< between two placements, on a straight line, or in straight parts around
              ///< obstacles: the robot may go another way
  kApproach,  ///< along the normal of the pusher until it touches
  kGrip,      ///< the hand stands still, the grip force changes
  kPush,
  kRetreat,  ///< back along the normal
};
std::string_view name(ArmPhase phase);

struct ArmPose {
  Vec3 position = Vec3::Zero();  ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

struct ArmSample {
  double t = 0.0;  ///< [s]
  ArmPhase phase = ArmPhase::kTransit;
  int push = 0;             ///< index of the push; of a transit: of the one to come
  ArmPose X_WH, X_WT;       ///< hand and tool
  double grip_force = 0.0;  ///< [N] of each finger
  /// Load on the tool by the object, quasi-static: push and weight of the object, not of
  /// the gripper. In T, moments about the origin of T.
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< [N m]
  /// [N] A greater force means that something is wrong. One for each phase: at a pusher
  /// it covers the loads of the pushes just before and after, too.
  double guard_force = 0.0;
};

struct ArmMotion {
  std::vector<ArmSample> samples;  ///< none where they would be more than most_samples
  double seconds = 0.0;            ///< [s] of the whole
  bool is_too_long = false;
  /// Indices of pushes before which no transit was found on which hand and object keep
  /// clear of obstacles, the hand within its limits and the object in its place; a
  /// straight one is written.
  std::vector<int> blocked_transits;
};

/// The share of a rest-to-rest motion that is done at the share u of its time: a quintic
/// without jerk at its ends; greatest rate 1.875, greatest second rate 10 / sqrt(3).
double rest_to_rest(double u) noexcept;

/// P in W while this contact touches with the pusher's centre at `place` [m].
PlanarPose pusher_in_world(const Model& model, const PushContact& contact, double place);

/// The motion for a usable plan; no samples where there is nothing to do.
ArmMotion arm_motion(const Model& model, const Plan& plan, const ArmLimits& limits = {});

/// The straight push that hand poses X_WH stand for, from their first to their last, when
/// the object lies in the hand at X_HO before: place and contact are those of `push`.
/// Also says how far the poses between stray from it.
struct PushFromPoses {
  LinearPush push;
  double stray = 0.0;        ///< [m] of the finger axis from its straight line in P
  double stray_angle = 0.0;  ///< [rad] of the hand from turning in proportion to its way
};
PushFromPoses push_from_poses(const std::vector<ArmPose>& X_WH, const PlanarPose& X_HO,
                              const LinearPush& push);

}  // namespace prehensile
