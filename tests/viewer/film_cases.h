/// Films of shipped scenes: one of every kind of push.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "io/object_surface.h"
#include "planner/obstacles/collision_bodies.h"
#include "planner/planner.h"
#include "viewer/film.h"

namespace prehensile::testing {

inline const std::filesystem::path kSourceTree = PREHENSILE_SOURCE_DIR;

struct FilmCase {
  std::string what;
  Model model;
  Plan plan;
  viewer::Film film;
};

inline Model model_of(const std::string& file) {
  return prepare(read_scene(kSourceTree / "problems" / file).scene);
}

inline FilmCase pushed(const std::string& file, Model model, const Push& push,
                       const viewer::FilmOptions& options) {
  FilmCase one{file, std::move(model), {}, {}};
  one.plan.start = one.plan.goal = one.model.scene.start;
  one.plan.margin = Margin::none();
  one.plan.pushes.push_back(
      {.push = push, .start = one.plan.start, .end = one.plan.start});
  one.film = viewer::film(one.model, one.plan, options);
  return one;
}

inline FilmCase pushed(const std::string& file, const Push& push,
                       const viewer::FilmOptions& options = {}) {
  return pushed(file, model_of(file), push, options);
}

/// The same between soft points.
inline FilmCase pushed_soft(const std::string& file, const Push& push) {
  Scene scene = model_of(file).scene;
  scene.gripper.pad = PointPad{.spin_radius = 0.006};
  return pushed(file + ", soft points", prepare(scene), push, {});
}

inline FilmCase planned(const std::string& file) {
  FilmCase one{file, model_of(file), {}, {}};
  one.plan = plan_regrasp(one.model);
  one.film = viewer::film(one.model, one.plan);
  return one;
}

/// Pushes that stick, slip, tip over an end, roll, and one that is followed in space;
/// plans with lines, with a roll, of a mesh, with limits, and among obstacles.
inline const std::vector<FilmCase>& film_cases() {
  static const std::vector<FilmCase> kCases = [] {
    const Vec2 x(1.0, 0.0);
    std::vector<FilmCase> cases;
    cases.push_back(pushed("paper/slide.yaml", Slide{.e = x, .travel = 0.02}));
    cases.push_back(
        pushed("paper/slide.yaml", LinearPush{.e = rotated(0.9, x), .travel = 0.008}));
    cases.push_back(
        pushed("paper/slide.yaml", LinearPush{.place = 0.012, .e = x, .travel = 0.02}));
    cases.push_back(pushed("paper/pivot.yaml", Pivot{.place = -0.03, .turn = 0.5}));
    cases.push_back(pushed("paper/roll.yaml", Roll{.travel = 0.02, .grip_force = 1.0}));
    cases.push_back(pushed("paper/roll_prism.yaml", Roll{.travel = 0.02}));
    cases.push_back(pushed("tilted_hand.yaml", LinearPush{.e = x, .travel = 0.01}));
    cases.push_back(planned("published/tee_21.yaml"));
    cases.push_back(planned("ycb/can_franka.yaml"));
    cases.push_back(planned("bracket.yaml"));
    cases.back().film.surface =
        read_object_surface(kSourceTree / "problems/bracket.yaml");
    cases.push_back(planned("confined/tee_90.yaml"));
    if (collisions_are_built()) {
      cases.push_back(planned("confined/post_in_the_way.yaml"));
    }
    for (const double aside : {0.0, 0.9}) {
      cases.push_back(pushed_soft("paper/slide.yaml",
                                  LinearPush{.e = rotated(aside, x), .travel = 0.008}));
    }
    return cases;
  }();
  return kCases;
}

/// The plan of a file.
inline const FilmCase& film_case(const std::string& file) {
  const std::vector<FilmCase>& cases = film_cases();
  return *std::find_if(cases.rbegin(), cases.rend(),
                       [&](const FilmCase& one) { return one.what == file; });
}

}  // namespace prehensile::testing
