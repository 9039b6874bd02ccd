#include "planner/steering/steering.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "planner/geometry/segment.h"
#include "primitives/uncertainty.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "scene/constants.h"
#include "tests/planner/walled_scene.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::near;
using testing::Random;
using testing::random_state;
using testing::scene_with;
using testing::sticking_moves;

TEST(Steering, MoveSticksExactlyWhereTheIntervalSaysSo) {
  const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  ASSERT_TRUE(search.exact_everywhere);
  ASSERT_EQ(search.contacts.size(), 3u);
  Random random(1);
  Work work{.budget = kNoBudget};
  int sticks = 0;
  for (int i = 0; i < 200'000; ++i) {
    const FlatState from = random_state(random);
    const FlatState to = near(from, random);
    const int contact = random.below(3);
    const StickContact& stick = search.contacts[contact].stick;
    const Vec2 d = to.p_OF - from.p_OF;
    const double kappa = model.c * (to.theta - from.theta) / d.norm();
    const bool interval =
        robust_kappas(stick, from.p_OF, -d.normalized(), search.margin).contains(kappa);
    const Vec2& g_O = model.contacts[contact].g_O;
    const bool expected = interval && segment_on_object(model, from.p_OF, to.p_OF) &&
                          holding_slack(model, from.p_OF, g_O, search.margin) > 0.0 &&
                          holding_slack(model, to.p_OF, g_O, search.margin) > 0.0;
    const bool answer = move_sticks(search, contact, from, to, work);
    EXPECT_EQ(answer, expected);
    sticks += answer;
  }
  EXPECT_GT(sticks, 5000);
  EXPECT_EQ(work.stick_tests, 200'000);
}

TEST(Steering, EndsOfTheIntervalStick) {
  const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{}));
  for (const Margin& margin : {Margin::none(), Margin{}}) {
    const SearchModel search = prepare_search(model, margin);
    Random random(2);
    Work work{.budget = kNoBudget};
    int ends = 0;
    for (int i = 0; i < 20'000; ++i) {
      const FlatState from{random.in_box(0.02, 0.02), random.in(-3.0, 3.0)};
      const Vec2 d = random.in_disc(0.02);
      const KappaSet set =
          robust_kappas(search.contacts[0].stick, from.p_OF, -d.normalized(), margin);
      for (int k = 0; k < set.count; ++k) {
        for (const double kappa : {set.intervals[k].lo, set.intervals[k].hi}) {
          if (std::isinf(kappa)) continue;
          const FlatState to{from.p_OF + d, from.theta + kappa * d.norm() / model.c};
          EXPECT_TRUE(move_sticks(search, 0, from, to, work));
          ++ends;
        }
      }
    }
    EXPECT_GT(ends, 10'000);
  }
}

TEST(Steering, IsDirected) {
  const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = kNoBudget};
  // The wall stands at the face -x: the object moves along +x, the finger along -x in it.
  const FlatState from{{0.02, 0.0}, 0.0};
  const FlatState to{{0.0, 0.0}, 0.0};
  const std::optional<Move> move = direct_move(search, from, to, work);
  ASSERT_TRUE(move);
  EXPECT_EQ(move->contact, 0);
  EXPECT_FALSE(direct_move(search, to, from, work));
  EXPECT_FALSE(direct_move(search, from, from, work));
  EXPECT_FALSE(move_sticks(search, 0, from, from, work));
}

TEST(Steering, PreferredContactGoesFirst) {
  Scene scene = scene_with(DiscPad{0.009}, LineFeature{});
  scene.pushers.push_back(scene.pushers[0]);  // rougher than the first, and later
  scene.pushers.back().name = "rough";
  scene.pushers.back().friction = 1.2;
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = kNoBudget};
  Random random(3);
  int shared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const FlatState from = random_state(random);
    const FlatState to = near(from, random);
    const std::optional<Move> any = direct_move(search, from, to, work);
    for (int contact = 0; contact < 4; ++contact) {
      const std::optional<Move> move = direct_move(search, from, to, work, contact);
      EXPECT_EQ(move.has_value(), any.has_value());
      if (!move) continue;
      EXPECT_TRUE(move_sticks(search, move->contact, from, to, work));
      const bool does = move_sticks(search, contact, from, to, work);
      EXPECT_EQ(does, move->contact == contact);
      shared += does && contact != any->contact;
    }
  }
  EXPECT_GT(shared, 100);
}

TEST(Steering, NearlyPureTurnsAreTurns) {
  // A pure turn needs no force, only a moment: the floor gives it by carrying the weight.
  Scene scene = scene_with(DiscPad{0.009}, LineFeature{});
  scene.object.mass = 1.5;
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = kNoBudget};
  Random random(4);
  int sticks = 0;
  for (int i = 0; i < 5000; ++i) {
    const FlatState from = random_state(random);
    const double turn = random.in(-1.0, 1.0);
    const FlatState pure{from.p_OF, from.theta + turn};
    for (int contact = 0; contact < 3; ++contact) {
      const StickTest test = stick_test(search.contacts[contact].stick, model.F,
                                        from.p_OF, {1.0, 0.0}, 0.0, turn);
      if (std::abs(test.slack) < 1e-6) continue;
      const bool turns = move_sticks(search, contact, from, pure, work);
      sticks += turns;
      for (const double length : {1e-9, 1e-12, 1e-15, 1e-300}) {
        const FlatState nearly{from.p_OF + length * random.direction(), pure.theta};
        EXPECT_EQ(move_sticks(search, contact, from, nearly, work), turns);
      }
    }
  }
  EXPECT_GT(sticks, 100);
}

TEST(Steering, PushEndsWhereTheMoveEnds) {
  const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Move move{random.below(3), random_state(random), random_state(random)};
    const LinearPush push = push_of(search, move);
    EXPECT_EQ(push.contact, search.contacts[move.contact].contact);
    EXPECT_NEAR(push.e.norm(), 1.0, 1e-12);
    // P coincides with O at the start, and the finger axis runs along -e in P.
    const FlatState end{move.from.p_OF - push.travel * push.e,
                        move.from.theta + push.turn};
    EXPECT_NEAR((end.p_OF - move.to.p_OF).norm(), 0.0, 1e-12);
    EXPECT_NEAR(end.theta, move.to.theta, 1e-12);
    const PlanarPose X_HO = pose_along(move.from, move.to, 1.0);
    EXPECT_NEAR((finger_in_object(X_HO) - move.to.p_OF).norm(), 0.0, 1e-12);
    EXPECT_EQ(X_HO.theta, move.to.theta);
  }
}

TEST(Steering, MovesOfOtherPadsSurviveADenseCheck) {
  struct Case {
    Pad pad;
    const char* name;
    Overhang overhang;
  };
  const Case cases[] = {
      {RectanglePad{{0.01, 0.02}}, "rectangle 1:2", Overhang::kIgnore},
      {RectanglePad{{0.01, 0.02}}, "rectangle, clipped", Overhang::kClip},
      {LinePad{0.02, 0.3}, "line", Overhang::kIgnore},
      {DiscPad{0.009}, "disc, clipped", Overhang::kClip}};
  for (const Case& c : cases) {
    Scene scene = scene_with(c.pad, LineFeature{}, true);
    scene.overhang = c.overhang;
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin{});
    EXPECT_FALSE(search.exact_everywhere);
    const std::vector<Move> moves = sticking_moves(search, 300, 6);
    ASSERT_GT(moves.size(), 100u) << c.name;
    Work work{.budget = kNoBudget};
    double worst = std::numeric_limits<double>::infinity();
    int negative = 0;
    for (const Move& move : moves) {
      SearchModel nominal = search;
      nominal.margin = Margin::none();
      const double slack = move_slack(nominal, move, 400, work);
      worst = std::min(worst, slack);
      negative += move_slack(search, move, 400, work) < -1e-9;
    }
    std::printf(
        "%-20s %3zu moves, nominal slack at 400 points >= %.3f, robust one below "
        "zero between the checks in %d\n",
        c.name, moves.size(), worst, negative);
    EXPECT_GT(worst, 0.0) << c.name;
  }
}

TEST(Steering, DiscMovesSurviveTheRealPad) {
  const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  const std::vector<Move> moves = sticking_moves(search, 2000, 7);
  ASSERT_EQ(moves.size(), 2000u);
  SearchModel nominal = search;
  nominal.margin = Margin::none();
  Work work{.budget = kNoBudget};
  int nominal_fails = 0;
  int box_fails = 0;
  for (const Move& move : moves) {
    nominal_fails += move_slack(nominal, move, 20, work) < 0.0;
    box_fails += move_slack(search, move, 20, work) < 0.0;
  }
  std::printf(
      "closed form with margin against the real disc: %d of 2000 random moves fail "
      "nominally, %d with the margin again\n",
      nominal_fails, box_fails);
  EXPECT_LE(nominal_fails, 10);
}

TEST(Steering, MovesArriveWhenThePushIsApplied) {
  struct Case {
    Pad pad;
    const char* name;
    PusherFeature feature;
  };
  const Case cases[] = {{DiscPad{0.009}, "disc, walls", LineFeature{}},
                        {DiscPad{0.009}, "disc, short edges", LineFeature{0.03}},
                        {RectanglePad{{0.01, 0.02}}, "rectangle, walls", LineFeature{}}};
  for (const Case& c : cases) {
    const Model model = prepare(scene_with(c.pad, c.feature, true));
    const SearchModel search = prepare_search(model, Margin{});
    const std::vector<Move> moves = sticking_moves(search, 200, 10);
    ASSERT_EQ(moves.size(), 200u);
    SearchModel nominal = search;
    nominal.margin = Margin::none();
    Work work{.budget = kNoBudget};
    int arrived = 0;
    for (const Move& move : moves) {
      const Grasp start{pose_along(move.from, move.to, 0.0)};
      const Transition transition = apply(model, start, push_of(search, move));
      const PlanarPose wanted = pose_along(move.from, move.to, 1.0);
      const PlanarPose& end = transition.end.X_HO;
      const double error = std::hypot(end.x - wanted.x, end.y - wanted.y);
      const bool arrives = transition.completed() && transition.slipped == 0.0 &&
                           error < 1e-9 && std::abs(end.theta - wanted.theta) < 1e-9;
      // The closed form may be wrong about a real disc; the pad check is not.
      EXPECT_EQ(arrives, move_slack(nominal, move, 100, work) >= 0.0);
      arrived += arrives;
    }
    std::printf("%-20s %d of 200 moves arrive without slip\n", c.name, arrived);
    EXPECT_GE(arrived, 190) << c.name;
  }
}

/// Faces of polygons are as long as rounding leaves them.
TEST(Steering, PointsAreNeverBesideTheirFace) {
  int points = 0;
  for (std::uint64_t index = 0; index < 100; ++index) {
    const auto problem = random_fixture({.object = FixtureObject::kConcave,
                                         .pushers = FixturePushers::kPoints,
                                         .goals = GoalsFrom::kRandom},
                                        4, index);
    const Model model = prepare(problem->scene);
    const Grasp& grasp = problem->scene.start;
    for (const SearchContact& contact : prepare_search(model, Margin::none()).contacts) {
      if (!model.contacts[contact.contact].is_point) continue;
      for (const double place : {contact.place_low, contact.place_high}) {
        LinearPush push;
        push.contact = contact.contact;
        push.place = place;
        push.e = contact.stick.n;
        push.travel = 1e-6;
        EXPECT_NE(apply(model, grasp, push).reason, "the pusher stands beside the face");
        ++points;
      }
    }
  }
  EXPECT_GT(points, 200);
}

TEST(Steering, NeedsNoHeap) {
  Scene scene = scene_with(RectanglePad{{0.01, 0.02}}, PointFeature{}, true);
  scene.overhang = Overhang::kClip;
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Random random(9);
  Work work{.budget = kNoBudget};
  int found = 0;
  const testing::NoHeapScope scope;
  for (int i = 0; i < 20'000; ++i) {
    const FlatState from = random_state(random);
    const auto move = direct_move(search, from, near(from, random), work);
    if (!move) continue;
    ++found;
    (void)push_of(search, *move);
    (void)move_slack(search, *move, 5, work);
  }
  const long allocations = scope.allocations();
  EXPECT_LE(allocations, 0);
  EXPECT_GT(found, 0);
}

/// Off its way by what the margin says there, in any direction, the finger axis is on the
/// object; and what asks for the same all along the way refuses some of these paths.
TEST(Steering, PathsKeepTheRoomThatTheirDriftNeeds) {
  const Model model = prepare(published_tee(3));
  Random random(8);
  int kept = 0;
  int longer = 0;
  for (int i = 0; i < 4000; ++i) {
    const PathEnd from{random.in_box(0.05, 0.05)};
    const PathEnd to{random.in_box(0.05, 0.05)};
    Margin margin = Margin::none();
    margin.grasp = random.in(0.0, 3e-3);
    margin.tilt = random.in(0.0, 0.05);
    const Vec2 d = to.p_OF - from.p_OF;
    if (!path_on_object(model, from, to, margin)) continue;
    ++kept;
    const double most = margin.grasp + margin.tilt * d.norm();
    longer += distance_to_border(model.pad_face, from.p_OF, to.p_OF) < most;
    for (int k = 0; k <= 40; ++k) {
      const double s = k / 40.0;
      const double off = margin.grasp + margin.tilt * s * d.norm();
      const Vec2 aside = rotated(random.in(-kPi, kPi), {off * (1.0 - 1e-6), 0.0});
      EXPECT_TRUE(contains(model.pad_face, from.p_OF + s * d + aside)) << i;
    }
  }
  EXPECT_GT(kept, 500);
  EXPECT_GT(longer, 20);
}

/// An end that is given excuses what is near it, and no corner far away.
TEST(Steering, AGivenEndExcusesThePathNearItOnly) {
  const Model model = prepare(published_tee(3));
  Random random(9);
  Margin margin = Margin::none();
  margin.grasp = 2e-3;
  int excused = 0;
  for (int i = 0; i < 4000; ++i) {
    const PathEnd from{random.in_box(0.05, 0.05), random.chance(0.5)};
    const PathEnd to{random.in_box(0.05, 0.05), random.chance(0.5)};
    if (!path_on_object(model, from, to, margin)) continue;
    const double length = (to.p_OF - from.p_OF).norm();
    for (int k = 0; k <= 40; ++k) {
      const double s = k / 40.0;
      const Vec2 p_OF = from.p_OF + s * (to.p_OF - from.p_OF);
      double needed = margin.grasp;
      // The way from an end counts by eighths of the path.
      const auto excuse = [&](const PathEnd& end, double way) {
        if (!end.given) return;
        const double of_end = distance_to_border(model.pad_face, end.p_OF, end.p_OF);
        needed = std::min(needed, std::max(0.0, way - length / 8.0) + of_end);
      };
      excuse(from, s * length);
      excuse(to, (1.0 - s) * length);
      excused += needed < margin.grasp;
      EXPECT_GE(distance_to_border(model.pad_face, p_OF, p_OF), needed - 1e-8) << i;
    }
  }
  EXPECT_GT(excused, 100);
}

/// Only a margin over discs is kept by the ellipsoid otherwise than by rings.
TEST(Steering, IsOverTheEllipsoidWhereAMarginIsKeptOverDiscs) {
  const Scene discs = published_square(0);
  const Model model = prepare(discs);
  const auto ellipsoid = over_ellipsoid(prepare_search(model, Margin{}));
  ASSERT_TRUE(ellipsoid);
  EXPECT_FALSE(ellipsoid->rings);
  EXPECT_EQ(ellipsoid->margin.friction, Margin{}.friction);
  EXPECT_FALSE(over_ellipsoid(prepare_search(model, Margin::none())));
  const Model soft = prepare(with_soft_points(discs));
  EXPECT_FALSE(over_ellipsoid(prepare_search(soft, Margin{})));
}

TEST(Steering, KnowsWhetherAnyPusherIsAPoint) {
  Scene scene = published_square(0);
  const Model lines = prepare(scene);
  EXPECT_FALSE(has_points(prepare_search(lines, Margin{})));
  scene.pushers[0].feature = PointFeature{};
  const Model one = prepare(scene);
  EXPECT_TRUE(has_points(prepare_search(one, Margin{})));
}

}  // namespace
}  // namespace prehensile
