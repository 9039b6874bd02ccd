#include "planner/run_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "planner/ring_pads.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::Random;
using testing::random_kappa;
using testing::random_law_scene;
using testing::slack_of_pads;
using testing::with_square_pads;

constexpr double kPi = std::numbers::pi;

/// Sums the pads' friction for the motion (e, omega) at this angle of the object, over F.
struct Drag {
  double along, across, moment;
};
Drag drag_of(const Model& model, double theta, const Vec2& e, double omega) {
  const ContactPoints points = model.region.at(pose_from_finger({0.0, 0.0}, theta));
  const Vec2 e_H = rotated(theta, e);
  Vec2 force = Vec2::Zero();
  double moment = 0.0;
  for (int j = 0; j < points.count; ++j) {
    const Vec2 r(points.x[j], points.y[j]);
    const Vec2 slip = e_H + omega * perp(r);
    const Vec2 f = points.weight[j] * slip.normalized();
    force += f;
    moment += cross(r, f);
  }
  return {force.dot(e_H), std::abs(cross(e_H, force)), moment};
}

/// Whether a cell holds a drag. Cells of kappa and -kappa have the same sigma.
bool is_held(const PadSection& section, const Drag& drag, double kappa, double c) {
  const double sigma = std::hypot(1.0, kappa);
  const double turning = drag.moment / (c * drag.along) / sigma;
  return std::any_of(section.cells.begin(), section.cells.end(),
                     [&](const SectionCell& cell) {
                       return sigma >= cell.sigma_low && sigma <= cell.sigma_high &&
                              drag.along * sigma >= cell.drag_low &&
                              drag.along * sigma <= cell.drag_high &&
                              drag.across / drag.along <= cell.deviation + 1e-9 &&
                              turning >= cell.turning_low && turning <= cell.turning_high;
                     });
}

TEST(PadSection, HoldsTheFrictionBetweenItsSamples) {
  Random random(1);
  for (const int points : {16, 64}) {
    const Model model =
        prepare(with_square_pads(published_square(0)), {.points_per_pad = points});
    const PadSection section = pad_section(model);
    ASSERT_FALSE(section.cells.empty());
    for (int i = 0; i < 20'000; ++i) {
      const double kappa = random_kappa(random);
      const Drag drag = drag_of(model, random.in(-kPi, kPi), {1.0, 0.0}, kappa / model.c);
      EXPECT_TRUE(is_held(section, drag, kappa, model.c)) << points << " " << kappa;
    }
  }
}

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
      }
    }
  }
}

struct Tally {
  int sticking = 0, edges_near = 0, ends_near = 0, turns_near = 0;
};

/// One instant that sticks with the pads themselves obeys the law; `weightless`: that
/// sticks without gravity as well.
void check_instant(const Model& model, const RunLaws& laws, bool weightless,
                   Random& random, Tally& tally) {
  const int j = random.below(static_cast<int>(model.contacts.size()));
  const PushContact& contact = model.contacts[j];
  const RunLaw& law = laws.contacts[j];
  const double lean = std::atan(contact.mu) + random.in(-0.3, 0.3);
  const Vec2 e = random.chance(0.5)
                     ? rotated(random.chance(0.5) ? lean : -lean, contact.n)
                     : rotated(random.in(-kPi, kPi), Vec2(1.0, 0.0));
  const double kappa = random_kappa(random);
  const Vec2 p_OF = random.in_box(0.05, 0.05);
  const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-kPi, kPi));
  const auto sticks = [&](const PushContact& pushed) {
    return slack_of_pads(model, pushed, X_HO, e, kappa) >= 0.0;
  };
  if (!sticks(contact)) return;
  PushContact floating = contact;
  floating.g_O.setZero();
  if (weightless && !sticks(floating)) return;
  ++tally.sticking;
  const double dT = std::hypot(1.0, kappa);
  for (int k = 0; k < 2; ++k) {
    const double spare = law.w[k].dot(e) + law.back[k] * dT;
    EXPECT_GE(spare, -1e-9) << kappa;
    if (spare < 0.05 * dT) ++tally.edges_near;
  }
  const Vec2 dp = -e;
  double least = std::numeric_limits<double>::infinity();
  for (int set = 0; set < RunLaw::kSets; ++set) {
    const double turned = laws.C[set] * kappa / model.c;
    const auto slack = [&](const EndLaw& end) {
      return (end.per_travel + end.slope * (p_OF - end.place).norm()) * dT + end.per_path;
    };
    const EndLaw& low = law.end[set][0];
    const EndLaw& high = law.end[set][1];
    const double above = turned - cross(p_OF - low.place, dp) + slack(low);
    const double below = cross(p_OF - high.place, dp) + slack(high) - turned;
    EXPECT_GE(above, -1e-9) << kappa;
    EXPECT_GE(below, -1e-9) << kappa;
    least = std::min({least, above, below});
  }
  if (least < 3e-3 * dT) ++tally.ends_near;
  if (advance_of(contact, p_OF, e, kappa / model.c) < 0.0) return;
  const double at = law.t.dot(p_OF);
  for (const double turn : {kappa / model.c, -kappa / model.c}) {
    const double beside = turn == kappa / model.c ? law.face[0] - at : at - law.face[1];
    if (beside <= 0.0) continue;
    const double spare = law.n.dot(e) + law.retreat() * dT - turn * beside;
    EXPECT_GE(spare, -1e-9) << kappa;
    if (spare < 0.1 * dT) ++tally.turns_near;
  }
}

void check_instants(int scenes, int instants, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = random_law_scene(random);
    const Model model = prepare(scene, {.points_per_pad = random.chance(0.7) ? 16 : 64});
    const bool weightless = random.chance(0.3);
    const RunLaws laws = run_laws(model, weightless);
    ASSERT_FALSE(laws.empty());
    for (int k = 0; k < instants; ++k) {
      check_instant(model, laws, weightless, random, tally);
    }
  }
  EXPECT_GT(tally.sticking, scenes * instants / 20);
  EXPECT_GT(tally.edges_near, tally.sticking / 100);
  EXPECT_GT(tally.ends_near, tally.sticking / 1000);
  EXPECT_GT(tally.turns_near, tally.sticking / 10'000);
}

TEST(RunLaws, HoldAtEveryInstantThatSticks) { check_instants(100, 4000, 2); }

TEST(RunLaws, FullHoldAtEveryInstantThatSticks) { check_instants(2000, 20'000, 3); }

/// Gravity along a wall that is greater than all friction: no motion by it sticks.
TEST(RunLaws, OfAContactThatGravityOverpowersAllowNothing) {
  Scene scene = published_square(0);
  scene.gripper.grip_force = 0.5;
  scene.g_W = {0.0, -9.81};
  const Model model = prepare(scene);
  const RunLaws laws = run_laws(model);
  int overpowered = 0;
  for (const RunLaw& law : laws.contacts) {
    for (const auto& set : law.end) {
      for (const EndLaw& end : set) {
        EXPECT_TRUE(end.place.allFinite());
        EXPECT_TRUE(std::isfinite(end.per_travel + end.slope + end.per_path));
      }
    }
    const bool nothing =
        law.back[0] == -law.w[0].norm() && law.back[1] == -law.w[1].norm();
    overpowered += nothing ? 1 : 0;
  }
  EXPECT_GT(overpowered, 0);
}

TEST(RunLaws, AreNotMadeForPadsThatChange) {
  Scene scene = published_square(0);
  scene.overhang = Overhang::kClip;
  EXPECT_TRUE(run_laws(prepare(scene)).empty());
  scene.overhang = Overhang::kIgnore;
  scene.gripper.pad = RectanglePad{{0.02, 0.01}};
  EXPECT_TRUE(run_laws(prepare(scene)).empty());
}

}  // namespace
}  // namespace prehensile
