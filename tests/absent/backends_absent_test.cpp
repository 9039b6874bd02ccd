/// What is left where NLopt, Ipopt and FCL were switched off: linked with the sources
/// that stand in for them, in every build, so that absence is tested wherever the tests
/// run.
#include <algorithm>

#include <gtest/gtest.h>

#include "mechanics/reference.h"
#include "mechanics/solvers.h"
#include "mechanics/spatial_reference.h"
#include "planner/checks/replay.h"
#include "planner/obstacles/collision_bodies.h"
#include "planner/planner.h"
#include "problems/published_regrasps.h"
#include "problems/random_spatial.h"
#include "tests/mechanics/instant_cases.h"
#include "tests/optimisation/classic_programs.h"

namespace prehensile {
namespace {

using testing::disc_grasp;
using testing::point_drive;
using testing::rosenbrock;

TEST(BackendsAbsent, MinimisersReturnTheStartAndSaySo) {
  EXPECT_FALSE(nlopt_is_built());
  EXPECT_FALSE(ipopt_is_built());
  for (const NlpResult& result : {minimise_nlopt(rosenbrock(), LocalMethod::kSlsqp),
                                  minimise_ipopt(rosenbrock())}) {
    EXPECT_EQ(result.status, NlpStatus::kNotBuilt);
    EXPECT_EQ(result.x, rosenbrock().start);
    EXPECT_NE(result.message.find("built without"), std::string::npos);
  }
}

TEST(BackendsAbsent, ReferencesAreNotRun) {
  EXPECT_FALSE(reference_is_built());
  EXPECT_FALSE(spatial_reference_is_built());
  const PlanarDrive drive = point_drive({-0.05, 0.0}, {1.0, 0.0}, 0.3, {0.01, 0.0});
  EXPECT_EQ(solve_reference(disc_grasp(6, 0.01, 20.0), drive).status,
            InstantStatus::kNotRun);
  EXPECT_EQ(solve_spatial_reference(random_spatial(1, 0, {.points_per_pad = 2})).status,
            SpatialReferenceStatus::kNotRun);
}

TEST(BackendsAbsent, SolversAreListedWithoutThem) {
  const std::vector<Solver> built = built_solvers();
  for (const Solver solver : {Solver::kPlanarReference, Solver::kSpatialReference}) {
    EXPECT_EQ(std::count(built.begin(), built.end(), solver), 0) << name(solver);
  }
  for (const Solver solver : {Solver::kPlanar, Solver::kClosedForm, Solver::kSpatial,
                              Solver::kSpatialPivoting}) {
    EXPECT_EQ(std::count(built.begin(), built.end(), solver), 1) << name(solver);
  }
}

TEST(BackendsAbsent, ObstaclesAreRefusedAndPlansStillChecked) {
  EXPECT_FALSE(collisions_are_built());
  Scene scene = published_square(0);
  const Plan blind = plan_regrasp(prepare(scene));
  ASSERT_TRUE(blind.usable());
  scene.obstacles = Obstacles{
      .fixture = {{.name = "ball",
                   .shape = SphereShape{0.01},
                   .position = {1.0, 0.0, 0.0}}},
      .hand = {
          {.name = "knuckle", .shape = SphereShape{0.02}, .position = {0.0, 0.0, 0.05}}}};
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  EXPECT_EQ(plan.status, PlanStatus::kUnsupported);
  EXPECT_NE(plan.message.find("PREHENSILE_OBSTACLES"), std::string::npos);
  EXPECT_TRUE(replay(model, blind).agrees) << replay(model, blind).why;
  scene.obstacles->fixture[0].position.x() = 0.05;
  EXPECT_FALSE(replay(prepare(scene), blind).agrees);
}

}  // namespace
}  // namespace prehensile
