/// Random regrasps of random objects in random fixtures, over ranges that the caller
/// states, and random regrasps of a given scene. Deterministic: (ranges, seed, index)
/// names a problem.
#pragma once

#include <array>
#include <optional>

#include "problems/random_regrasps.h"

namespace prehensile {

/// A range [low, high] that is drawn from.
using Range = std::array<double, 2>;

enum class FixtureObject {
  kBox,
  kTee,
  kConvex,  ///< 5 to 8 corners on an ellipse
  kConcave  ///< 6 to 9 corners at random distances from the middle, not convex
};

enum class FixturePushers {
  kLines,  ///< longer than any face, on different faces of the convex hull; those beyond
           ///< the number of such faces are points
  kPoints  ///< on any face
};

enum class FixturePad { kDisc, kRectangle };

/// Where the goal of a problem comes from.
enum class GoalsFrom {
  kPushes,  ///< where random pushes from the start end: feasible by construction
  kRandom,  ///< anywhere that the pads hold gravity, at any angle
};

/// What is drawn. Uniform where not said otherwise; every range with 0 < low <= high.
struct FixtureRange {
  FixtureObject object = FixtureObject::kBox;
  Range size = {0.04, 0.15};  ///< [m] longer side, boxes: both sides
  Range mass = {0.05, 0.6};   ///< [kg], log-uniform
  FixturePad pad = FixturePad::kDisc;
  Range pad_size = {0.010, 0.024};  ///< [m] diameter, or longer side
  Range pad_aspect = {0.5, 1.0};    ///< of rectangles: shorter over longer side, <= 1
  Range finger_friction = {0.3, 1.0};
  Range pusher_friction = {0.3, 1.0};
  Range strength = {1.5, 10.0};  ///< weight that the fingers could carry over the weight
                                 ///< that they carry, log-uniform, > 1
  FixturePushers pushers = FixturePushers::kLines;
  Range count = {2.0, 4.0};          ///< of pushers, whole numbers 1..6
  double weightless = 0.1;           ///< share of problems without gravity, 0..1
  double position_tolerance = 1e-3;  ///< [m] of the goal
  double angle_tolerance = 0.02;     ///< [rad]
  GoalsFrom goals = GoalsFrom::kPushes;
};

/// A problem, or nothing where hundreds of draws gave none: the ranges are then too
/// narrow to hold an object, or to push it.
std::optional<RandomRegrasp> random_fixture(const FixtureRange& range, std::uint64_t seed,
                                            std::uint64_t index);

/// The scene with another start and goal, both where the pads hold gravity in the
/// attitude of every contact; tolerances of the scene's goal. Where the object can roll,
/// two of three goals of pushes, and half of the random ones, ask for a roll.
std::optional<RandomRegrasp> random_regrasp_of(const Scene& scene, GoalsFrom goals,
                                               std::uint64_t seed, std::uint64_t index);

}  // namespace prehensile
