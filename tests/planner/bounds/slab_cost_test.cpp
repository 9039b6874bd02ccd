#include "planner/bounds/slab_cost.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_law_scene;

/// Every instant that sticks costs at least what the slab says, which comes near the
/// cheapest with the steps.
TEST(SlabCost, IsThatOfTheCheapestInstant) {
  Random random(3);
  int cheap = 0, slabs = 0;
  for (int i = 0; i < 60; ++i) {
    const Model model = prepare(random_law_scene(random));
    const LocalLaw law(model);
    const int contact = random.below(static_cast<int>(model.contacts.size()));
    const Slab slab{.u = random.direction(),
                    .low = random.in(-0.03, 0.03),
                    .width = random.log_in(1e-4, 1e-2),
                    .across = {-0.01, 0.01}};
    SlabQuestion question{.first_contact = contact,
                          .end_contact = contact + 1,
                          .share = random.in(-0.9, 0.9),
                          .steps = 0,
                          .as_half_turn = 0.08};
    double before = 0.0;
    for (const int steps : {0, 10, 100, 2000}) {
      question.steps = steps;
      const double cost = least_cost(law, slab, question);
      EXPECT_GE(cost, before);
      before = cost;
    }
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3000; ++k) {
      const Vec2 p_OF = random.in(slab.low, slab.low + slab.width) * slab.u +
                        random.in(slab.across.low, slab.across.high) * perp(slab.u);
      const Vec2 e = rotated(random.in(-1.5, 1.5), -slab.u);
      StickContact stick = stick_contact(model, model.contacts[contact], 0.0);
      const KappaSet kappas = sticking_kappas(stick, p_OF, e);
      if (kappas.empty()) continue;
      const auto& interval = kappas.intervals[0];
      const double low = std::max(interval.lo, -30.0), high = std::min(interval.hi, 30.0);
      if (low > high) continue;
      const double kappa = random.in(low, high);
      const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-3.0, 3.0));
      if (!(testing::slack_of_pads(model, model.contacts[contact], X_HO, e, kappa) >=
            0.0)) {
        continue;
      }
      const double cost =
          (std::hypot(1.0, kappa) - question.share * kappa) / -e.dot(slab.u);
      EXPECT_GE(cost, before * (1.0 - 1e-9)) << i;
      least = std::min(least, cost);
    }
    if (!std::isfinite(least)) continue;
    ++slabs;
    cheap += least < 1.1 * before;
  }
  EXPECT_GT(slabs, 20);
  EXPECT_GT(2 * cheap, slabs);
}

TEST(SlabCost, NothingIsPushedWhereThereIsNoPlace) {
  Random random(4);
  const Model model = prepare(random_law_scene(random));
  const LocalLaw law(model);
  const Slab slab{.u = Vec2::UnitX(), .width = 1e-3, .across = {0.01, -0.01}};
  EXPECT_EQ(least_cost(law, slab, {.end_contact = 1, .steps = 10}),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace prehensile
