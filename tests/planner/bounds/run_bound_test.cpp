#include "planner/bounds/run_bound.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/geometry/segment.h"
#include "planner/pads/ring_pads.h"
#include "problems/published_regrasps.h"
#include "scene/constants.h"
#include "scene/outline.h"
#include "tests/planner/run_programs.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::Random;
using testing::random_run_scene;

/// Slack of a sticking push by pads whose friction is the same at every angle; negative
/// where the pusher recedes at one of its ends.
double slack_of(const Model& model, const PushContact& contact, const Vec2& p_OF,
                const Vec2& e, double travel, double turn) {
  for (const double done : {0.0, travel}) {
    if (advance_of(contact, p_OF - done * e, e, turn / travel) < 0.0) return -1.0;
  }
  if (has_ring_pads(model)) return ring_slack(model, contact, p_OF, e, travel, turn);
  return exact_stick_test(model, contact, 0.0, pose_from_finger(p_OF, 0.0), e, travel,
                          turn, Margin::none())
      .slack;
}

/// A run of random sticking moves by one contact.
struct Walk {
  Vec2 end = Vec2::Zero();
  double turn = 0.0, travel = 0.0;
  int moves = 0;
};

Walk random_run(const Model& model, int contact, const Vec2& start, Random& random) {
  const PushContact& pushed = model.contacts[contact];
  Walk walk{.end = start};
  const double lean = random.in(-1.0, 1.0);  // of all moves, about
  const double spin = random.in(-2.0, 2.0);
  for (int k = 0; k < 60 && walk.moves < 8; ++k) {
    const double length = random.in(1e-3, 12e-3);
    const Vec2 e = rotated(lean + random.in(-0.4, 0.4), pushed.n);
    const double turn = length * (spin + random.in(-1.5, 1.5)) / model.c;
    const Vec2 to = walk.end - length * e;
    if (!segment_inside(model.pad_face, walk.end, to) ||
        slack_of(model, pushed, walk.end, e, length, turn) < 0.0)
      continue;
    walk.end = to;
    walk.turn += turn;
    walk.travel += std::hypot(length, model.c * turn);
    ++walk.moves;
  }
  return walk;
}

RunQuestion question_of(const Model& model, const RunLaws& laws, int contact,
                        const Vec2& start, const Walk& walk) {
  RunQuestion question{.laws = &laws,
                       .contact = contact,
                       .c = model.c,
                       .outline = &model.pad_face,
                       .start = start,
                       .goal = {.centre = walk.end}};
  question.turn_low = question.turn_high = walk.turn;
  return question;
}

void attack_with_runs(int scenes, std::uint64_t seed) {
  Random random(seed);
  int runs = 0, sharp = 0;
  for (int i = 0; i < scenes; ++i) {
    const Model model = prepare(random_run_scene(random));
    const RunLaws laws = run_laws(model);
    for (int k = 0; k < 20; ++k) {
      const int contact = random.below(static_cast<int>(model.contacts.size()));
      const Vec2 start = random.in_box(0.045, 0.045);
      if (!contains(model.pad_face, start)) continue;
      const Walk walk = random_run(model, contact, start, random);
      if (walk.moves < 3) continue;
      ++runs;
      RunQuestion question = question_of(model, laws, contact, start, walk);
      if (random.chance(0.5)) {  // the walk ends at the rim of the goal
        const double share = random.in(-1.0, 1.0);
        GoalArc& goal = question.goal;
        goal.arc = {3e-3, -2e-3};
        goal.slack.fill(1e-3 + 1e-3 * std::abs(share));
        goal.slope = {1e-3, -1e-3};
        goal.centre -= share * goal.arc;
        const double off = std::min(goal.slack[0] + goal.slope[0] * share,
                                    goal.slack[1] + goal.slope[1] * share);
        goal.centre += rotated(random.in(-kPi, kPi), {0.999 * off, 0.0});
        question.turn_high += 0.05;
      }
      question.cap = random.in(1.001, 1.3) * walk.travel;
      const double bound = run_bound(question);
      EXPECT_LE(bound, walk.travel * (1.0 + 1e-6)) << i;
      EXPECT_GE(bound, 0.0);
      sharp += bound > 0.9 * walk.travel;
    }
  }
  EXPECT_GT(runs, 5 * scenes);
  EXPECT_GT(sharp, runs / 50);
}

TEST(RunBound, AllowsEveryRunOfStickingMoves) { attack_with_runs(25, 1); }

TEST(RunBound, FullAllowsEveryRunOfStickingMoves) { attack_with_runs(3000, 2); }

TEST(RunBound, IsTheStraightWayWhereThatSticks) {
  Scene scene = published_square(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const RunLaws laws = run_laws(model);
  const Walk walk{.end = {-0.02, 0.004}, .turn = 0.5};
  const double straight = std::hypot(walk.end.norm(), model.c * walk.turn);
  RunQuestion question = question_of(model, laws, 0, {0.0, 0.0}, walk);
  question.cap = 1.2 * straight;
  const double bound = run_bound(question);
  EXPECT_LE(bound, straight);
  EXPECT_GE(bound, 0.98 * straight);
}

/// Too much turning for the levers of the face.
TEST(RunBound, ProvesThatAGoalCannotBeReached) {
  Scene scene = published_square(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const RunLaws laws = run_laws(model);
  RunQuestion question =
      question_of(model, laws, 0, {0.0, 0.0}, {.end = {-0.005, 0.0}, .turn = 40.0});
  question.cap = 0.5;
  EXPECT_EQ(run_bound(question), question.cap);
}

TEST(RunBound, FindsTheShortestRun) {
  Scene scene = published_square(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const RunLaws laws = run_laws(model);
  Random random(3);
  int found = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec2 start(0.02, random.in(-0.04, 0.04));
    const Walk walk{.end = {-0.02, start.y() + random.in(-0.03, 0.03)},
                    .turn = random.in(-kPi, kPi)};
    RunQuestion question = question_of(model, laws, 0, start, walk);
    question.cap = 0.3;
    const double bound = run_bound(question);
    question.chords_only = true;
    question.weight = 1e-4 * question.cap;
    RunPath path;
    if (!run_path(question, path)) continue;
    ++found;
    const PushContact& contact = model.contacts[0];
    double length = 0.0;
    Vec2 at = start;
    for (std::size_t j = 0; j <= path.places.size(); ++j) {
      const Vec2 step = (j < path.places.size() ? path.places[j] : walk.end) - at;
      EXPECT_LE(std::abs(step.dot(contact.t)), -contact.mu * step.dot(contact.n) + 1e-4);
      length += step.norm();
      at += step;
    }
    EXPECT_LT(bound, question.cap) << i;
    EXPECT_LT(length, question.cap) << i;
  }
  EXPECT_GT(found, 10);
}

}  // namespace
}  // namespace prehensile
