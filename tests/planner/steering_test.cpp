#include "planner/steering.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "primitives/uncertainty.h"
#include "problems/random_fixtures.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

/// A square or a T among three walls, as in the published regrasps.
Scene scene_with(const Pad& pad, const PusherFeature& feature, bool tee = false) {
  Scene scene;
  if (tee) {
    const std::vector<Vec2> outline = {{-0.05, -0.05}, {-0.02, -0.05}, {-0.02, -0.015},
                                       {0.05, -0.015}, {0.05, 0.015},  {-0.02, 0.015},
                                       {-0.02, 0.05},  {-0.05, 0.05}};
    scene.object.shape = PrismShape{outline, 0.03};
  } else {
    scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  }
  scene.object.mass = 0.5;
  scene.gripper.pad = pad;
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 25.0;
  scene.overhang = Overhang::kIgnore;
  scene.start.X_HO = pose_from_finger({-0.03, 0.0}, 0.0);
  for (const double angle : {0.0, 0.5 * std::numbers::pi, -0.5 * std::numbers::pi}) {
    Pusher wall;
    wall.name = "wall" + std::to_string(scene.pushers.size());
    wall.feature = feature;
    wall.friction = 0.9;
    wall.normal_angle = angle;
    scene.pushers.push_back(wall);
  }
  return scene;
}

FlatState random_state(Random& random) {
  return {random.in_box(0.05, 0.05), random.in(-3.0, 3.0)};
}

/// A goal near the start: moves of a few millimetres, small and large turns.
FlatState near(const FlatState& from, Random& random) {
  const double turn = (random.chance(0.5) ? 1.0 : -1.0) * random.log_in(1e-3, 3.0);
  return {from.p_OF + random.in_disc(0.03), from.theta + turn};
}

TEST(Steering, MoveSticksExactlyWhereTheIntervalSaysSo) {
  const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  ASSERT_TRUE(search.exact_everywhere);
  ASSERT_EQ(search.contacts.size(), 3u);
  Random random(1);
  Work work{.budget = kUnlimited};
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
    Work work{.budget = kUnlimited};
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
  Work work{.budget = kUnlimited};
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
  Work work{.budget = kUnlimited};
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
  Work work{.budget = kUnlimited};
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

/// Random moves of a scene that stick, at most `wanted`.
std::vector<Move> sticking_moves(const SearchModel& search, int wanted,
                                 std::uint64_t seed) {
  Random random(seed);
  Work work{.budget = kUnlimited};
  std::vector<Move> moves;
  for (int i = 0; i < 200'000 && static_cast<int>(moves.size()) < wanted; ++i) {
    const FlatState from = random_state(random);
    const FlatState to = near(from, random);
    if (const auto move = direct_move(search, from, to, work)) moves.push_back(*move);
  }
  return moves;
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
    Work work{.budget = kUnlimited};
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
  Work work{.budget = kUnlimited};
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
    Work work{.budget = kUnlimited};
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

TEST(Steering, PointPushersStandAtTheCentreOfPressure) {
  const Model model = prepare(scene_with(DiscPad{0.009}, PointFeature{}));
  const SearchModel search = prepare_search(model, Margin{});
  ASSERT_EQ(search.contacts.size(), 3u);
  const std::vector<Move> moves = sticking_moves(search, 500, 8);
  ASSERT_EQ(moves.size(), 500u);
  int held = 0;
  for (const Move& move : moves) {
    const LinearPush push = push_of(search, move);
    EXPECT_LE(std::abs(push.place), 0.05 - 1e-3 + 1e-12);
    const StickTest test =
        exact_stick_test(model, model.contacts[push.contact], push.place,
                         pose_along(move.from, move.to, 0.5), push.e, push.travel,
                         push.turn, Margin::none());
    held += test.slack >= 0.0;
  }
  std::printf("%d of 500 point pushes have their moment right with the real disc\n",
              held);
  EXPECT_GT(held, 450);
}

TEST(Steering, ShortLinesCoverTheFaceAndStayOnIt) {
  for (const double length : {0.004, 0.02, 0.05, 0.09, 0.1, 0.2}) {
    const Model model = prepare(scene_with(DiscPad{0.009}, LineFeature{length}));
    const SearchModel search = prepare_search(model, Margin{});
    if (length >= 0.1) {
      EXPECT_EQ(search.contacts.size(), 3u);
    }
    double covered = -0.05;
    for (const SearchContact& contact : search.contacts) {
      if (contact.contact != 0) continue;
      const double low = (contact.stick.a - contact.stick.centre).dot(contact.stick.t);
      const double high = (contact.stick.b - contact.stick.centre).dot(contact.stick.t);
      EXPECT_NEAR(high - low, std::min(length, 0.1), 1e-12);
      EXPECT_GE(low, -0.05 - 1e-12);
      EXPECT_LE(high, 0.05 + 1e-12);
      EXPECT_TRUE(length < 0.02 || low <= covered + 1e-12);
      covered = high;
    }
    EXPECT_NEAR(covered, 0.05, 1e-12);
  }
}

TEST(Steering, PointPadsAndFrictionlessGraspsHaveNoContacts) {
  const Model point = prepare(scene_with(PointPad{}, LineFeature{}));
  EXPECT_TRUE(prepare_search(point, Margin{}).contacts.empty());
  Scene loose = scene_with(DiscPad{0.009}, LineFeature{});
  loose.gripper.grip_force = 0.0;
  const Model slack = prepare(loose);
  const SearchModel search = prepare_search(slack, Margin{});
  EXPECT_TRUE(search.contacts.empty());
  Work work{.budget = kUnlimited};
  EXPECT_FALSE(direct_move(search, {{0.02, 0.0}, 0.0}, {{0.0, 0.0}, 0.0}, work));
}

TEST(Steering, NeedsNoHeap) {
  Scene scene = scene_with(RectanglePad{{0.01, 0.02}}, PointFeature{}, true);
  scene.overhang = Overhang::kClip;
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Random random(9);
  Work work{.budget = kUnlimited};
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

/// Indices of contacts mean the same at every margin.
TEST(Steering, KeepsItsContactsAtOtherMargins) {
  FixtureRange range;
  range.object = FixtureObject::kConcave;
  range.pushers = FixturePushers::kPoints;
  int leave_their_face = 0;
  for (int i = 0; i < 40; ++i) {
    const auto problem = random_fixture(range, 5, i);
    if (!problem) continue;
    const Model model = prepare(problem->scene);
    const SearchModel search = prepare_search(model, margin_of(model, usual_box()));
    for (const double scale : {0.0, 3.0, 9.0}) {
      const Margin margin = search.margin.scaled(scale);
      const SearchModel other = with_margin(search, margin);
      ASSERT_EQ(other.contacts.size(), search.contacts.size());
      for (std::size_t k = 0; k < search.contacts.size(); ++k) {
        EXPECT_EQ(other.contacts[k].contact, search.contacts[k].contact);
        EXPECT_LE(other.contacts[k].place_low, other.contacts[k].place_high);
      }
      const std::size_t kept = prepare_search(model, margin).contacts.size();
      if (scale > 1.0 && kept < search.contacts.size()) ++leave_their_face;
    }
  }
  EXPECT_GT(leave_their_face, 0);
}

}  // namespace
}  // namespace prehensile
