#include "planner/obstacles/obstacle_bodies.h"

#include <gtest/gtest.h>

#include "planner/obstacles/closeness.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

ConvexBody any_body(Random& random) {
  ConvexBody body{.name = "body"};
  switch (random.below(3)) {
    case 0:
      body.shape = BoxShape{{random.log_in(1e-4, 0.1), 0.02, random.log_in(1e-4, 0.1)}};
      break;
    case 1:
      body.shape = CapsuleShape{random.log_in(1e-3, 0.02), 0.03, Axis::kX};
      break;
    default:
      body.shape = CylinderShape{random.log_in(1e-3, 0.02), 0.03, Axis::kY};
  }
  const double half = random.in(-1.5, 1.5);
  if (random.chance(0.5)) body.quaternion = {0.0, std::sin(half), 0.0, std::cos(half)};
  body.position = {random.in(-0.1, 0.1), random.in(-0.1, 0.1), random.in(-0.05, 0.05)};
  return body;
}

/// How near a body of the hand comes to the object with H at X_OH, from above [m].
double closeness_of(const ConvexBody& body, const Model& model, const PlanarPose& X_OH) {
  double least = 1.0;
  for (const ConvexBody& piece : object_bodies(model)) {
    const PlacedBody placed{&piece, pose_of(piece)};
    least =
        std::min(least, closeness(placed, {&body, in_space(X_OH, 0.0) * pose_of(body)}));
  }
  return least;
}

Model with_hand(const ConvexBody& body) {
  Scene scene = testing::walled_square();
  scene.obstacles = Obstacles{.hand = {body}};
  return prepare(scene);
}

/// What is left out cannot meet the object wherever it is in the pad plane, but for what
/// counts as touching; what is not meets it somewhere.
TEST(ObstacleBodies, ThePalmIsWhatTheObjectCanMeet) {
  Random random(3);
  int palms = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexBody body = any_body(random);
    const Model model = with_hand(body);
    const bool is_palm = !palm_bodies(model).empty();
    palms += is_palm;
    double least = closeness_of(body, model, {-body.position.x(), -body.position.y()});
    for (int k = 0; k < 20; ++k) {
      const Vec2 p = random.in_box(0.15, 0.15);
      const PlanarPose X_OH{p.x(), p.y(), random.in(-3.0, 3.0)};
      least = std::min(least, closeness_of(body, model, X_OH));
    }
    if (is_palm) {
      EXPECT_LT(least, 0.0) << i;
    } else {
      EXPECT_GT(least, -kBeside - 1e-9) << i;
    }
  }
  EXPECT_GT(palms, 50);
  EXPECT_LT(palms, 250);
}

/// Fingers touch the faces that their pads touch.
TEST(ObstacleBodies, FingersAreBesideTheObject) {
  const double half = prepare(testing::walled_square()).half_thickness;
  const auto is_palm = [&](double z) {
    const Vec3 size(0.1, 0.01, 0.01);
    return !palm_bodies(with_hand({.name = "finger",
                                   .shape = BoxShape{size},
                                   .position = {0.04, 0.0, z}}))
                .empty();
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(is_palm(side * (half + 0.005)));
    EXPECT_FALSE(is_palm(side * (half + 0.005 - 0.9 * kBeside)));
    EXPECT_TRUE(is_palm(side * (half + 0.005 - 1.1 * kBeside)));
  }
  EXPECT_TRUE(is_palm(0.0));
}

}  // namespace
}  // namespace prehensile
