#include "benchmarks/suite/suite_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "benchmarks/suite/run_one.h"
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
          "     until: budget, polish: none, seeds: 4}\n"
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
       "planners, limits, repetitions, quick; did you mean families?"},
      {kHead, "s.yaml:1: families: missing: expected a list of maps"},
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
  EXPECT_FALSE(accepts(kHead));
  EXPECT_FALSE(accepts(kHead + kFamily + "unknown: 1\n"));
  EXPECT_FALSE(accepts(kHead + kFamily + "quick: 0\n"));
  EXPECT_FALSE(accepts(kHead + "families:\n  - {name: f, published: {object: round}}\n"));
}

}  // namespace
}  // namespace prehensile::suite
