#include "mechanics/spatial_sensitivity.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "problems/random_spatial.h"
#include "tests/mechanics/spatial_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

constexpr SpatialSolveOptions kSharp{.tolerance = 1e-12};

/// A change of the question by `step` of one of its parameters.
struct Parameter {
  const char* name;
  std::function<void(SpatialProblem&, double)> change;
  double unit = 1.0;
};

void add_friction(SpatialProblem& q, ContactBody body, double step) {
  for (int k = 0; k < q.patch_count; ++k) {
    if (q.patch[k].body == body) q.patch[k].mu += step;
  }
}

void scale_grip(SpatialProblem& q, double factor) {
  q.grip_force *= factor;
  for (int k = 0; k < 2; ++k) {
    const ContactPatch& patch = q.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      q.preload[i] *= factor;
    }
  }
}

void shift_pusher(SpatialProblem& q, const Vec3& d) {
  const ContactPatch& patch = q.patch[2];
  for (int i = patch.first; i < patch.first + patch.count; ++i) {
    q.x[i] += d.x();
    q.y[i] += d.y();
    q.z[i] += d.z();
  }
}

std::vector<Parameter> parameters() {
  return {
      {"friction of jaw 1",
       [](auto& q, double s) { add_friction(q, ContactBody::kJaw1, s); }},
      {"friction of jaw 2",
       [](auto& q, double s) { add_friction(q, ContactBody::kJaw2, s); }},
      {"friction of the pusher",
       [](auto& q, double s) { add_friction(q, ContactBody::kPusher, s); }},
      {"grip force", [](auto& q, double s) { scale_grip(q, 1.0 + s); }},
      {"mass", [](auto& q, double s) { q.w_g *= 1.0 + s; }},
      {"place", [](auto& q, double s) { shift_pusher(q, s * q.patch[2].t); }, 0.01},
      {"height", [](auto& q, double s) { shift_pusher(q, s * Vec3::UnitZ()); }, 0.01},
      {"direction",
       [](auto& q, double s) {
         const Vec3 v = q.V_HP.template head<3>();
         q.V_HP.template head<3>() += s * Vec3::UnitZ().cross(v);
       }},
      {"turn of the pusher",
       [](auto& q, double s) { q.V_HP[5] += s * q.V_HP.template head<3>().norm(); },
       10.0},
      {"compliance",
       [](auto& q, double s) {
         for (auto& patch : q.patch) patch.compliance *= 1.0 + s;
       }},
  };
}

SpatialProblem changed(const SpatialProblem& problem, const Parameter& parameter,
                       double step) {
  SpatialProblem q = problem;
  parameter.change(q, parameter.unit * step);
  return q;
}

SpatialVariation variation_of(const SpatialProblem& problem, const Parameter& parameter) {
  constexpr double kStep = 1e-5;
  return variation_between(changed(problem, parameter, -kStep),
                           changed(problem, parameter, kStep), 2.0 * kStep);
}

double push_rate(const SpatialProblem& problem) { return problem.V_HP.head<3>().norm(); }

/// Twist with turns weighed by 1 cm, in push rates; push in capacities of the grip.
Eigen::Matrix<double, 9, 1> in_units(const SpatialProblem& problem, const SpatialTwist& V,
                                     const SpatialWrench& w) {
  Eigen::Matrix<double, 9, 1> all;
  all << V.head<3>() / push_rate(problem), 0.01 * V.tail<3>() / push_rate(problem),
      w.head<3>() / problem.grip_force;
  return all;
}

/// The motion next to a given one: some instants have several.
SpatialInstant followed(const SpatialProblem& problem, const SpatialInstant& answer) {
  SpatialWarmStart warm{true, answer};
  return solve_spatial(problem, kSharp, &warm);
}

/// Distance of the derivative from the difference quotient between two steps, over the
/// size of the two; infinite where an end has no such answer.
double error_between(const SpatialProblem& problem, const SpatialInstant& answer,
                     const Parameter& parameter, const SpatialSensitivity& change,
                     double from, double to) {
  const SpatialInstant low = followed(changed(problem, parameter, from), answer);
  const SpatialInstant high = followed(changed(problem, parameter, to), answer);
  if (low.status != InstantStatus::kMoves || high.status != InstantStatus::kMoves) {
    return std::numeric_limits<double>::infinity();
  }
  const double step = to - from;
  const auto exact = in_units(problem, change.V_HO, change.w_push);
  const auto quotient =
      in_units(problem, (high.V_HO - low.V_HO) / step, (high.w_push - low.w_push) / step);
  return (exact - quotient).norm() / (1.0 + exact.norm());
}

void compare(int total, int least) {
  int compared = 0;
  int smooth = 0;
  for (int i = 0; i < total; ++i) {
    const SpatialProblem problem =
        random_spatial(61, i,
                       {.points_per_pad = std::array{2, 4, 8}[i % 3],
                        .jaw_mode = i % 5 == 0 ? JawMode::kFixedJaw1 : JawMode::kCoupled,
                        .acceleration = i % 4 == 0 ? 1.0 : 0.0,
                        .spin_radius = i % 7 == 0 ? 1e-3 : 0.0});
    const SpatialInstant answer = solve_spatial(problem, kSharp);
    const DifferentiatedSpatialInstant differentiated(problem, answer);
    if (!differentiated.is_differentiable()) continue;
    ++smooth;
    if (differentiated.mode_slack() < 1e-3) continue;
    for (const Parameter& parameter : parameters()) {
      const SpatialSensitivity change =
          differentiated.along(variation_of(problem, parameter));
      double error = std::numeric_limits<double>::infinity();
      for (const double step : {1e-4, 1e-5, 1e-6}) {
        error = std::min(error,
                         error_between(problem, answer, parameter, change, -step, step));
      }
      if (!std::isfinite(error)) continue;
      ++compared;
      EXPECT_LT(error, 1e-4) << i << " " << parameter.name << ", slack "
                             << differentiated.mode_slack();
      const Vec3 f = answer.w_push.head<3>();
      if (f.norm() > 0.0) {
        EXPECT_NEAR(change.push_force, f.dot(change.w_push.head<3>()) / f.norm(),
                    1e-9 * (1.0 + std::abs(change.push_force)));
      }
    }
  }
  std::cout << smooth << " of " << total << " differentiable, " << compared
            << " derivatives compared\n";
  EXPECT_GE(compared, least);
}

TEST(SpatialSensitivity, IsTheLimitOfDifferences) { compare(60, 400); }

TEST(SpatialSensitivity, FullIsTheLimitOfDifferences) { compare(6000, 20000); }

/// Where the pusher is about to slip, the derivative by its friction holds on the side on
/// which it was taken, and is said to be near a change of mode.
TEST(SpatialSensitivity, HoldsOnOneSideAtAChangeOfMode) {
  const Parameter friction = parameters()[2];
  int kinks = 0;
  for (int i = 0; i < 40; ++i) {
    SpatialProblem problem =
        random_spatial(62, i, {.points_per_pad = 4, .pusher_points = 1});
    const auto sticks_with = [&](double mu) {
      problem.patch[2].mu = mu;
      const SpatialInstant answer = solve_spatial(problem, kSharp);
      return answer.status == InstantStatus::kMoves &&
             answer.point[problem.patch[2].first].mode == ContactMode::kStick;
    };
    double slips = 0.05;
    double sticks = 1.5;
    if (sticks_with(slips) || !sticks_with(sticks)) continue;
    while (sticks - slips > 2e-8) {
      const double middle = 0.5 * (sticks + slips);
      (sticks_with(middle) ? sticks : slips) = middle;
    }
    problem.patch[2].mu = slips - 1e-6;  // It slips, barely.
    const SpatialInstant answer = solve_spatial(problem, kSharp);
    const DifferentiatedSpatialInstant differentiated(problem, answer);
    if (!differentiated.is_differentiable()) continue;
    // Where the answer jumps to another motion there is no derivative on either side.
    if (differentiated.mode_slack() > 1e-4) continue;
    const SpatialSensitivity change =
        differentiated.along(variation_of(problem, friction));
    double on_its_side = std::numeric_limits<double>::infinity();
    for (const double step : {1e-4, 1e-5, 3e-6}) {
      on_its_side = std::min(
          on_its_side, error_between(problem, answer, friction, change, -step, 0.0));
    }
    const double beyond = error_between(problem, answer, friction, change, 1e-5, 1e-4);
    if (!std::isfinite(on_its_side) || !std::isfinite(beyond)) continue;
    EXPECT_LT(on_its_side, 5e-3) << i;
    EXPECT_GT(beyond, 10.0 * on_its_side) << i;
    ++kinks;
  }
  std::cout << kinks << " kinks\n";
  EXPECT_GE(kinks, 10);
}

Scene box_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.10, 0.06, 0.03}};
  scene.object.mass = 0.3;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.5, 0.4};
  scene.gripper.grip_force = 20.0;
  scene.g_Wz = 3.0;
  scene.pushers = {{.name = "pin", .feature = PointFeature{}, .friction = 0.2}};
  return scene;
}

/// The parameters of a scene, each against a scene in which it is a little different.
TEST(SpatialSensitivity, OfTheParametersOfAScene) {
  const double place = 0.012;
  const SpatialQuestionOptions off_plane{.height = 0.004};
  const auto question = [&](const Scene& scene, double at_place, double direction) {
    const Model model = prepare(scene, {.points_per_pad = 8});
    const Vec2 v = 0.01 * rotated(direction, {1.0, 0.0});
    return spatial_problem_at(model, model.contacts[0], at_place, {},
                              in_space({v.x(), v.y(), 0.0}), off_plane);
  };
  const Model model = prepare(box_scene(), {.points_per_pad = 8});
  const SpatialTwist V_HP = in_space({0.01, 0.0, 0.0});
  const SpatialProblem problem = question(box_scene(), place, 0.0);
  const SpatialInstant answer = solve_spatial(problem, kSharp);
  const DifferentiatedSpatialInstant differentiated(problem, answer);
  ASSERT_TRUE(differentiated.is_differentiable());
  constexpr double kStep = 1e-6;
  for (int p = 0; p < static_cast<int>(InstantParameter::kCount); ++p) {
    const auto parameter = static_cast<InstantParameter>(p);
    const auto pushed = [&](double step) {
      Scene scene = box_scene();
      if (parameter == InstantParameter::kFrictionJaw1) scene.gripper.friction[0] += step;
      if (parameter == InstantParameter::kFrictionJaw2) scene.gripper.friction[1] += step;
      if (parameter == InstantParameter::kGripForce) scene.gripper.grip_force += step;
      if (parameter == InstantParameter::kMass) scene.object.mass += step;
      if (parameter == InstantParameter::kPusherFriction) {
        scene.pushers[0].friction += step;
      }
      return solve_spatial(
          question(scene, place + (parameter == InstantParameter::kPlace ? step : 0.0),
                   parameter == InstantParameter::kDirection ? step : 0.0),
          kSharp);
    };
    const SpatialInstant above = pushed(kStep);
    const SpatialInstant below = pushed(-kStep);
    const SpatialSensitivity change = differentiated.along(spatial_variation_of(
        model, model.contacts[0], place, {}, V_HP, off_plane, parameter));
    const double force = (above.push_force - below.push_force) / (2.0 * kStep);
    EXPECT_NEAR(change.push_force, force, 1e-3 * std::abs(force) + 1e-4)
        << name(parameter);
    for (int k = 0; k < 6; ++k) {
      const double V = (above.V_HO[k] - below.V_HO[k]) / (2.0 * kStep);
      EXPECT_NEAR(change.V_HO[k], V, 1e-3 * std::abs(V) + 1e-4) << name(parameter);
    }
  }
}

/// Straight slide of a line pusher: the force is 2 mu N, so its derivatives are known.
TEST(SpatialSensitivity, StraightSlideHasItsClosedForm) {
  SpatialProblem problem = testing::grasp_of(testing::disc_points(8, 0.008), 0.01, 20.0,
                                             {.mu = 0.45, .compliance = 1e-6});
  testing::push(problem, {{-0.03, -0.02, 0.0}, {-0.03, 0.02, 0.0}}, Vec3::UnitX(), 0.3,
                {0.01, 0.0, 0.0});
  const SpatialInstant answer = solve_spatial(problem, kSharp);
  const DifferentiatedSpatialInstant differentiated(problem, answer);
  ASSERT_TRUE(differentiated.is_differentiable());
  const auto force = [&](int parameter) {
    return differentiated.along(variation_of(problem, parameters()[parameter]))
        .push_force;
  };
  EXPECT_NEAR(force(0) + force(1), 40.0, 1e-6);
  EXPECT_NEAR(force(2), 0.0, 1e-6);
  EXPECT_NEAR(force(3), 2.0 * 0.45 * 20.0, 1e-6);
  EXPECT_NEAR(force(7), 0.0, 1e-6);
}

TEST(SpatialSensitivity, IsUnsetWhereTheAnswerIsNotSmooth) {
  SpatialProblem problem = random_spatial(61, 1, {.points_per_pad = 4});
  problem.V_HP = -problem.V_HP;
  const SpatialInstant answer = solve_spatial(problem);
  ASSERT_NE(answer.status, InstantStatus::kMoves);
  const DifferentiatedSpatialInstant differentiated(problem, answer);
  EXPECT_FALSE(differentiated.is_differentiable());
  EXPECT_FALSE(differentiated.along(SpatialVariation{}).valid());
}

TEST(SpatialSensitivity, UsesNoHeap) {
  const SpatialProblem problem = random_spatial(61, 2, {.points_per_pad = 8});
  const SpatialInstant answer = solve_spatial(problem);
  const SpatialVariation variation = variation_of(problem, parameters()[3]);
  const testing::NoHeapScope scope;
  const DifferentiatedSpatialInstant differentiated(problem, answer);
  const SpatialSensitivity change = differentiated.along(variation);
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_EQ(change.valid(), differentiated.is_differentiable());
}

}  // namespace
}  // namespace prehensile
