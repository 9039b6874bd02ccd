/// Distances between the bodies of a scene, for the search. Names nothing of the library
/// that computes them (FCL, where it is built in). Internal to the planner.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "mechanics/model.h"

namespace prehensile {

/// Whether the library is built in; without it a scene that names obstacles is refused.
bool collisions_are_built();

/// The bodies of a scene with obstacles.
class CollisionBodies {
 public:
  explicit CollisionBodies(const Model& model);
  ~CollisionBodies();
  CollisionBodies(const CollisionBodies&) = delete;
  CollisionBodies& operator=(const CollisionBodies&) = delete;

  /// Least distance from the fixture of the hand at X_WH, or of the object at X_WO [m],
  /// lifted by z [m]; 0 where they overlap, and `enough` where it is at least that. What
  /// is at least `coarse` may be less than the distance.
  double hand_distance(const PlanarPose& X_WH, double enough, double z = 0.0,
                       double coarse = kNever) const;
  double object_distance(const PlanarPose& X_WO, double enough, double z = 0.0,
                         double coarse = kNever) const;

  /// Least distance of the hand's bodies between the faces (`palm_bodies`) from the
  /// object, with H at X_OH in it; likewise.
  double palm_distance(const PlanarPose& X_OH, double enough,
                       double coarse = kNever) const;

  /// How far from their z axes hand and object reach [m].
  double hand_reach() const;
  double object_reach() const;

  /// Pairs of bodies that the library was asked for so far.
  std::int64_t queries() const;

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace prehensile
