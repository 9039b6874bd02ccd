#include "planner/pads/pad_section.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/pads/ring_pads.h"
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

/// The points of a disc at so many angles of the object that they fill their circles.
Drag spread_drag(const Model& model, double kappa) {
  constexpr int kAngles = 2000;
  Drag mean{};
  for (int k = 0; k < kAngles; ++k) {
    const Drag drag =
        drag_of(model, 2.0 * kPi * (k + 0.5) / kAngles, {1.0, 0.0}, kappa / model.c);
    mean.along += drag.along / kAngles;
    mean.moment += drag.moment / kAngles;
  }
  return mean;
}

TEST(PadSection, OfADiscHoldsTheFrictionOfItsCircles) {
  Random random(4);
  for (const int points : {8, 16, 64}) {
    for (const double edge_load : {0.0, 1.0}) {
      Scene scene = published_square(0);
      scene.gripper.pressure.edge_load = edge_load;
      const Model model = prepare(scene, {.points_per_pad = points});
      const PadSection section = pad_section(model);
      for (int i = 0; i < 40; ++i) {
        const double kappa = random_kappa(random);
        const Drag drag = spread_drag(model, kappa);
        const RingFriction ring =
            ring_friction(model.region.whole(), model.c, std::atan(std::abs(kappa)));
        // Close to a circle the mean of the samples is good to its spacing.
        EXPECT_NEAR(ring.along, drag.along, 2e-3) << kappa;
        EXPECT_NEAR(std::copysign(ring.moment, kappa), drag.moment, 2e-3 * model.c);
        const Drag exact{ring.along, 0.0, std::copysign(ring.moment, kappa)};
        EXPECT_TRUE(is_held(section, exact, kappa, model.c)) << kappa;
        EXPECT_TRUE(is_boxed(section, exact, kappa, model.c)) << kappa;
      }
    }
  }
}

}  // namespace
}  // namespace prehensile
