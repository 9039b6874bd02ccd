/// A plan or a push as a film: the poses of object, pushers, jaws and hand along the way,
/// with the forces of every contact point, found by replaying the pushes with the exact
/// mechanics. What a page, a picture or another program shows is read from here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/arm/arm_motion.h"
#include "planner/checks/replay.h"
#include "primitives/motion_cone.h"
#include "scene/object_surface.h"
#include "viewer/bodies.h"
#include "viewer/contact_loads.h"

namespace prehensile::viewer {

/// One moment of a push.
struct FilmFrame {
  double s = 0.0;  ///< share of the push as asked for
  Grasp grasp;
  double z_HO = 0.0;                      ///< [m] height of O in H
  PlanarPose X_HP;                        ///< pusher frame: O at the start of the push
  double z_HP = 0.0;                      ///< [m]
  std::array<double, 2> jaw_z{0.0, 0.0};  ///< [m] surfaces of the jaws in H
  Sample sample;                          ///< as the transition gave it
  ContactLoads loads;
  double slack = kNan;         ///< of the nominal contact; NaN where it does not stick
  double robust_slack = kNan;  ///< over the margin of the plan
  /// Directions of the pusher that would stick at this rate of turn, and its own, from
  /// the normal of the face [rad]; over the ellipsoid, in the pad plane.
  std::vector<DirectionRange> cone;
  double direction = kNan;
};

/// One push, as far as it went.
struct FilmPush {
  Push push;
  Grasp start;
  std::string kind;          ///< "slide", "pivot", "roll" or "push"
  int contact = 0;           ///< index in Model::contacts
  Vec2 p_PC = Vec2::Zero();  ///< [m] centre of the pusher's feature in P
  Transition transition;
  std::vector<FilmFrame> frames;
  std::string why;  ///< why a replay disagrees; empty: it agrees, or there is no plan
};

/// A stretch of time. The hand moves from `from` to `to` on a straight line, turning in
/// proportion; its share of the way is rest_to_rest of the share of the time. In a push
/// that share times the last frame's s finds the frame.
struct FilmPhase {
  ArmPhase kind = ArmPhase::kPush;
  int push = 0;
  double begin = 0.0, end = 0.0;  ///< [s]
  PlanarPose X_WH_from, X_WH_to;
  double z_from = 0.0, z_to = 0.0;  ///< [m]
};

struct Film {
  std::string name;  ///< on the page; of the scene
  std::vector<FilmPush> pushes;
  std::vector<FilmPhase> phases;
  Loops region;  ///< of a refusal by a barrier: places of the finger axis in O
  std::vector<Grasp> outcomes;           ///< where members of the uncertainty ended
  std::optional<ObjectSurface> surface;  ///< of an object from a mesh, where it is known
  bool agrees = true;                    ///< a replay of the plan agrees with it
  std::string why;                       ///< why it does not
  int left_out = 0;  ///< pushes of the plan beyond FilmOptions::pushes
};

struct FilmOptions {
  int frames = 300;  ///< at most, in all: 3 to 80 per push; a single push has all of 80
                     ///< only if it slips or turns
  int pushes = 100;  ///< at most
  TransitionOptions transition;
  ArmLimits limits;
  bool is_plan = true;  ///< compare with what the plan states; false: one push to look at
};

/// Replays the pushes of a plan one after the other, to the first that does not complete.
Film film(const Model& model, const Plan& plan, const FilmOptions& options = {});

/// A pusher as it is drawn. A line that an object rolls over stands for a sheet that lies
/// under it all the way: it has that width.
PusherBody pusher_in(const Film& film, const Model& model, int pusher);

}  // namespace prehensile::viewer
