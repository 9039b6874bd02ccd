/// A benchmark suite: which problems, which planners, how often, within which limits, and
/// which studies.
/// Plain values; read from a file by suite_file.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/planner.h"
#include "problems/confined_regrasps.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"

namespace prehensile::suite {

/// The 50 published pairs of start and goal (problems/published_regrasps.h).
struct PublishedPairs {
  bool square = true;  ///< or else the T
  int count = kPublishedRegrasps;
};

/// Random regrasps among the three published walls.
struct AmongWalls {
  bool square = true;
  RegraspRange range = RegraspRange::kWide;
  bool gravity = true;
  std::optional<double> theta_window;  ///< [rad] limits on theta this far beyond start
                                       ///< and goal
  int posts =
      0;  ///< > 0: a hand with a body, walls, and so many posts that are in its way
  int count = 100;
  int seed = 1;
};

/// Boxes, Ts and cans of any size (problems/random_regrasps.h); with random goals: other
/// starts and goals in the same scenes.
struct Constructed {
  RegraspFamily object = RegraspFamily::kBox;
  GoalsFrom goals = GoalsFrom::kPushes;
  int count = 100;
  int seed = 1;
};

/// Random objects in random fixtures, over stated ranges (problems/random_fixtures.h).
struct Fixtures {
  FixtureRange range;
  int count = 100;
  int seed = 1;
};

/// How the start and the goal of a problem from a file come about.
enum class FileGoals { kGiven, kPushes, kRandom };

/// Scene files: as they are, or each with `count` other starts and goals.
struct SceneFiles {
  std::vector<std::string> files;  ///< relative to the suite's folder; * and ? match
  FileGoals goals = FileGoals::kGiven;
  int count = 1;  ///< of each file, for other goals than the given ones
  int seed = 1;
};

/// Mesh files, each held at its first pair of faces by round pads, among four walls.
struct MeshFiles {
  std::vector<std::string> files;
  double unit = 1.0;          ///< [m] that 1 stands for
  double mass = 0.2;          ///< [kg]
  double pad_radius = 0.008;  ///< [m]
  double finger_friction = 0.6;
  double pusher_friction = 0.5;
  double grip_force = 30.0;  ///< [N]
  GoalsFrom goals = GoalsFrom::kPushes;
  int count = 10;  ///< of each file
  int seed = 1;
};

using ProblemSource = std::variant<PublishedPairs, AmongWalls, Constructed, Fixtures,
                                   SceneFiles, MeshFiles>;

/// A family of problems.
struct Family {
  std::string name;  ///< one word
  ProblemSource source;
};

/// When a planner stops.
enum class SearchUntil { kFirstPlan, kBudget };

struct PlannerEntry {
  std::string name;  ///< one word; empty: that of the planner
  std::string planner = "push";
  double budget = 2e6;      ///< work, as PlanOptions::budget; a whole number
  double time_limit = 0.0;  ///< [s] wall time, as PlanOptions::time_limit; 0: none
  double margin = 1.0;      ///< factor on the usual box; 0: nominal plans
  SearchUntil until = SearchUntil::kFirstPlan;
  bool polish = true;
  int seeds = 1;  ///< runs with seed 1..seeds; planners that draw nothing need one
  PlannerSettings settings;  ///< options of the planner (planner/catalogue.h)

  const std::string& label() const { return name.empty() ? planner : name; }
};

/// The programs that a study may be, `bench_` ones and tests that measure
/// (study_programs.h).
enum class StudyProgram {
  kInstant,
  kSpatial,
  kExtremes,
  kPrecision,
  kPush,
  kIntegrators,
  kPlanner,
  kBaselines,
  kPlanPrecision,
  kPlanModels,
  kPlanExtremes,
  kTruth,
  kCollection,
  kMechanicsTests,
  kPrimitivesTests,
  kPlannerTests
};

/// A measurement that is no planner on a problem: error against run time of solvers and
/// integrators, truth on real data. One process, one row.
struct Study {
  std::string name;  ///< one word
  StudyProgram program = StudyProgram::kInstant;
  std::vector<std::string> arguments;
  std::string data;  ///< folder in the suite's, for programs that read data
};

/// What ends a run or a study from outside.
struct Limits {
  double cpu_time = 60.0;     ///< [s] of the process of the run
  double wall_time = 600.0;   ///< [s]
  double memory_MB = 2000.0;  ///< beyond what the program has before a run
};

struct Suite {
  std::string name = "suite";
  std::vector<Family> families;
  std::vector<PlannerEntry> planners;
  std::vector<Study> studies;
  Limits limits;
  int repetitions = 1;
  int quick = 3;  ///< problems of each family with --quick
};

}  // namespace prehensile::suite
