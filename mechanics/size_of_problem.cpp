#include "mechanics/size_of_problem.h"

#include <algorithm>

#include "mechanics/spatial_problem.h"

namespace prehensile {
namespace {

constexpr int kTwist = 3;
constexpr int kSpatialTwist = 6;
constexpr int kGeneratorsOfPusherPoint = 2;  // in the plane: forwards and backwards

}  // namespace

ProblemSize size_of_problem(const Model& model, int contact, int generators_per_point) {
  const PushContact& c = model.contacts[contact];
  const PlanarGrasp grasp = grasp_at(model, model.scene.start.X_HO, c.g_O);
  ProblemSize size;
  size.unknowns = kTwist;
  size.finger_points = grasp.count;
  size.pusher_points = c.is_point ? 1 : 2;
  const int pusher_generators =
      c.mu > 0.0 ? kGeneratorsOfPusherPoint * size.pusher_points : 0;
  const int rubbing_points = size.finger_points + (c.mu > 0.0 ? size.pusher_points : 0);
  size.generators = generators_per_point * size.finger_points + pusher_generators;
  SpatialProblem spatial;
  spatial.jaw_mode = model.scene.gripper.jaw_mode;
  size.spatial_unknowns = kSpatialTwist + jaw_freedoms(spatial).count;
  const bool one_point = std::holds_alternative<PointPad>(model.scene.gripper.pad);
  const int points_per_pad =
      one_point ? std::min(1, size.finger_points) : size.finger_points;
  size.spatial_points =
      2 * points_per_pad + size.pusher_points * (c.z_high > c.z_low ? 2 : 1);

  // One lambda_n per pusher point (finger loads are known), one beta per generator, one
  // xi per rubbing point; rows: balance, gaps, eq. (4) per generator, eq. (3) per rubbing
  // point.
  size.reference_unknowns =
      kTwist + size.pusher_points + size.generators + rubbing_points;
  size.reference_constraints =
      kTwist + size.pusher_points + size.generators + rubbing_points;
  return size;
}

}  // namespace prehensile
