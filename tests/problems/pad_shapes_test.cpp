#include "problems/pad_shapes.h"

#include <gtest/gtest.h>

#include "mechanics/model.h"
#include "problems/published_regrasps.h"

namespace prehensile {
namespace {

TEST(PadShapes, HaveTheTorqueRadiusOfTheOldPads) {
  const Scene discs = published_square(0);
  for (const std::string_view shape : kPadShapes) {
    const Scene scene = with_pads(discs, shape);
    EXPECT_NE(scene.gripper.pad.index(), discs.gripper.pad.index()) << shape;
    EXPECT_NEAR(prepare(scene).c, prepare(discs).c, 1e-7) << shape;
  }
}

/// Otherwise the friction of a pad that turns on the spot would push as well.
TEST(PadShapes, PressAboutTheFingerAxis) {
  for (const std::string_view shape : kPadShapes) {
    const Model model = prepare(with_pads(published_square(0), shape));
    const ContactPoints& pad = model.region.whole();
    Vec2 centre = Vec2::Zero();
    for (int i = 0; i < pad.count; ++i) {
      centre += pad.weight[i] * Vec2(pad.x[i], pad.y[i]);
    }
    EXPECT_LT(centre.norm(), 1e-9) << shape;
  }
}

TEST(PadShapes, AreKnownByName) {
  for (const std::string_view shape : kPadShapes) EXPECT_TRUE(is_pad_shape(shape));
  EXPECT_FALSE(is_pad_shape("disc"));
  EXPECT_FALSE(is_pad_shape(""));
}

}  // namespace
}  // namespace prehensile
