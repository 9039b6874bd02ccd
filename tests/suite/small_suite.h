/// A suite of a few fast problems, and a folder for its results.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "benchmarks/suite/run_suite.h"
#include "tests/io/files.h"

namespace prehensile::suite::testing {

using prehensile::testing::Folder;

inline std::string small_suite(const std::string& planners = "  - {planner: push}\n",
                               const std::string& limits = "") {
  return "version: 1\nname: small\nfamilies:\n"
         "  - {name: published, published: {object: square, count: 4}}\n"
         "  - {name: boxes, random: {object: box, count: 4}}\n"
         "  - {name: convex, fixtures: {object: convex, goals: random, count: 4}}\n"
         "planners:\n" +
         planners + limits;
}

/// A suite, its problems, its planners and their results.
struct Bench {
  PlannerTable planners;
  SuiteFile file;
  ProblemList problems;

  explicit Bench(const std::string& text, PlannerTable table = planners_of_build())
      : planners(std::move(table)),
        file(parse_suite(text, "small.yaml", names(planners), "")),
        problems(file, false) {}

  Results header() const { return header_of(file, problems, provenance_here("test")); }

  RunCount run(const std::filesystem::path& output, const RunOptions& options = {},
               bool resume = false) const {
    ResultsWriter writer(output, header(), resume);
    const RunCount count = run_suite(file.suite, problems, planners, options, writer);
    writer.close(1.0);
    return count;
  }
};

/// Everything about the rows that does not depend on clock, load or machine.
inline std::string facts(const Results& results) {
  std::string out;
  for (const ResultRow& row : results.rows) {
    RunRecord record = row.record;
    record.progress.clear();
    visit_columns(record, [](const char* name, auto& value) {
      if (is_measurement(name)) value = {};
    });
    for (const int part : {row.key.family, row.key.problem, row.key.planner, row.key.seed,
                           row.key.repetition}) {
      out += std::to_string(part) + ' ';
    }
    out += to_text(record);
  }
  return out;
}

}  // namespace prehensile::suite::testing
