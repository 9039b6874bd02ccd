#include "planner/obstacles/prism_path.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "planner/steering/roll_step.h"
#include "primitives/transition.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::bar_on_sheet;
using testing::Random;

/// (lateral, z) of bars that lie on a side and have sides at the jaws: regular ones, and
/// boxes with their edges cut off.
std::vector<Vec2> section_of_bar(int index, Random& random) {
  std::vector<Vec2> section;
  if (index % 2 == 0) {
    const int sides = 4 + 4 * (index % 3);
    for (int i = 0; i < sides; ++i) {
      const double angle = kPi + (2 * i + 1) * kPi / sides;
      section.push_back(0.015 / std::cos(kPi / sides) *
                        Vec2(std::cos(angle), std::sin(angle)));
    }
    return section;
  }
  const Vec2 half(random.in(0.01, 0.02), random.in(0.01, 0.02));
  const Vec2 flat(random.in(0.2, 0.9) * half.x(), random.in(0.2, 0.9) * half.y());
  for (const Vec2& quarter : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)}) {
    const Vec2 aside = quarter.cwiseProduct(Vec2(half.x(), flat.y()));
    const Vec2 above = quarter.cwiseProduct(Vec2(flat.x(), half.y()));
    const bool first_aside = quarter.x() * quarter.y() > 0.0;
    section.push_back(first_aside ? aside : above);
    section.push_back(first_aside ? above : aside);
  }
  return section;
}

Scene bar(const std::vector<Vec2>& section, Axis axis) {
  Scene scene = bar_on_sheet();
  scene.object.shape = PrismShape{section, 0.1, axis};
  scene.start.X_HO = {};
  if (axis == Axis::kY) {
    scene.pushers[0].normal_angle = 0.0;
    scene.pushers[0].faces = {"-x"};
    scene.gripper.pad = RectanglePad{{0.002, 0.03}};
  }
  return scene;
}

struct Foot {
  double height = 0.0;  // of the lowest points [m]
  std::vector<Vec3> points;
};

Foot foot_of(const Model& model, const PushContact& contact,
             const Eigen::Isometry3d& pose) {
  Foot foot{.height = kInfinity};
  for (const Vec2& p : model.prism->section) {
    const Vec2 lateral = p.x() * model.prism->lateral;
    const Vec3 at = pose * Vec3(lateral.x(), lateral.y(), p.y());
    const double height = contact.n.dot(at.head<2>() - contact.a);
    if (height < foot.height - 1e-9) foot.points.clear();
    if (height < foot.height + 1e-9) foot.points.push_back(at);
    foot.height = std::min(foot.height, height);
  }
  return foot;
}

/// On the support all along, where nothing slides, and as far as the circumference says.
TEST(PrismPath, TipsOverEdgesThatDoNotSlide) {
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    const Model model =
        prepare(bar(section_of_bar(i, random), i % 4 < 2 ? Axis::kX : Axis::kY));
    const PushContact& contact = model.contacts[0];
    const double turns = random.chance(0.5) ? 1.0 : -1.0 - i % 3;
    const double dpsi = turns * model.prism->same_after;
    const PrismPath path(model, contact, dpsi);
    constexpr int kLooks = 400;
    for (int k = 0; k <= kLooks; ++k) {
      const double s = static_cast<double>(k) / kLooks;
      const Eigen::Isometry3d pose = path.at(s);
      const Foot foot = foot_of(model, contact, pose);
      EXPECT_NEAR(foot.height, 0.0, 1e-12);
      EXPECT_NEAR(Eigen::AngleAxisd(pose.linear()).angle(),
                  std::abs(std::remainder(s * dpsi, 2.0 * kPi)), 1e-7);
      if (foot.points.size() > 1) continue;
      const double ds = 1e-7;
      const Vec3 moved =
          (path.at(s + ds) * pose.inverse() * foot.points[0] - foot.points[0]) / ds;
      EXPECT_LT(moved.norm(), 1e-6 * path.length()) << i << ' ' << s;
    }
    const Vec3 end = path.at(1.0).translation();
    const Vec2 along_z = perp(contact.n);
    const double sense = dpsi * along_z.dot(model.prism->axis) > 0.0 ? -1.0 : 1.0;
    const double way = model.roll_radius * std::abs(dpsi);
    EXPECT_NEAR((end - Vec3(0.0, 0.0, sense * way)).norm(), 0.0, 1e-12) << i;
  }
}

/// The primitive knows the way by its own laws: O rises in the hand as it does over the
/// support, and the support travels as far as the object does.
TEST(PrismPath, IsTheWayOfTheRollPrimitive) {
  const Model model = prepare(bar_on_sheet());
  for (const double travel : {0.03, -0.03, 0.06}) {
    const Grasp& start = model.scene.start;
    Plan plan;
    plan.start = start;
    const double sense = travel * model.contacts[0].t.dot(model.prism->axis);
    ASSERT_TRUE(insert_roll(model, std::copysign(travel / model.roll_radius, sense),
                            Margin::none(), {}, plan));
    const auto roll = std::get<Roll>(plan.pushes[0].push);
    EXPECT_NEAR(roll.travel, travel, 1e-12);
    std::vector<Sample> trace;
    const Transition done = apply(model, start, roll, {}, &trace);
    ASSERT_TRUE(done.completed());
    const double dpsi = done.end.psi - start.psi;
    const PrismPath path(model, model.contacts[0], dpsi);
    for (const Sample& sample : trace) {
      const double s = (sample.grasp.psi - start.psi) / dpsi;
      EXPECT_NEAR(path.at(s).translation().y(), sample.grasp.X_HO.y - start.X_HO.y, 1e-9);
    }
    EXPECT_NEAR(path.at(1.0).translation().z(), -travel, 1e-9);
  }
}

}  // namespace
}  // namespace prehensile
