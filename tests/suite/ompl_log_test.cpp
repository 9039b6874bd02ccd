#include "benchmarks/suite/ompl_log.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/suite/asked.h"
#include "tests/suite/small_suite.h"

namespace prehensile::suite {
namespace {

using testing::asked;
using testing::Bench;
using testing::Folder;
using testing::small_suite;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

int fields_of(const std::string& line, const std::string& end) {
  int count = 0;
  for (std::size_t at = line.find(end); at != std::string::npos;
       at = line.find(end, at + end.size())) {
    ++count;
  }
  return count;
}

TEST(OmplLog, HasAsManyFieldsAsItDeclares) {
  const Folder folder;
  const Bench bench(small_suite("  - {planner: push}\n  - {name: b, planner: push}\n"));
  bench.run(folder / "a");
  const Results results = read_results(folder / "a");
  for (int family = 0; family < 3; ++family) {
    const std::vector<std::string> lines = lines_of(ompl_log(results, family));
    EXPECT_EQ(lines[0], "prehensile version test");
    int blocks = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!lines[i].ends_with(" properties for each run")) continue;
      if (lines[i].find("progress") != std::string::npos) continue;
      const std::size_t properties = std::stoul(lines[i]);
      ASSERT_EQ(lines[i + properties + 1], "4 runs");
      for (std::size_t run = 0; run < 4; ++run) {
        const std::string& row = lines[i + properties + 2 + run];
        EXPECT_EQ(fields_of(row, "; "), static_cast<int>(properties)) << row;
        EXPECT_TRUE(row.ends_with("; "));
      }
      ++blocks;
    }
    EXPECT_EQ(blocks, 2);
    EXPECT_EQ(lines.back(), ".");
  }
}

/// OMPL's own script (Debian: ompl-demos), by its name or by what OMPL_STATISTICS says;
/// empty: it is not installed.
std::string script() {
  if (const char* given = std::getenv("OMPL_STATISTICS")) return given;
  const std::string name = "ompl_benchmark_statistics";
  return std::system(("command -v " + name + " > /dev/null").c_str()) == 0 ? name : "";
}

TEST(OmplLogFull, IsReadByOmplsScript) {
  if (script().empty())
    GTEST_SKIP() << "not installed: ompl_benchmark_statistics "
                    "(Debian: ompl-demos)";
  const Folder folder;
  const Bench bench(small_suite());
  bench.run(folder / "a.db");
  const Results results = read_results(folder / "a.db");
  std::string logs;
  for (int family = 0; family < 3; ++family) {
    const auto file = folder / (results.families[family].name + ".log");
    std::ofstream(file) << ompl_log(results, family);
    logs += ' ' + file.string();
  }
  const auto succeeds = [&](const std::string& arguments) {
    const auto said = folder / "said";
    const std::string command = script() + arguments + " > " + said.string() + " 2>&1";
    if (std::system(command.c_str()) == 0) return ::testing::AssertionSuccess();
    std::ostringstream text;
    text << std::ifstream(said).rdbuf();
    return ::testing::AssertionFailure() << command << '\n' << text.str();
  };
  ASSERT_TRUE(succeeds(" -d " + (folder / "b.db").string() + logs));
  // What the script made of the logs is what our own file says.
  const char* const count_solved =
      "SELECT count(*) FROM runs JOIN enums ON status = value "
      "WHERE description = 'solved'";
  for (const char* sql :
       {"SELECT count(*) FROM runs", "SELECT sum(solved) FROM runs",
        "SELECT count(*) FROM experiments", "SELECT count(*) FROM progress",
        "SELECT count(*) FROM enums", "SELECT sum(pushes) FROM runs WHERE solved",
        "SELECT count(*) FROM runs WHERE cost IS NULL", count_solved,
        "SELECT avg_solved FROM bestPlannerConfigs"}) {
    EXPECT_EQ(asked(folder / "b.db", sql), asked(folder / "a.db", sql)) << sql;
  }
  const char* const times = "SELECT sum(time) + sum(cost) FROM runs";
  EXPECT_NEAR(asked(folder / "b.db", times), asked(folder / "a.db", times), 1e-6);
  // And it works on our file itself.
  ASSERT_TRUE(succeeds(" -v -d " + (folder / "a.db").string()));
  EXPECT_EQ(read_results(folder / "a.db").rows.size(), 12u);
}

}  // namespace
}  // namespace prehensile::suite
