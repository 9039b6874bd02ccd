/// What stands behind the words of StudyProgram. Internal to the suite.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "benchmarks/suite/suite.h"
#include "io/fields.h"

namespace prehensile::suite {

/// What --quick makes of a program.
enum class QuickStudy {
  kOption,  ///< it has the same option
  kAsItIs,  ///< it is quick
  kLeftOut  ///< it has no quick variant
};

/// A program of the build and what it understands.
struct StudyProgramFacts {
  StudyProgram program;
  std::string_view word;  ///< in suite files
  std::string_view file;  ///< in the folder of `prehensile`
  QuickStudy quick = QuickStudy::kOption;
  std::string_view charts = "";  ///< its option for a file or a folder of charts
  bool takes_data = false;       ///< a folder as the first argument
  bool writes_csv = true;        ///< with -o FILE
};

inline constexpr std::array<StudyProgramFacts, 16> kStudyPrograms = {{
    {StudyProgram::kInstant, "instant", "benchmarks/bench_instant"},
    {StudyProgram::kSpatial, "spatial", "benchmarks/bench_spatial"},
    {StudyProgram::kExtremes, "extremes", "benchmarks/bench_extremes"},
    {StudyProgram::kPrecision, "precision", "benchmarks/bench_precision",
     QuickStudy::kOption, "--plots"},
    {StudyProgram::kPush, "push", "benchmarks/bench_push"},
    {StudyProgram::kIntegrators, "integrators", "benchmarks/bench_integrators",
     QuickStudy::kOption, "--charts"},
    {StudyProgram::kPlanner, "planner", "benchmarks/bench_planner"},
    {StudyProgram::kBaselines, "baselines", "benchmarks/bench_baselines"},
    {StudyProgram::kPlanPrecision, "plan_precision", "benchmarks/bench_plan_precision",
     QuickStudy::kOption, "--plots"},
    {StudyProgram::kPlanModels, "plan_models", "benchmarks/bench_plan_models"},
    {StudyProgram::kPlanExtremes, "plan_extremes", "benchmarks/bench_plan_extremes"},
    {StudyProgram::kTruth, "truth", "benchmarks/bench_truth", QuickStudy::kOption, "",
     true},
    {StudyProgram::kCollection, "collection", "benchmarks/bench_collection",
     QuickStudy::kAsItIs, "", true},
    {StudyProgram::kMechanicsTests, "mechanics_tests", "tests/mechanics_tests",
     QuickStudy::kLeftOut, "", false, false},
    {StudyProgram::kPrimitivesTests, "primitives_tests", "tests/primitives_tests",
     QuickStudy::kLeftOut, "", false, false},
    {StudyProgram::kPlannerTests, "planner_tests", "tests/planner_tests",
     QuickStudy::kLeftOut, "", false, false},
}};

constexpr auto study_program_words() {
  std::array<internal::Word<StudyProgram>, kStudyPrograms.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = {kStudyPrograms[i].program, kStudyPrograms[i].word};
  }
  return words;
}
inline constexpr auto kStudyProgramWords = study_program_words();

inline const StudyProgramFacts& program_of(const Study& study) {
  return kStudyPrograms[static_cast<std::size_t>(study.program)];
}

/// Options that name files, or say what --quick of the command says.
inline bool is_set_by_the_command(const std::string& argument) {
  return argument == "-o" || argument == "--charts" || argument == "--plots" ||
         argument == "--quick" || argument.starts_with("--gtest_output");
}

}  // namespace prehensile::suite
