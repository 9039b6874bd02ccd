#include "problems/pad_shapes.h"

#include <gtest/gtest.h>

#include "mechanics/model.h"
#include "problems/published_regrasps.h"

namespace prehensile {
namespace {

Scene square_with(std::string_view shape) {
  return with_pads(published_square(0), *pad_of_shape(shape));
}

TEST(PadShapes, HaveTheTorqueRadiusOfTheOldPads) {
  const double expected = prepare(published_square(0)).c;
  for (const std::string_view shape : kPadShapes) {
    const Scene scene = square_with(shape);
    const bool is_polygon = std::holds_alternative<PolygonPad>(scene.gripper.pad);
    EXPECT_EQ(is_polygon, shape == "half_disc");
    const double tolerance = is_polygon ? 1e-5 : 1e-12;
    EXPECT_NEAR(prepare(scene).c, expected, tolerance * expected) << shape;
  }
}

/// Otherwise the friction of a pad that turns on the spot would push as well.
TEST(PadShapes, PressAboutTheFingerAxis) {
  for (const std::string_view shape : kPadShapes) {
    const Model model = prepare(square_with(shape));
    const ContactPoints& pad = model.region.whole();
    Vec2 centre = Vec2::Zero();
    for (int i = 0; i < pad.count; ++i) {
      centre += pad.weight[i] * Vec2(pad.x[i], pad.y[i]);
    }
    EXPECT_LT(centre.norm(), 1e-9) << shape;
  }
}

TEST(PadShapes, HaveNoOtherNames) {
  EXPECT_FALSE(pad_of_shape("disc"));
  EXPECT_FALSE(pad_of_shape(""));
}

}  // namespace
}  // namespace prehensile
