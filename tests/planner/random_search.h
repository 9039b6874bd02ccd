/// Random problems as searches see them, which tests share.
#pragma once

#include "planner/steering/goal.h"
#include "planner/steering/limits.h"
#include "planner/walks/walk_lattice.h"
#include "problems/random_fixtures.h"

namespace prehensile::testing {

/// Between walls, with a goal anywhere.
struct RandomSearch {
  explicit RandomSearch(std::uint64_t index)
      : scene(random_fixture({.object = FixtureObject::kConvex,
                              .count = {1.0, 3.0},
                              .goals = GoalsFrom::kRandom},
                             3, index)
                  ->scene),
        model(prepare(scene)),
        search(prepare_search(model, Margin::none())),
        start(flat_state(scene.start)),
        goals(goal_places(model, *scene.goal, start)) {}
  RandomSearch(const RandomSearch&) = delete;
  RandomSearch& operator=(const RandomSearch&) = delete;

  Scene scene;
  Model model;
  SearchModel search;
  FlatState start;
  GoalPlaces goals;
};

/// The same with a lattice of walks over the object.
struct RandomLattice : RandomSearch {
  explicit RandomLattice(std::uint64_t index, std::int64_t budget = 50'000'000)
      : RandomSearch(index),
        work{.budget = budget},
        limits(options, work),
        lattice(search, start, goals, {16}, Steepness::kUsual),
        contacts(static_cast<int>(search.contacts.size())) {}

  PlanOptions options;
  Work work;
  Limits limits;
  WalkLattice lattice;
  int contacts;
};

}  // namespace prehensile::testing
