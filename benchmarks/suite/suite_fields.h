/// Every field of a suite file, in the vocabulary of io/fields.h: the reader and the JSON
/// Schema come from this list. Internal to the suite.
#pragma once

#include <array>

#include "benchmarks/suite/study_programs.h"
#include "io/fields.h"

namespace prehensile::suite {

using internal::alternative;
using internal::Bounds;
using internal::kOptional;
using internal::kRequired;
using internal::Length;
using internal::Word;

inline constexpr int kSuiteVersion = 1;
inline constexpr int kMostProblems = 1'000'000;  // of one family
inline constexpr int kLargestSeed = 2'000'000'000;

inline constexpr std::array<Word<bool>, 2> kPublishedObjectWords = {
    {{true, "square"}, {false, "tee"}}};
inline constexpr std::array<Word<RegraspRange>, 2> kRangeWords = {
    {{RegraspRange::kPublished, "published"}, {RegraspRange::kWide, "wide"}}};
inline constexpr std::array<Word<bool>, 2> kGravityWords = {
    {{true, "down"}, {false, "none"}}};
inline constexpr std::array<Word<RegraspFamily>, 3> kConstructedWords = {
    {{RegraspFamily::kBox, "box"},
     {RegraspFamily::kTee, "tee"},
     {RegraspFamily::kCylinder, "cylinder"}}};
inline constexpr std::array<Word<FixtureObject>, 4> kFixtureObjectWords = {
    {{FixtureObject::kBox, "box"},
     {FixtureObject::kTee, "tee"},
     {FixtureObject::kConvex, "convex"},
     {FixtureObject::kConcave, "concave"}}};
inline constexpr std::array<Word<FixturePushers>, 2> kFixturePusherWords = {
    {{FixturePushers::kLines, "lines"}, {FixturePushers::kPoints, "points"}}};
inline constexpr std::array<Word<FixturePad>, 2> kFixturePadWords = {
    {{FixturePad::kDisc, "disc"}, {FixturePad::kRectangle, "rectangle"}}};
inline constexpr std::array<Word<GoalsFrom>, 2> kGoalsWords = {
    {{GoalsFrom::kPushes, "pushes"}, {GoalsFrom::kRandom, "random"}}};
inline constexpr std::array<Word<FileGoals>, 3> kFileGoalsWords = {
    {{FileGoals::kGiven, "given"},
     {FileGoals::kPushes, "pushes"},
     {FileGoals::kRandom, "random"}}};
inline constexpr std::array<Word<SearchUntil>, 2> kUntilWords = {
    {{SearchUntil::kFirstPlan, "first_plan"}, {SearchUntil::kBudget, "budget"}}};
inline constexpr std::array<Word<bool>, 2> kPolishWords = {
    {{true, "nlopt"}, {false, "none"}}};
inline constexpr std::array<Word<double>, 4> kMeshUnitWords = {
    {{1.0, "m"}, {0.01, "cm"}, {0.001, "mm"}, {0.0254, "inch"}}};

template <typename Fields>
void visit_draws(Fields& f, int& count, int& seed, const char* of) {
  f.whole("count", count, 1, kMostProblems, kOptional, of);
  f.whole("seed", seed, 0, kLargestSeed, kOptional, "Of the problems.");
}

template <typename Fields>
void visit_goals(Fields& f, GoalsFrom& goals) {
  f.word("goals", goals, kGoalsWords, kOptional,
         "pushes: where random pushes from the start end, so that there is a plan; "
         "random: anywhere that the pads hold gravity.");
}

template <typename Fields>
void visit_published(Fields& f, PublishedPairs& source) {
  f.word("object", source.square, kPublishedObjectWords, kRequired, "Of 0.1 m.");
  f.whole("count", source.count, 1, kPublishedRegrasps, kOptional, "The first so many.");
}

template <typename Fields>
void visit_among_walls(Fields& f, AmongWalls& source) {
  f.word("object", source.square, kPublishedObjectWords, kRequired, "Of 0.1 m.");
  f.word("range", source.range, kRangeWords, kOptional,
         "published: of the comparison; wide: anywhere on the object, at any angle.");
  f.word("gravity", source.gravity, kGravityWords, kOptional, "Along -y of O, or none.");
  f.angle("theta_window", source.theta_window, {0.0, 50.0, "rad"},
          "Limits on theta this far beyond those of start and goal. Absent: none.");
  f.whole("posts", source.posts, 0, 50, kOptional,
          "Above 0: fingers and a palm, plates behind the walls, and so many posts "
          "around that neither may hit.");
  visit_draws(f, source.count, source.seed, "Problems.");
}

template <typename Fields>
void visit_constructed(Fields& f, Constructed& source) {
  f.word("object", source.object, kConstructedWords, kRequired,
         "Of random size; a cylinder lies between the jaws and may roll.");
  visit_goals(f, source.goals);
  visit_draws(f, source.count, source.seed, "Problems.");
}

template <typename Fields>
void visit_fixtures(Fields& f, Fixtures& source) {
  FixtureRange& range = source.range;
  const Bounds friction{0.01, 10.0, ""};
  f.word("object", range.object, kFixtureObjectWords, kRequired,
         "convex: 5 to 8 corners; concave: 6 to 9.");
  f.vector("size", range.size, {0.005, 1.0, "m"}, kOptional,
           "Longer side, of boxes both sides: from, to.");
  f.vector("mass", range.mass, {1e-4, 100.0, "kg"}, kOptional, "From, to; log-uniform.");
  f.word("pad", range.pad, kFixturePadWords, kOptional, "Shape of both pads.");
  f.vector("pad_size", range.pad_size, {1e-4, 0.5, "m"}, kOptional,
           "Diameter, or longer side: from, to.");
  f.vector("pad_aspect", range.pad_aspect, {0.01, 1.0, ""}, kOptional,
           "Shorter over longer side of rectangles: from, to.");
  f.vector("finger_friction", range.finger_friction, friction, kOptional, "From, to.");
  f.vector("pusher_friction", range.pusher_friction, friction, kOptional,
           "Of each pusher: from, to.");
  f.vector("strength", range.strength, {1.0, 1e4, ""}, kOptional,
           "Weight that the fingers could carry over the object's: from, to; "
           "log-uniform.");
  f.word("pushers", range.pushers, kFixturePusherWords, kOptional,
         "lines: on different faces, those beyond the number of faces are points; "
         "points: on any face.");
  f.vector("pusher_count", range.count, {1.0, 6.0, ""}, kOptional,
           "Whole numbers: from, to.");
  f.number("weightless", range.weightless, {0.0, 1.0, ""}, kOptional,
           "Share of problems without gravity.");
  f.number("position_tolerance", range.position_tolerance, {1e-6, 0.1, "m"}, kOptional,
           "Of the goal.");
  f.angle("angle_tolerance", range.angle_tolerance, {1e-6, 3.0, "rad"}, "Of the goal.");
  visit_goals(f, range.goals);
  visit_draws(f, source.count, source.seed, "Problems.");
}

template <typename Fields>
void visit_scenes(Fields& f, SceneFiles& source) {
  f.names("files", source.files, Length{1, 1000},
          "Scene files in the suite's folder (or --data) or below; * and ? match.");
  f.word("goals", source.goals, kFileGoalsWords, kOptional,
         "given: start and goal of the file; pushes, random: others in the same scene.");
  visit_draws(f, source.count, source.seed, "Problems of each file, if not given.");
}

template <typename Fields>
void visit_meshes(Fields& f, MeshFiles& source) {
  f.names("files", source.files, Length{1, 1000},
          "STL or OBJ files in the suite's folder (or --data) or below; * and ? match.");
  f.word("unit", source.unit, kMeshUnitWords, kOptional, "Of the files.");
  f.number("mass", source.mass, {1e-4, 100.0, "kg"}, kOptional, "Of each object.");
  f.number("pad_radius", source.pad_radius, {1e-4, 0.5, "m"}, kOptional, "Round pads.");
  f.number("finger_friction", source.finger_friction, {0.01, 10.0, ""}, kOptional,
           "Of both.");
  f.number("pusher_friction", source.pusher_friction, {0.01, 10.0, ""}, kOptional,
           "Of the four walls.");
  f.number("grip_force", source.grip_force, {0.01, 1e4, "N"}, kOptional,
           "Of each finger.");
  visit_goals(f, source.goals);
  visit_draws(f, source.count, source.seed, "Problems of each file.");
}

template <typename Fields>
void visit_family(Fields& fields, Family& family) {
  fields.text("name", family.name, kRequired, "One word.");
  fields.choice(
      family.source,
      alternative<PublishedPairs>("published", "The 50 published pairs.",
                                  [](auto& f, auto& s) { visit_published(f, s); }),
      alternative<AmongWalls>("among_walls", "Random regrasps among the published walls.",
                              [](auto& f, auto& s) { visit_among_walls(f, s); }),
      alternative<Constructed>("random", "Boxes, Ts and cans of random size.",
                               [](auto& f, auto& s) { visit_constructed(f, s); }),
      alternative<Fixtures>("fixtures", "Random objects in random fixtures.",
                            [](auto& f, auto& s) { visit_fixtures(f, s); }),
      alternative<SceneFiles>("scenes", "Scene files.",
                              [](auto& f, auto& s) { visit_scenes(f, s); }),
      alternative<MeshFiles>("meshes", "Mesh files among four walls.",
                             [](auto& f, auto& s) { visit_meshes(f, s); }));
}

template <typename Fields>
void visit_planner(Fields& f, PlannerEntry& entry) {
  f.text("name", entry.name, kOptional, "One word; absent: the planner's.");
  f.text("planner", entry.planner, kRequired, "As for `plan --planner`.");
  f.number("budget", entry.budget, {1.0, 1e12, ""}, kOptional,
           "Work, a whole number: stick tests (push) or propagations (OMPL's).");
  f.number("time", entry.time_limit, {0.0, 1e6, "s"}, kOptional,
           "Limit that the planner keeps itself, wall time; 0: none. Answers then depend "
           "on the machine and its load.");
  f.number("margin", entry.margin, {0.0, 5.0, ""}, kOptional,
           "Factor on the usual box of uncertainty; 0: nominal plans.");
  f.word("until", entry.until, kUntilWords, kOptional,
         "first_plan, or budget: search on for cheaper plans.");
  f.word("polish", entry.polish, kPolishWords, kOptional, "Shorten plans with NLopt.");
  f.whole("seeds", entry.seeds, 1, 10'000, kOptional,
          "Runs with seed 1 to this; a planner that draws nothing needs one.");
  f.numbers("options", entry.settings, "Of the planner, as `plan --list-planners` says.");
}

template <typename Fields>
void visit_study(Fields& f, Study& study) {
  f.text("name", study.name, kRequired, "One word.");
  f.word("program", study.program, kStudyProgramWords, kRequired,
         "A benchmark program, or tests that measure, of the same build.");
  f.names("arguments", study.arguments, Length{0, 40},
          "For the program: letters, digits and _ - . , : = * alone; what names files is "
          "set by the command.");
  f.text("data", study.data, kOptional,
         "Folder of real data in the suite's folder (or --data), for truth and "
         "collection.");
}

template <typename Fields>
void visit_limits(Fields& f, Limits& limits) {
  f.number("cpu_time", limits.cpu_time, {0.01, 1e6, "s"}, kOptional,
           "A run is killed after this processor time.");
  f.number("wall_time", limits.wall_time, {0.01, 1e7, "s"}, kOptional,
           "Likewise after this time on the clock.");
  f.number("memory_MB", limits.memory_MB, {50.0, 1e6, "MB"}, kOptional,
           "A run gets no more memory than this.");
}

template <typename Fields>
void visit_suite(Fields& fields, Suite& suite) {
  fields.version(kSuiteVersion);
  fields.text("name", suite.name, kRequired, "One word.");
  fields.list("families", suite.families, Length{1, 200}, kOptional,
              "Families of problems.",
              [](auto& f, Family& family) { visit_family(f, family); });
  fields.list("planners", suite.planners, Length{1, 50}, kOptional,
              "Each runs on every problem.",
              [](auto& f, PlannerEntry& entry) { visit_planner(f, entry); });
  fields.list("studies", suite.studies, Length{1, 200}, kOptional,
              "Programs that measure something else, each once.",
              [](auto& f, Study& study) { visit_study(f, study); });
  fields.group("limits", suite.limits, kOptional,
               "What ends a run or a study from outside.",
               [](auto& f, Limits& limits) { visit_limits(f, limits); });
  fields.whole("repetitions", suite.repetitions, 1, 1000, kOptional,
               "Of every run, for its time.");
  fields.whole("quick", suite.quick, 1, kMostProblems, kOptional,
               "Problems of each family with --quick.");
}

}  // namespace prehensile::suite
