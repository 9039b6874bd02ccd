#include "benchmarks/suite/suite_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "benchmarks/suite/run_one.h"
#include "benchmarks/suite/study_programs.h"
#include "io/document.h"
#include "io/plan_file.h"

namespace prehensile::suite {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PREHENSILE_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string message_of(const std::string& text) {
  try {
    parse_suite(text, "s.yaml", {"push", "KPIECE1"}, "");
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return {};
}

std::vector<fs::path> shipped_suites() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kRoot / "benchmarks" / "suites")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

const std::string kHead = "version: 1\nname: s\nplanners:\n  - {planner: push}\n";
const std::string kFamily = "families:\n  - {name: f, published: {object: square}}\n";

const std::string kStudy = "studies:\n  - {name: i, program: instant}\n";

TEST(SuiteFile, ReadsEveryField) {
  const Suite suite =
      parse_suite(
          "version: 1\n"
          "name: s\n"
          "families:\n"
          "  - name: f\n"
          "    fixtures: {object: concave, size: [0.05, 0.06], pad: rectangle,\n"
          "      pusher_count: [1, 6], pushers: points, goals: random,\n"
          "      angle_tolerance_deg: 2, strength: [1.2, 1.5], count: 7, seed: 3}\n"
          "  - {name: g, meshes: {files: [a.obj], unit: mm, goals: pushes}}\n"
          "planners:\n"
          "  - {name: p, planner: push, budget: 1e5, time: 0.5, margin: 0,\n"
          "     until: budget, polish: none, seeds: 4, options: {fallback_share: 0.2}}\n"
          "limits: {cpu_time: 2, wall_time: 3, memory_MB: 400}\n"
          "repetitions: 5\n"
          "quick: 6\n",
          "s.yaml", {"push"}, "")
          .suite;
  const auto& fixtures = std::get<Fixtures>(suite.families[0].source);
  EXPECT_EQ(fixtures.range.object, FixtureObject::kConcave);
  EXPECT_EQ(fixtures.range.size, (Range{0.05, 0.06}));
  EXPECT_EQ(fixtures.range.count, (Range{1.0, 6.0}));
  EXPECT_EQ(fixtures.range.goals, GoalsFrom::kRandom);
  EXPECT_NEAR(fixtures.range.angle_tolerance, 0.034907, 1e-6);
  EXPECT_EQ(fixtures.count, 7);
  EXPECT_EQ(std::get<MeshFiles>(suite.families[1].source).unit, 1e-3);
  const PlannerEntry& entry = suite.planners[0];
  EXPECT_EQ(entry.label(), "p");
  EXPECT_EQ(entry.budget, 1e5);
  EXPECT_EQ(entry.time_limit, 0.5);
  EXPECT_EQ(entry.margin, 0.0);
  EXPECT_EQ(entry.until, SearchUntil::kBudget);
  EXPECT_FALSE(entry.polish);
  EXPECT_EQ(entry.seeds, 4);
  EXPECT_EQ(entry.settings, (PlannerSettings{{"fallback_share", 0.2}}));
  const Model model = prepare(published_square(0));
  EXPECT_EQ(plan_options(entry, model, 4).settings, entry.settings);
  EXPECT_EQ(suite.limits.memory_MB, 400.0);
  EXPECT_EQ(suite.repetitions, 5);
  EXPECT_EQ(suite.quick, 6);
}

TEST(SuiteFile, SaysWhatIsWrongAndWhere) {
  const auto with_source = [](const std::string& source) {
    return kHead + "families:\n  - {name: f, " + source + "}\n";
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {kHead + kFamily + "famliies: 1\n",
       "s.yaml:7: famliies: unknown key: expected one of version, name, families, "
       "planners, studies, limits, repetitions, quick; did you mean families?"},
      {kHead, "s.yaml:1: families: expected families and planners, or studies"},
      {"version: 1\nname: s\n" + kFamily,
       "s.yaml:1: planners: expected planners for the families"},
      {kHead + kStudy, "s.yaml:1: families: expected families for the planners"},
      {kHead + kFamily + "quick: 0\n",
       "s.yaml:7: quick: 0: expected a whole number from 1 to 1000000"},
      {kHead + kFamily + "repetitions: 1.5\n",
       "s.yaml:7: repetitions: 1.5: expected a whole number from 1 to 1000"},
      {kHead + kFamily + "limits: {cpu_time: .nan}\n",
       "s.yaml:7: limits.cpu_time: .nan: expected a number from 0.01 to 1000000 s"},
      {"version: 1\nname: two words\nplanners:\n  - {planner: push}\n" + kFamily,
       "s.yaml:2: name: two words: expected one word of letters, digits, _ - and ., "
       "at most 60 of them"},
      {"version: 1\nname: s\nplanners:\n  - {planner: pull}\n" + kFamily,
       "s.yaml:4: planners.0.planner: pull: expected one of push, KPIECE1"},
      {"version: 1\nname: s\nplanners:\n  - {planner: push}\n  - {planner: push}\n" +
           kFamily,
       "s.yaml:5: planners.1.name: expected a name that no other entry has"},
      {"version: 1\nname: s\nplanners:\n  - {planner: push, budget: 1.5}\n" + kFamily,
       "s.yaml:4: planners.0.budget: 1.5: expected a whole number"},
      {"version: 1\nname: s\nplanners:\n  - {planner: push, options: {fallback_share: "
       "2}}\n" +
           kFamily,
       "s.yaml:4: planners.0.options.fallback_share: 2: expected an option of the "
       "planner (option fallback_share of planner push is 2; expected a number from 0 to "
       "0.9)"},
      {"version: 1\nname: s\nplanners:\n  - {planner: push, options: {range: .nan}}\n" +
           kFamily,
       "s.yaml:4: planners.0.options.range: .nan: expected a number"},
      {with_source("fixtures: {object: box, size: [0.1, 0.05]}"),
       "s.yaml:6: families.0.fixtures.size: expected the lower end first"},
      {with_source("fixtures: {object: box, pusher_count: [1.5, 2]}"),
       "s.yaml:6: families.0.fixtures.pusher_count: expected whole numbers"},
      {with_source("fixtures: {object: box, strength: [0.5, 2]}"),
       "s.yaml:6: families.0.fixtures.strength.0: 0.5: expected a number from 1 to "
       "10000"},
      {with_source("scenes: {files: [../a.yaml]}"),
       "s.yaml:6: families.0.scenes.files.0: ../a.yaml: expected a path in the suite's "
       "folder or below"},
      {with_source("scenes: {files: [/etc/passwd]}"),
       "s.yaml:6: families.0.scenes.files.0: /etc/passwd: expected a path in the suite's "
       "folder or below"},
      {with_source("meshes: {unit: mm}"),
       "s.yaml:6: families.0.meshes.files: expected at least one file"},
      {with_source("published: {object: square, count: 51}"),
       "s.yaml:6: families.0.published.count: 51: expected a whole number from 1 to 50"},
      {with_source("published: {object: square}, random: {object: box}"),
       "s.yaml:6: families.0: published, random: expected exactly one of published, "
       "among_walls, random, fixtures, scenes, meshes"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(message_of(text), message);
  EXPECT_EQ(message_of(kHead + kFamily), "");
}

TEST(SuiteFile, ReadsStudies) {
  const Suite suite =
      parse_suite(
          "version: 1\nname: s\nstudies:\n"
          "  - {name: a, program: integrators, arguments: ['--pushes', '40']}\n"
          "  - {name: b, program: truth, data: real/pushes}\n"
          "  - {name: c, program: mechanics_tests,\n"
          "     arguments: ['--gtest_filter=*FullA*:B.*']}\n",
          "s.yaml", {"push"}, "")
          .suite;
  ASSERT_EQ(suite.studies.size(), 3u);
  EXPECT_TRUE(suite.families.empty());
  EXPECT_EQ(suite.studies[0].program, StudyProgram::kIntegrators);
  EXPECT_EQ(suite.studies[0].arguments, (std::vector<std::string>{"--pushes", "40"}));
  EXPECT_EQ(suite.studies[1].data, "real/pushes");
  EXPECT_EQ(suite.studies[2].arguments[0], "--gtest_filter=*FullA*:B.*");
}

TEST(SuiteFile, StudiesNameProgramsAndNoFiles) {
  const auto study = [](const std::string& fields) {
    return message_of("version: 1\nname: s\nstudies:\n  - {" + fields + "}\n");
  };
  const auto argument = [&](const std::string& word) {
    return study("name: a, program: push, arguments: ['" + word + "']");
  };
  EXPECT_EQ(argument("--pushes"), "");
  for (const std::string word :
       {"/etc/passwd", "a b", "$HOME", "`ls`", "a;b", "", "a/../b", "a\\b", "a|b"}) {
    const std::string message = argument(word);
    EXPECT_NE(message.find("studies.0.arguments.0: "), std::string::npos) << message;
    EXPECT_NE(message.find("expected letters, digits"), std::string::npos) << message;
  }
  for (const char* word :
       {"-o", "--charts", "--plots", "--quick", "--gtest_output=xml"}) {
    EXPECT_EQ(argument(word), "s.yaml:4: studies.0.arguments.0: \"" + std::string(word) +
                                  "\": expected no option that the command sets itself");
  }
  EXPECT_NE(study("name: a, program: /bin/sh").find("expected one of instant, spatial"),
            std::string::npos);
  EXPECT_NE(study("name: a, program: bash").find("studies.0.program: bash: expected"),
            std::string::npos);
  EXPECT_NE(study("name: a b, program: push").find("studies.0.name: a b: expected one"),
            std::string::npos);
  EXPECT_NE(study("name: a, program: push}\n  - {name: a, program: push")
                .find("studies.1.name: a: expected a name that no other entry has"),
            std::string::npos);
  EXPECT_NE(study("name: a, program: push, data: d").find("expected none"),
            std::string::npos);
  for (const char* data : {"", ", data: /d", ", data: ../d", ", data: a/../../d"}) {
    EXPECT_NE(
        study(std::string("name: a, program: truth") + data).find("studies.0.data: "),
        std::string::npos)
        << data;
  }
}

TEST(SuiteFile, ShippedSuitesAreRead) {
  ASSERT_FALSE(shipped_suites().empty());
  for (const fs::path& file : shipped_suites()) {
    const std::vector<std::string> planners = names(planners_of_build());
    std::string message;
    try {
      read_suite(file, planners);
    } catch (const BadInput& bad) {
      message = bad.what();
    }
    // Without OMPL its planners are missing, and the message says so.
    const bool is_excused =
        planners.size() == 1 && message.find("expected one of push") != std::string::npos;
    EXPECT_TRUE(message.empty() || is_excused) << message;
  }
}

/// A command of the documentation, without what names files: program and arguments.
using Command = std::pair<std::string, std::vector<std::string>>;

/// All commands whose figures docs/benchmarks.md prints.
std::set<Command> documented_commands() {
  std::set<Command> commands;
  const std::string text = text_of(kRoot / "docs" / "benchmarks.md");
  const std::regex program("build/release/benchmarks/bench_([a-z_]+)([^\n]*)");
  for (std::sregex_iterator it(text.begin(), text.end(), program), end; it != end; ++it) {
    std::istringstream words((*it)[2]);
    Command command{(*it)[1], {}};
    for (std::string word; words >> word;) {
      const bool names_file =
          word == "-o" || word == "[-o" || word == "--charts" || word == "--plots";
      if (names_file) words >> word;
      const bool is_data = word == "DATA" || word == "FOLDER";
      if (!names_file && !is_data) command.second.push_back(word);
    }
    commands.insert(command);
  }
  const std::regex tests("([a-z]+_tests) (--gtest_filter=)'?([A-Za-z.*]+)");
  for (std::sregex_iterator it(text.begin(), text.end(), tests), end; it != end; ++it) {
    commands.insert({(*it)[1], {(*it)[2].str() + (*it)[3].str()}});
  }
  return commands;
}

TEST(SuiteFile, NumericsHasEveryDocumentedCommand) {
  const Suite suite =
      read_suite(kRoot / "benchmarks" / "suites" / "numerics.yaml", {}).suite;
  std::set<Command> studies;
  std::set<StudyProgram> programs;
  for (const Study& study : suite.studies) {
    studies.insert({std::string(program_of(study).word), study.arguments});
    programs.insert(study.program);
  }
  EXPECT_EQ(programs.size(), kStudyPrograms.size()) << "a program that nobody runs";
  const std::set<Command> documented = documented_commands();
  EXPECT_GE(documented.size(), 20u);
  for (const auto& [program, arguments] : documented) {
    std::string words = program;
    for (const std::string& argument : arguments) words += ' ' + argument;
    EXPECT_TRUE(studies.contains({program, arguments})) << words;
  }
}

TEST(SuiteFile, ShippedSchemaIsTheGeneratedOne) {
  if (text_of(kRoot / "schemas" / "suite.schema.json") == suite_schema()) return;
  const fs::path fresh = fs::path(PREHENSILE_BINARY_DIR) / "suite.schema.json";
  write_atomically(fresh, suite_schema());
  ADD_FAILURE() << "schemas/suite.schema.json is out of date: copy " << fresh
                << " over it";
}

TEST(SuiteFile, SchemaAgreesWithTheReader) {
  valijson::Schema schema;
  const nlohmann::json document = nlohmann::json::parse(suite_schema());
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema);
  const auto accepts = [&schema](const std::string& yaml) {
    internal::Faults faults("yaml");
    const auto json =
        nlohmann::json::parse(internal::to_json(internal::parse_yaml(yaml, faults)));
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(json),
                              nullptr);
  };
  for (const fs::path& file : shipped_suites())
    EXPECT_TRUE(accepts(text_of(file))) << file;
  EXPECT_TRUE(accepts(kHead + kFamily));
  EXPECT_TRUE(accepts("version: 1\nname: s\n" + kStudy));
  EXPECT_FALSE(accepts("version: 1\n" + kFamily)) << "no name";
  EXPECT_FALSE(accepts("version: 1\nname: s\nstudies:\n  - {name: i, program: sh}\n"));
  EXPECT_FALSE(accepts(kHead + kFamily + "unknown: 1\n"));
  EXPECT_FALSE(accepts(kHead + kFamily + "quick: 0\n"));
  EXPECT_FALSE(accepts(kHead + "families:\n  - {name: f, published: {object: round}}\n"));
}

}  // namespace
}  // namespace prehensile::suite
