#include "planner/pads/point_section.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/constants.h"
#include "tests/planner/law_cases.h"
#include "tests/planner/section_cases.h"

namespace prehensile {
namespace {

using testing::Drag;
using testing::drag_of;
using testing::is_boxed;
using testing::is_held;
using testing::Random;
using testing::random_kappa;
using testing::random_shape_scene;
using testing::with_square_pads;

TEST(PointSection, HoldsTheFrictionBetweenItsSamples) {
  Random random(1);
  for (const int points : {16, 64}) {
    const Model model =
        prepare(with_square_pads(published_square(0)), {.points_per_pad = points});
    const PadSection section = section_of_points(model.region.whole(), model.c);
    ASSERT_FALSE(section.cells.empty());
    for (int i = 0; i < 20'000; ++i) {
      const double kappa = random_kappa(random);
      const Drag drag = drag_of(model, random.in(-kPi, kPi), {1.0, 0.0}, kappa / model.c);
      EXPECT_TRUE(is_held(section, drag, kappa, model.c)) << points << " " << kappa;
    }
  }
}

TEST(PointSection, OfAnyShapeHoldsTheFrictionBetweenItsSamples) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const Model model = prepare(random_shape_scene(random),
                                {.points_per_pad = random.chance(0.7) ? 16 : 64});
    const PadSection section = section_of_points(model.region.whole(), model.c);
    ASSERT_FALSE(section.boxes.empty());
    for (int k = 0; k < 1000; ++k) {
      const double kappa = random_kappa(random);
      const Drag drag = drag_of(model, random.in(-kPi, kPi), {1.0, 0.0}, kappa / model.c);
      EXPECT_TRUE(is_boxed(section, drag, kappa, model.c)) << i << " " << kappa;
    }
  }
}

}  // namespace
}  // namespace prehensile
