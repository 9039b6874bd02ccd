#include "planner/obstacles/confines_check.h"

#include <gtest/gtest.h>

#include "planner/advice.h"
#include "planner/checks/replay.h"
#include "planner/obstacles/collision_bodies.h"
#include "planner/obstacles/obstacle_bodies.h"
#include "planner/obstacles/placement.h"
#include "problems/confined_regrasps.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

PlanOptions nominal(std::int64_t budget = 2'000'000) {
  PlanOptions options;
  options.budget = budget;
  options.margin = Margin::none();
  return options;
}

/// Whether a point of W is inside one of the bodies of `with_obstacles`, shrunk by
/// `less`.
bool is_inside(const ConvexBody& body, const Vec3& p, double less) {
  const Vec3 q = pose_of(body).inverse() * p;
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    return (q.array().abs() < 0.5 * box->size.array() - less).all();
  }
  const auto& post = std::get<CylinderShape>(body.shape);
  return q.head<2>().norm() < post.radius - less &&
         std::abs(q.z()) < 0.5 * post.length - less;
}

/// Points all over a box.
std::vector<Vec3> points_of(const ConvexBody& body) {
  constexpr int kSteps = 8;
  const Vec3 half = 0.5 * std::get<BoxShape>(body.shape).size;
  std::vector<Vec3> points;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        const Vec3 share(2.0 * i / kSteps - 1.0, 2.0 * j / kSteps - 1.0, z);
        points.push_back(pose_of(body) * share.cwiseProduct(half));
      }
    }
  }
  return points;
}

/// How many of the points of hand and object, at many poses of a plan, are inside a body
/// of the fixture: by points alone, without any distance.
int points_inside(const Model& model, const Plan& plan) {
  const Obstacles& obstacles = *model.scene.obstacles;
  std::vector<Vec3> hand;
  for (const ConvexBody& body : obstacles.hand) {
    for (const Vec3& p : points_of(body)) hand.push_back(p);
  }
  int inside = 0;
  const auto look = [&](const Eigen::Isometry3d& X_W, const std::vector<Vec3>& points,
                        double less) {
    for (const Vec3& p : points) {
      for (const ConvexBody& body : obstacles.fixture) {
        inside += is_inside(body, X_W * p, less);
      }
    }
  };
  std::vector<Vec3> object;
  object.reserve(model.outline.size());
  for (const Vec2& v : model.outline) object.emplace_back(v.x(), v.y(), 0.0);
  for (const PlannedPush& planned : plan.pushes) {
    const LinearPush push = as_linear(planned.push);
    const PushContact& contact =
        model.contacts[static_cast<std::size_t>(contact_of(planned.push))];
    const PlanarPose X_WO = object_at_pusher(model, contact, push.place);
    const Vec2 n = rotated(X_WO.theta, contact.n);
    const auto look_at = [&](double s, double off) {
      PlanarPose there = X_WO;
      there.x += off * n.x();
      there.y += off * n.y();
      const PlanarPose X_HO = pusher_pose(push, planned.start.X_HO, s);
      look(in_space(compose(there, inverse(X_HO)), 0.0), hand, 0.0);
      look(in_space(there, 0.0), object, 1e-6);
    };
    for (int i = 0; i <= 40; ++i) {
      look_at(i / 40.0, 0.0);
      look_at(0.0, obstacles.approach * i / 40.0);
      look_at(1.0, obstacles.approach * i / 40.0);
    }
  }
  return inside;
}

struct Tally {
  int solved = 0;     ///< with the posts
  int would_hit = 0;  ///< the plan that does not know of them hits something
};

Tally solve_among_posts(bool square, RegraspRange range, int count) {
  Tally tally;
  for (int i = 0; i < count; ++i) {
    Scene scene =
        with_obstacles(random_among_walls(square, range, false, 41, i), 6, 41, i);
    const Model model = prepare(scene);
    const Plan plan = plan_regrasp(model, nominal(300'000));
    if (plan.usable()) {
      ++tally.solved;
      EXPECT_EQ(points_inside(model, plan), 0) << i;
      const Replay again = replay(model, plan);
      EXPECT_TRUE(again.agrees) << i << again.why;
      EXPECT_LE(plan.lower_bound, plan.cost * (1.0 + 1e-9)) << i;
    }
    scene.obstacles.reset();
    const Plan blind = plan_regrasp(prepare(scene), nominal());
    if (points_inside(model, blind) > 0) {
      ++tally.would_hit;
      EXPECT_FALSE(replay(model, blind).agrees) << i;
    }
  }
  return tally;
}

TEST(ConfinesCheck, NoPlanCollides) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const Tally tally = solve_among_posts(true, RegraspRange::kPublished, 8);
  EXPECT_GE(tally.solved, 4);
  EXPECT_GE(tally.would_hit, 1);
}

TEST(ConfinesCheck, FullNoPlanCollides) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  for (const bool square : {true, false}) {
    for (const RegraspRange range : {RegraspRange::kPublished, RegraspRange::kWide}) {
      const Tally tally = solve_among_posts(square, range, 20);
      std::printf("%s, %s: %d of 20 solved, %d plans without the posts would hit one\n",
                  square ? "square" : "T",
                  range == RegraspRange::kWide ? "wide" : "published", tally.solved,
                  tally.would_hit);
      EXPECT_GE(tally.would_hit, 3);
      // Walls cannot be reached by a hand that comes from behind them.
      EXPECT_GE(tally.solved, range == RegraspRange::kWide ? 2 : 8);
    }
  }
}

/// A wall's regrasp with nothing around but a body put in its way by a test.
class OneBody : public ::testing::Test {
 protected:
  OneBody() {
    scene_ = with_obstacles(
        random_among_walls(true, RegraspRange::kPublished, false, 3, 0), 0, 1, 0);
    blind_ = scene_;
    blind_.obstacles.reset();
  }

  /// Adds a thin sheet that crosses the palm's way in the middle of a push of the plan.
  void put_a_sheet_in_the_way(const Plan& plan) {
    const Model model = prepare(blind_);
    const PlannedPush& planned = plan.pushes.front();
    const LinearPush push = as_linear(planned.push);
    const PushContact& contact =
        model.contacts[static_cast<std::size_t>(contact_of(planned.push))];
    const PlanarPose X_WO = object_at_pusher(model, contact, push.place);
    const auto palm = [&](double s) {
      const PlanarPose X_HO = pusher_pose(push, planned.start.X_HO, s);
      return transform(compose(X_WO, inverse(X_HO)), {0.13, 0.0});
    };
    const Vec2 way = palm(0.6) - palm(0.4);
    const Vec2 middle = palm(0.5);
    scene_.obstacles->fixture.push_back({.name = "sheet",
                                         .shape = BoxShape{{1e-5, 0.004, 0.01}},
                                         .position = {middle.x(), middle.y(), 0.0},
                                         .turn = std::atan2(way.y(), way.x())});
  }

  Scene scene_, blind_;
};

TEST_F(OneBody, ReplayMissesNoThinSheet) {
  const Plan plan = plan_regrasp(prepare(blind_), nominal());
  ASSERT_TRUE(plan.usable());
  EXPECT_TRUE(replay(prepare(scene_), plan).agrees) << replay(prepare(scene_), plan).why;
  put_a_sheet_in_the_way(plan);
  const Replay again = replay(prepare(scene_), plan);
  EXPECT_FALSE(again.agrees);
  EXPECT_NE(again.why.find("too near to an obstacle"), std::string::npos) << again.why;
}

TEST_F(OneBody, ThePlanGoesAnotherWay) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const Plan before = plan_regrasp(prepare(scene_), nominal());
  ASSERT_TRUE(before.usable());
  put_a_sheet_in_the_way(before);
  const Model model = prepare(scene_);
  const Plan plan = plan_regrasp(model, nominal());
  ASSERT_TRUE(plan.usable()) << plan.message;
  EXPECT_GE(plan.cost, before.cost);  // as dear where the pusher only stands elsewhere
  EXPECT_FALSE(replay(model, before).agrees);
  EXPECT_GT(plan.stopped_by[PushConstraint::kCollision], 0);
  EXPECT_EQ(points_inside(model, plan), 0);
  const Plan again = plan_regrasp(model, nominal());
  EXPECT_EQ(again.cost, plan.cost);
  EXPECT_EQ(again.stick_tests, plan.stick_tests);
}

TEST_F(OneBody, WalledInThereIsAProofAndTheBodyIsNamed) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  scene_.obstacles->fixture.push_back(
      {.name = "lid", .shape = HalfSpaceShape{}, .position = {0.0, 0.0, 0.01}});
  const Model model = prepare(scene_);
  const PlanOptions options = nominal(200'000);
  const Plan plan = plan_regrasp(model, options);
  EXPECT_EQ(plan.status, PlanStatus::kInfeasible);
  EXPECT_EQ(plan.proof.kind, Proof::Kind::kStartBlocked);
  const Explanation why = explain(model, plan, options);
  EXPECT_NE(why.text.find("obstacles are in the way"), std::string::npos) << why.text;
  EXPECT_NE(why.text.find("the body lid of the fixture taken away"), std::string::npos)
      << why.text;
}

/// The object may touch the plate that stands for its pusher, and no other.
TEST_F(OneBody, ThePusherItselfIsNoObstacle) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const Model model = prepare(scene_);
  EXPECT_TRUE(plan_regrasp(model, nominal()).usable());
  for (ConvexBody& plate : scene_.obstacles->fixture) {
    plate.position += 5e-4 * Vec3(std::cos(plate.turn), std::sin(plate.turn), 0.0);
  }
  EXPECT_FALSE(plan_regrasp(prepare(scene_), nominal(100'000)).usable());
}

/// A square with a palm at a random side, clear of it by 2 mm at start and goal.
std::optional<Scene> with_palm_at_hand(int i) {
  testing::Random random(static_cast<std::uint64_t>(i));
  Scene scene = random_among_walls(true, RegraspRange::kWide, false, 45, i);
  const Goal& goal = *scene.goal;
  for (int draw = 0; draw < 100; ++draw) {
    const Vec2 p = random.in(0.06, 0.09) * random.direction();
    const ConvexBody palm{.name = "palm",
                          .shape = BoxShape{{0.02, 0.03, 0.07}},
                          .position = {p.x(), p.y(), 0.0},
                          .turn = random.in(-1.0, 1.0)};
    scene.obstacles = Obstacles{.hand = {palm}};
    const Model model = prepare(scene);
    const CollisionBodies bodies(model);
    const PlanarPose X_HG{*goal.x, *goal.y, *goal.theta};
    if (bodies.palm_distance(inverse(scene.start.X_HO), 1.0) > 0.003 &&
        bodies.palm_distance(inverse(X_HG), 1.0) > 0.003) {
      return scene;
    }
  }
  return std::nullopt;
}

/// How many points of the palm are in the object, at many poses of a plan.
int palm_points_inside(const Model& model, const Plan& plan) {
  const std::vector<Vec3> palm = points_of(model.scene.obstacles->hand.front());
  int inside = 0;
  for (const PlannedPush& planned : plan.pushes) {
    for (int k = 0; k <= 100; ++k) {
      const PlanarPose X_HO =
          pusher_pose(as_linear(planned.push), planned.start.X_HO, k / 100.0);
      for (const Vec3& p : palm) {
        const Vec2 p_O = transform(inverse(X_HO), {p.x(), p.y()});
        inside += depth_inside(model.outline, p_O) > 0.0;
      }
    }
  }
  return inside;
}

/// Plans go round the palm where the cheapest way would be through it, which the check of
/// plans refuses.
TEST(ConfinesCheck, NoPlanDrivesTheObjectIntoThePalm) {
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  int solved = 0;
  int would_hit = 0;
  for (int i = 0; i < 15; ++i) {
    const auto scene = with_palm_at_hand(i);
    if (!scene) continue;
    const Model model = prepare(*scene);
    Scene blind = *scene;
    blind.obstacles.reset();
    const Plan through = plan_regrasp(prepare(blind), nominal());
    if (palm_points_inside(model, through) == 0) continue;
    ++would_hit;
    const Replay refused = replay(model, through);
    EXPECT_FALSE(refused.agrees) << i;
    EXPECT_NE(refused.why.find("too near to a body of the hand"), std::string::npos)
        << refused.why;
    const Plan plan = plan_regrasp(model, nominal());
    if (!plan.usable()) continue;
    ++solved;
    EXPECT_EQ(palm_points_inside(model, plan), 0) << i;
    EXPECT_TRUE(replay(model, plan).agrees) << i << replay(model, plan).why;
  }
  std::printf("%d plans would go through the palm, %d go round it\n", would_hit, solved);
  EXPECT_GE(would_hit, 3);
  EXPECT_GE(solved, 2);
}

/// Limits that leave out a few degrees: a hand that turns past them leaves them, however
/// short the gap.
TEST(ConfinesCheck, AHandTurnsOverNoGapInItsLimits) {
  Scene scene = testing::walled_square();
  const Model free = prepare(scene);
  const LinearPush push{
      .contact = 0, .e = free.contacts[0].n, .travel = 0.01, .turn = 0.9};
  PlannedPush planned{.push = push, .start = scene.start, .end = scene.start};
  planned.end.X_HO = pusher_pose(push, scene.start.X_HO, 1.0);
  const double from = free.contacts[0].theta_WO - planned.start.X_HO.theta;
  const double to = free.contacts[0].theta_WO - planned.end.X_HO.theta;
  const auto fault = [&](double gap_at, double half_gap) {
    scene.limits = GraspLimits{.hand_angle_low = gap_at + half_gap,
                               .hand_angle_high = gap_at + 2.0 * kPi - half_gap};
    return confinement_fault(prepare(scene), {planned});
  };
  for (const double half_gap : {1e-3, 0.02, 0.1}) {
    for (int k = -2; k <= 2; ++k) {
      const double whole = 2.0 * kPi * k;
      for (const double share : {0.02, 0.31, 0.5, 0.77, 0.98}) {
        EXPECT_NE(fault(from + share * (to - from) + whole, half_gap), "") << share;
      }
      EXPECT_EQ(fault(to + std::copysign(0.2, to - from) + whole, half_gap), "");
      EXPECT_EQ(fault(from - std::copysign(0.2, to - from) + whole, half_gap), "");
    }
  }
}

}  // namespace
}  // namespace prehensile
