#include "planner/walks/place_law.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/pad_drag.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

bool holds(const KappaRanges& ranges, double kappa) {
  for (int i = 0; i < ranges.count; ++i) {
    const auto [lo, hi] = ranges.intervals[static_cast<std::size_t>(i)];
    if (kappa >= lo && kappa <= hi) return true;
  }
  return false;
}

KappaRanges ranges_at(const Model& model, const StickContact& stick, const Vec2& p_OF,
                      const Vec2& e) {
  const PadsAtPlace pads(model, p_OF);
  DirectedDrag drag(model, pads, e);
  return drag.kappas(stick, p_OF);
}

/// Over soft points the closed form knows the intervals.
TEST(PlaceLaw, OfSoftPointsIsTheClosedForm) {
  Random random(1);
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 1500; ++i) {
    const Model model =
        prepare(with_soft_points(published_square(random.below(kPublishedRegrasps))));
    const SearchModel search = prepare_search(model, Margin::none());
    const int contact = random.below(static_cast<int>(search.contacts.size()));
    const StickContact& stick = search.contacts[static_cast<std::size_t>(contact)].stick;
    const Vec2 p_OF = random.in_box(0.04, 0.04);
    const Vec2 e = rotated(random.in(-1.0, 1.0), stick.n);
    const KappaRanges ranges = ranges_at(model, stick, p_OF, e);
    const auto slack_at = [&](double kappa) {
      return stick_test(stick, model.F, p_OF, e, 1.0, kappa / model.c).slack;
    };
    for (int k = 0; k < ranges.count; ++k) {
      const auto [lo, hi] = ranges.intervals[static_cast<std::size_t>(k)];
      EXPECT_GT(slack_at(lo), 0.0);
      EXPECT_GT(slack_at(hi), 0.0);
    }
    const double kappa = std::tan(random.in(-1.2, 1.2));
    const double slack = slack_at(kappa);
    if (slack > 0.02) {
      ++inside;
      EXPECT_TRUE(holds(ranges, kappa)) << kappa << " slack " << slack;
    } else if (slack < 0.0) {
      ++outside;
      EXPECT_FALSE(holds(ranges, kappa)) << kappa << " slack " << slack;
    }
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

/// Discs on a square, which clips them at its border.
struct ClippedDiscs {
  Model model = prepare([] {
    Scene scene = testing::walled_square();
    scene.overhang = Overhang::kClip;
    return scene;
  }());
  SearchModel search = prepare_search(model, Margin::none());

  const SearchContact& random_pusher(Random& random) const {
    return search.contacts[random.below(static_cast<int>(search.contacts.size()))];
  }

  /// Of the real pads, at one pose.
  double slack(const SearchContact& pusher, const PlanarPose& X_HO, const Vec2& e,
               double kappa) const {
    return exact_stick_test(model, model.contacts[pusher.contact], 0.0, X_HO, e, 1.0,
                            kappa / model.c, Margin::none())
        .slack;
  }
};

/// Friction is the opposite for the opposite motion, whole or clipped.
TEST(PlaceLaw, OppositeIsThatOfMotionsTheOtherWay) {
  Random random(4);
  const ClippedDiscs discs;
  int ranges = 0;
  for (int i = 0; i < 400; ++i) {
    const StickContact& stick = discs.random_pusher(random).stick;
    const Vec2 p_OF = random.in_box(0.0499, 0.0499);
    const Vec2 e = rotated(random.in(-1.0, 1.0), stick.n);
    const PadsAtPlace pads(discs.model, p_OF);
    DirectedDrag back(discs.model, pads, -e);
    const KappaRanges one = back.opposite().kappas(stick, p_OF);
    const KappaRanges other = ranges_at(discs.model, stick, p_OF, e);
    ASSERT_EQ(one.count, other.count);
    for (int k = 0; k < one.count; ++k) {
      ++ranges;
      EXPECT_NEAR(one.intervals[k].lo, other.intervals[k].lo, 1e-9);
      EXPECT_NEAR(one.intervals[k].hi, other.intervals[k].hi, 1e-9);
    }
  }
  EXPECT_GT(ranges, 100);
}

/// What it admits sticks with the real pads at nearly every angle of the object, clipped
/// as the face leaves them, where the closed form is far off.
TEST(PlaceLaw, OfClippedDiscsIsThatOfTheRealPads) {
  Random random(2);
  int admitted = 0;
  int sticking = 0;
  int by_closed_form = 0;
  const ClippedDiscs discs;
  for (int i = 0; i < 4000; ++i) {
    const SearchContact& pusher = discs.random_pusher(random);
    const Vec2 p_OF = random.in_box(0.0499, 0.0499);
    const PlanarPose X_HO = pose_from_finger(p_OF, random.in(-kPi, kPi));
    if (discs.model.region.is_whole(X_HO)) continue;
    const Vec2 e = rotated(random.in(-1.0, 1.0), pusher.stick.n);
    const double kappa = std::tan(random.in(-1.2, 1.2));
    if (!holds(ranges_at(discs.model, pusher.stick, p_OF, e), kappa)) continue;
    ++admitted;
    sticking += discs.slack(pusher, X_HO, e, kappa) >= 0.0;
    const auto closed_form =
        stick_test(pusher.stick, discs.model.F, p_OF, e, 1.0, kappa / discs.model.c);
    by_closed_form += closed_form.slack >= 0.0;
  }
  EXPECT_GT(admitted, 200);
  EXPECT_GE(sticking, 0.97 * admitted);
  EXPECT_LE(by_closed_form, 0.9 * admitted);
}

/// What sticks firmly at all angles of the object it admits, whole or clipped, but where
/// little is left of the pads, and third intervals.
TEST(PlaceLaw, AdmitsWhatSticksFirmly) {
  Random random(6);
  const ClippedDiscs discs;
  int firmly = 0;
  int admitted = 0;
  for (int i = 0; i < 3000; ++i) {
    const SearchContact& pusher = discs.random_pusher(random);
    const Vec2 p_OF = random.in_box(0.0499, 0.0499);
    const Vec2 e = rotated(random.in(-1.0, 1.0), pusher.stick.n);
    const double kappa = std::tan(random.in(-1.2, 1.2));
    double slack = 1.0;
    for (int k = 0; k < 16; ++k) {
      const PlanarPose X_HO = pose_from_finger(p_OF, kPi * k / 8.0);
      slack = std::min(slack, discs.slack(pusher, X_HO, e, kappa));
    }
    if (slack < 0.03) continue;
    ++firmly;
    admitted += holds(ranges_at(discs.model, pusher.stick, p_OF, e), kappa);
  }
  EXPECT_GT(firmly, 200);
  EXPECT_GE(admitted, 0.99 * firmly);
}

TEST(PlaceLaw, OutsideTheConeNothingSticksAnywhere) {
  Random random(7);
  const ClippedDiscs discs;
  const PadsAtPlace whole(discs.model, Vec2::Zero());
  int outside = 0;
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const StickContact& stick = discs.random_pusher(random).stick;
    DirectedDrag drag(discs.model, whole, random.direction());
    const bool is_in_cone = drag.is_in_cone(stick);
    ++(is_in_cone ? inside : outside);
    for (int k = 0; k < 20 && !is_in_cone; ++k) {
      EXPECT_EQ(drag.kappas(stick, random.in_box(0.02, 0.02)).count, 0);
    }
  }
  EXPECT_GT(outside, 50);
  EXPECT_GT(inside, 50);
}

/// In single precision, but for a point about which the object turns nearly.
TEST(PlaceLaw, DragIsThatOfTheRealPads) {
  Random random(5);
  for (const Overhang overhang : {Overhang::kIgnore, Overhang::kClip}) {
    Scene scene = testing::walled_square();
    scene.overhang = overhang;
    const Model model = prepare(scene);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p_OF = random.in_box(0.05, 0.05);
      const PadsAtPlace pads(model, p_OF);
      EXPECT_EQ(pads.are_whole(), PadsAtPlace::are_whole_at(model, p_OF));
      const double angle = random.in(-0.5, 0.5) * kPi;
      const Vec2 velocity = std::cos(angle) * random.direction();
      const double turning = std::sin(angle);
      for (int k = 0; k < pads.angles(); ++k) {
        const double theta = 2.0 * kPi * k / pads.angles();
        const PlanarGrasp grasp =
            grasp_at(model, pose_from_finger(p_OF, theta), Vec2::Zero());
        const PadDrag real =
            drag_of_points(grasp.count, grasp.x, grasp.y, grasp.bound, 1.0,
                           rotated(theta, velocity), turning / model.c);
        const PadDrag drag = pads.drag(k, velocity, turning);
        EXPECT_LT((rotated(theta, drag.force) - real.force / model.F).norm(), 1e-3);
        EXPECT_NEAR(drag.moment, real.moment / (model.F * model.c), 1e-3);
      }
    }
  }
}

TEST(PlaceLaw, CommonRangesAreInBoth) {
  Random random(3);
  const auto ranges = [&] {
    KappaRanges set{.count = 1 + random.below(2)};
    double at = random.in(-2.0, 0.0);
    for (int i = 0; i < set.count; ++i) {
      set.intervals[static_cast<std::size_t>(i)] = {at, at + random.in(0.0, 1.0)};
      at += random.in(1.0, 2.0);
    }
    return set;
  };
  for (int i = 0; i < 500; ++i) {
    const KappaRanges one = ranges();
    const KappaRanges other = ranges();
    const KappaRanges both = common(one, other);
    for (int k = 0; k < 20; ++k) {
      const double kappa = random.in(-2.5, 4.0);
      const bool is_common = holds(one, kappa) && holds(other, kappa);
      if (holds(both, kappa)) {
        EXPECT_TRUE(is_common);
      } else if (is_common) {
        EXPECT_EQ(both.count, 2);
      }
    }
  }
}

TEST(PlaceLaw, PadsBesideTheFaceAreLost) {
  Scene scene = testing::walled_square();
  scene.overhang = Overhang::kClip;
  const Model model = prepare(scene);
  EXPECT_FALSE(PadsAtPlace(model, {0.0, 0.0}).are_lost());
  EXPECT_TRUE(PadsAtPlace(model, {0.0, 0.0}).are_whole());
  EXPECT_FALSE(PadsAtPlace(model, {0.0499, 0.0}).are_whole());
  EXPECT_FALSE(PadsAtPlace(model, {0.0499, 0.0}).are_lost());
  EXPECT_TRUE(PadsAtPlace(model, {0.2, 0.0}).are_lost());
}

}  // namespace
}  // namespace prehensile
