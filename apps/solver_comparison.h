/// One instant by every solver that can answer it, side by side.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mechanics/instant.h"
#include "mechanics/limit_surface.h"
#include "mechanics/spatial_problem.h"

namespace prehensile::apps {

struct SolverAnswer {
  std::string solver;
  std::string status;
  double push_force = kNan;                        ///< [N]
  PlanarTwist V_HO = PlanarTwist::Constant(kNan);  ///< in the pad plane
  double residual = kNan;     ///< the solver's own, in units (F0, V0)
  double certificate = kNan;  ///< of circular cones, by separate code; NaN: none applies
  double microseconds = kNan;
};

/// What is asked in the pad plane, and in space; a spatial problem without points leaves
/// the spatial solvers out, `in_plane` false the planar ones.
struct ComparedInstant {
  bool in_plane = true;
  LimitSurface surface;
  PlanarGrasp grasp;
  PlanarDrive drive;
  SpatialProblem spatial;
  int generators = 8;
};

std::vector<SolverAnswer> compare_solvers(const ComparedInstant& question);

std::string describe(const std::vector<SolverAnswer>& answers);
nlohmann::ordered_json to_json(const std::vector<SolverAnswer>& answers);

}  // namespace prehensile::apps
