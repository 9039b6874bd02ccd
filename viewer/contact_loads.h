/// Forces at every contact point at one moment of a push, by the exact mechanics: the
/// instant is solved again at the pose that the transition found.
#pragma once

#include <array>
#include <vector>

#include "mechanics/instant.h"
#include "primitives/push.h"
#include "primitives/transition.h"

namespace prehensile::viewer {

/// What one contact point does. Everything in H.
struct PointLoad {
  Vec3 p = Vec3::Zero();      ///< [m]
  Vec3 n = Vec3::UnitX();     ///< unit, into the object
  Vec3 force = Vec3::Zero();  ///< [N] on the object
  double spin = 0.0;          ///< [N m] moment on the object about n, of a soft point
  Vec3 slip = Vec3::Zero();   ///< [m] velocity of the object against pad or pusher, per
                              ///< unit of the share of the push
  double mu = 0.0;
  ContactMode mode = ContactMode::kOpen;

  double normal() const { return n.dot(force); }  ///< [N]
};

struct ContactLoads {
  InstantStatus status = InstantStatus::kNotRun;
  std::vector<PointLoad> pusher;              ///< empty: nothing touches, or no answer
  std::array<std::vector<PointLoad>, 2> pad;  ///< of jaw 1 and jaw 2
  double push_force = kNan;                   ///< [N]
  double certificate = kNan;                  ///< worst entry
  std::array<double, 2> jaw_z{kNan, kNan};    ///< [m] surfaces of the jaws
  double z_HO = 0.0;                          ///< [m] height of O in H
};

/// Where the pusher touches the object at this pose.
struct Touch {
  int count = 0;  ///< 0: it does not; 1: a point; 2: both ends of a line
  std::array<Vec2, 2> p_P{Vec2::Zero(), Vec2::Zero()};  ///< [m]
  Vec2 n_P = Vec2::Zero();
  double gap = kNan;  ///< [m] between the two where they are nearest
};

/// Found from the geometry alone, without knowing what the push was told to be. X_PO is
/// the pose of O in P.
Touch touch_of(const PushContact& contact, double place, const PlanarPose& X_PO);

/// The loads at a sample of a push that began at `start`. `in_space`: of the transition.
ContactLoads loads_at(const Model& model, const Grasp& start, const Push& push,
                      const Sample& sample, bool in_space);

}  // namespace prehensile::viewer
