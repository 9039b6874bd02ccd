#include "planner/steering/push_steps.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::Random;

struct Steps {
  explicit Steps(const Scene& scene, ControlMeaning meaning = ControlMeaning::kSteered)
      : model(prepare(scene)),
        search(prepare_search(model, Margin::none())),
        work{.budget = kNoBudget},
        steps(search, *model.scene.goal, work, meaning) {}

  Vec3 place(const FlatState& state) const {
    return {state.p_OF.x(), state.p_OF.y(), model.c * state.theta};
  }

  Model model;
  SearchModel search;
  Work work;
  PushSteps steps;
};

PushState random_state(Random& random) {
  return {{random.in_box(0.04, 0.04), random.in(-2.0, 2.0)}, 0.0};
}

TEST(PushSteps, ExtensionsAreOfTheWantedLengthAndStick) {
  Steps s(published_square(0));
  Work uncounted{.budget = kNoBudget};
  Random random(1);
  int straight = 0;
  int projected = 0;
  for (int i = 0; i < 3000; ++i) {
    const PushState from = random_state(random);
    const PushState to = random_state(random);
    const auto step = s.steps.extend(from, to, 0.01);
    if (!step) continue;
    const Vec3 way = s.place(step->to.flat) - s.place(from.flat);
    const Vec3 wanted = s.place(to.flat) - s.place(from.flat);
    EXPECT_NEAR(way.norm(), std::min(0.01, wanted.norm()), 1e-12);
    EXPECT_GT(way.dot(wanted), 0.0);
    EXPECT_TRUE(
        move_sticks(s.search, step->move_contact, from.flat, step->to.flat, uncounted));
    const bool is_straight = way.normalized().dot(wanted.normalized()) > 1.0 - 1e-12;
    ++(is_straight ? straight : projected);
  }
  EXPECT_GT(straight, 300);
  EXPECT_GT(projected, 300);
}

/// No motion that sticks is nearer to the wanted one than the projected, by trying many.
TEST(PushSteps, ProjectionIsTheClosestMotion) {
  Steps s(published_tee(0));
  Work uncounted{.budget = kNoBudget};
  Random random(2);
  constexpr double kLength = 1e-4;
  int compared = 0;
  for (int i = 0; i < 150; ++i) {
    const PushState from = random_state(random);
    if (!s.steps.is_valid(from)) continue;
    const PushState to = random_state(random);
    const auto step = s.steps.extend(from, to, kLength);
    if (!step) continue;
    const Vec3 wanted = (s.place(to.flat) - s.place(from.flat)).normalized();
    const Vec3 way = (s.place(step->to.flat) - s.place(from.flat)).normalized();
    double best = -1.0;
    for (int k = 0; k < 2000; ++k) {
      Vec3 other = wanted + 0.3 * random.log_in(1e-3, 10.0) *
                                Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0),
                                     random.in(-1.0, 1.0));
      other.normalize();
      if (other.dot(wanted) <= best) continue;
      const FlatState end{from.flat.p_OF + kLength * other.head<2>(),
                          from.flat.theta + kLength * other.z() / s.model.c};
      for (int contact = 0; contact < s.steps.finish_letter(); ++contact) {
        if (move_sticks(s.search, contact, from.flat, end, uncounted)) {
          best = other.dot(wanted);
        }
      }
    }
    if (best < 0.0) continue;
    ++compared;
    EXPECT_GT(way.dot(wanted), best - 2e-3);
  }
  EXPECT_GT(compared, 30);
}

TEST(PushSteps, AimsGoToTheirStateOrAsCloseAsOnePushComes) {
  Steps s(published_square(0));
  Random random(3);
  int exact = 0;
  int close = 0;
  for (int i = 0; i < 2000; ++i) {
    const PushState from = random_state(random);
    const PushState to = random_state(random);
    const PushControl aim{.letter = s.steps.aim_letter(),
                          .heading = to.flat.p_OF.x(),
                          .share = to.flat.p_OF.y(),
                          .travel = s.steps.theta_scale() * to.flat.theta};
    const auto step = s.steps.follow(from, aim);
    if (!step) continue;
    EXPECT_LT((step->to.flat.p_OF - to.flat.p_OF).norm(), 1e-12);
    const bool reached = std::abs(step->to.flat.theta - to.flat.theta) < 1e-12;
    EXPECT_EQ(reached, s.steps.join(from, step->to).has_value() && reached);
    ++(reached ? exact : close);
  }
  EXPECT_GT(exact, 200);
  EXPECT_GT(close, 100);
}

/// A blind control says the slope itself, so that most controls are refused.
TEST(PushSteps, BlindControlsMeanTheSlopeItself) {
  Steps blind(published_square(0), ControlMeaning::kBlind);
  Steps steered(published_square(0));
  Random random(4);
  int done = 0;
  int done_steered = 0;
  for (int i = 0; i < 4000; ++i) {
    const PushState from = random_state(random);
    const PushControl control{.letter = i % 3,
                              .heading = random.in(-3.1, 3.1),
                              .share = random.in(0.0, 1.0),
                              .travel = 0.005};
    done_steered += steered.steps.follow(from, control).has_value();
    const auto step = blind.steps.follow(from, control);
    if (!step) continue;
    ++done;
    const Vec3 way = blind.place(step->to.flat) - blind.place(from.flat);
    EXPECT_NEAR(std::atan2(way.z(), way.head<2>().norm()),
                std::numbers::pi * (control.share - 0.5), 1e-6);
    const auto again = blind.steps.follow(from, blind.steps.control_for(from, *step));
    ASSERT_TRUE(again);
    EXPECT_LT((again->to.flat.p_OF - step->to.flat.p_OF).norm(), 1e-9);
  }
  EXPECT_GT(done, 100);
  EXPECT_GT(2 * done_steered, 3 * done);
}

TEST(PushSteps, TheBoxHoldsStartAndGoalWithHalfATurnToSpare) {
  for (int i = 0; i < 20; ++i) {
    const Model model =
        prepare(random_among_walls(false, RegraspRange::kWide, true, 2, i));
    const FlatBox box = box_around(model, model.scene.start, *model.scene.goal);
    const Grasp goal = member_near(*model.scene.goal, model.scene.start);
    for (const Grasp& grasp : {model.scene.start, goal}) {
      EXPECT_GE(grasp.X_HO.theta - box.low.theta, std::numbers::pi - 1e-12);
      EXPECT_GE(box.high.theta - grasp.X_HO.theta, std::numbers::pi - 1e-12);
      const Vec2 p_OF = finger_in_object(grasp.X_HO);
      EXPECT_TRUE((p_OF.array() >= box.low.p_OF.array()).all());
      EXPECT_TRUE((p_OF.array() <= box.high.p_OF.array()).all());
    }
  }
}

}  // namespace
}  // namespace prehensile
