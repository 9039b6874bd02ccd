#include "planner/pads/ring_kappas.h"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/constants.h"
#include "tests/planner/law_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::Random;
using testing::random_margin;

Scene random_scene(Random& random) {
  Scene scene = random.chance(0.5) ? published_square(0) : published_tee(0);
  scene.gripper.grip_force = random.log_in(8.0, 100.0);
  scene.g_W = random.chance(0.4) ? Vec2(0.0, 0.0)
                                 : Vec2(rotated(random.in(-kPi, kPi), {9.81, 0.0}));
  for (auto& pusher : scene.pushers) pusher.friction = random.in(0.1, 1.2);
  return scene;
}

void check_kappas(bool with_margin, std::uint64_t seed) {
  Random random(seed);
  int inside = 0, missed = 0, sticking = 0;
  for (int i = 0; i < 60; ++i) {
    const Model model = prepare(random_scene(random));
    const RingTable table(model);
    for (int k = 0; k < 200; ++k) {
      const PushContact& contact =
          model.contacts[random.below(static_cast<int>(model.contacts.size()))];
      const Vec2 p_OF = random.in_box(0.045, 0.045);
      const Vec2 e = rotated(random.in(-1.2, 1.2), contact.n);
      const Margin margin = with_margin ? random_margin(random) : Margin::none();
      const KappaSet kappas =
          table.kappas(stick_contact(model, contact, 0.0), p_OF, e, margin);
      const auto slack_at = [&](double turn) {
        return ring_slack(model, contact, p_OF, e, 1.0, turn, margin);
      };
      const auto advances = [&](double turn) {
        return advance_of(contact, p_OF, e, turn, margin) >= -1e-9;
      };
      for (int j = 0; j < 20; ++j) {
        const double kappa =
            random.chance(0.5) ? random.in(-3.0, 3.0) : random.in(-30.0, 30.0);
        const double turn = kappa / model.c;
        const double slack = slack_at(turn);
        const bool sticks = slack >= 0.0 && advances(turn);
        sticking += sticks;
        if (kappas.contains(kappa)) {
          ++inside;
          EXPECT_GE(slack, -1e-6) << kappa;
          EXPECT_TRUE(advances(turn)) << kappa;
        } else if (sticks && slack > 5e-2) {  // more than an entry of the table
          ++missed;
        }
      }
      for (int j = 0; j < kappas.count; ++j) {
        for (const double end : {kappas.intervals[j].lo, kappas.intervals[j].hi}) {
          EXPECT_GE(slack_at(end / model.c), -1e-6) << end;
        }
      }
    }
  }
  EXPECT_GT(inside, 5'000);
  EXPECT_EQ(missed, 0);
  EXPECT_GT(inside, 0.95 * sticking);
}

TEST(RingKappas, AreThoseThatStick) { check_kappas(false, 1); }

TEST(RingKappas, AreThoseThatStickOverAMargin) { check_kappas(true, 2); }

}  // namespace
}  // namespace prehensile
