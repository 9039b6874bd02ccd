/// Programs of runs over published objects.
#pragma once

#include "planner/bounds/run_program.h"
#include "planner/pads/ring_pads.h"
#include "problems/published_regrasps.h"
#include "scene/outline.h"
#include "tests/planner/law_cases.h"

namespace prehensile::testing {

/// A square or a T among walls, over discs or soft points.
inline Scene random_run_scene(Random& random) {
  Scene scene = random.chance(0.5) ? published_square(0) : published_tee(0);
  if (random.chance(0.5)) scene.g_W.setZero();
  scene.gripper.grip_force = random.log_in(12.0, 80.0);
  for (auto& pusher : scene.pushers) pusher.friction = random.in(0.2, 1.1);
  return random.chance(0.4) ? with_soft_points(scene) : scene;
}

/// Calls `f(program, cap)` for runs by one contact between random places; cap [m] is
/// somewhat more than the straight way.
template <typename F>
void for_random_runs(int scenes, std::uint64_t seed, const F& f) {
  Random random(seed);
  for (int i = 0; i < scenes; ++i) {
    const Model model = prepare(random_run_scene(random));
    const RunLaws laws = run_laws(model);
    for (int k = 0; k < 20; ++k) {
      const Vec2 start = random.in_box(0.045, 0.045);
      const Vec2 end = random.in_box(0.045, 0.045);
      const double turn = random.in(-1.5, 1.5);
      const int contact = random.below(static_cast<int>(model.contacts.size()));
      if (!contains(model.pad_face, start) || !contains(model.pad_face, end)) continue;
      const double straight = std::hypot((end - start).norm(), model.c * turn);
      RunQuestion question{.laws = &laws,
                           .contact = contact,
                           .c = model.c,
                           .outline = &model.pad_face,
                           .start = start,
                           .goal = {.centre = end},
                           .turn_low = turn - 0.05,
                           .turn_high = turn + 0.05,
                           .cap = random.in(1.02, 1.6) * straight,
                           .chords_only = random.chance(0.3)};
      question.goal.arc = random.in_box(2e-3, 2e-3);
      question.goal.slack.fill(1e-3);
      question.goal.slope = {random.in(-5e-4, 5e-4), random.in(-5e-4, 5e-4)};
      const RunProgram program(question);
      if (program.is_ahead) f(program, question.cap);
    }
  }
}

}  // namespace prehensile::testing
