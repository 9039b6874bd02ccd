#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/benchmark_commands.h"
#include "apps/benchmark_page.h"
#include "apps/benchmark_studies.h"
#include "apps/benchmark_text.h"
#include "apps/option_checks.h"
#include "io/plan_file.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files;
  std::string output, floor;
  bool json = false, fail_if_worse = false;
};

/// "report.html" and "runs": report_runs.csv.
fs::path beside(const std::string& page, const std::string& what) {
  const fs::path file = page;
  return file.parent_path() / (file.stem().string() + '_' + what + ".csv");
}

void say_page(const Options& options) {
  if (options.output.empty()) return;
  std::printf("page: %s, and tables beside it\n", options.output.c_str());
}

int report(const Options& options) {
  const suite::Results results = suite::read_results(options.files.front());
  const suite::Summary summary = suite::summarise(results);
  const bool meets_floor =
      options.floor.empty() ||
      missed(parse_floor(options.floor, results), results, summary).empty();
  if (!options.output.empty()) {
    write_atomically(options.output, benchmark_page(results, summary));
    if (!results.families.empty()) {
      write_atomically(beside(options.output, "summary"), summary_csv(results, summary));
      write_atomically(beside(options.output, "runs"), runs_csv(results));
      write_atomically(beside(options.output, "pairs"),
                       comparison_csv(results, suite::compare_planners(results)));
    }
    for (const suite::StudyRecord& study : results.studies) {
      if (study.csv.empty()) continue;
      write_atomically(beside(options.output, "study_" + study.name), study.csv);
    }
  }
  print_results(results, summary, options.json);
  if (!options.json) say_page(options);
  if (meets_floor) return summary.contradictions.empty() ? kDone : kNegative;
  std::fputs(missed(parse_floor(options.floor, results), results, summary).c_str(),
             stderr);
  return kNegative;
}

nlohmann::ordered_json json_of(const std::vector<Finding>& found) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : found) {
    list.push_back({{"change", finding.change == Change::kBetter ? "better" : "worse"},
                    {"what", finding.words}});
  }
  return {{"findings", list}};
}

int compare(const Options& options) {
  const suite::Results before = suite::read_results(options.files[0]);
  const suite::Results after = suite::read_results(options.files[1]);
  const std::vector<suite::Comparison> pairs = suite::compare_results(before, after);
  const bool has_studies = !before.studies.empty() || !after.studies.empty();
  if (pairs.empty()) {
    throw BadInput(options.files[1] + ": has no run in common with " + options.files[0] +
                   (has_studies ? "; studies are not compared" : ""));
  }
  if (!options.output.empty()) {
    write_atomically(options.output, comparison_page(before, after, pairs));
    write_atomically(beside(options.output, "pairs"), comparison_csv(before, pairs));
  }
  const std::vector<Finding> found = findings(before, pairs);
  if (options.json) {
    std::printf("%s\n", json_of(found).dump(2).c_str());
  } else if (found.empty()) {
    std::puts("nothing changed beyond noise");
  } else {
    for (const Finding& finding : found) std::puts(finding.words.c_str());
  }
  if (!options.json) say_page(options);
  if (has_studies && !options.json) std::puts("studies are not compared");
  // The load of a machine at two moments differs beyond the noise of runs: times are
  // said, but decide nothing.
  const bool is_worse = std::any_of(found.begin(), found.end(), [](const Finding& f) {
    return f.change == Change::kWorse && f.measure != Measure::kTime;
  });
  return options.fail_if_worse && is_worse ? kNegative : kDone;
}

int run(const Options& options) {
  if (options.files.size() == 1) return report(options);
  if (!options.floor.empty()) {
    throw BadInput("--fail-below: expected one file of results, not two");
  }
  return compare(options);
}

}  // namespace

Command add_benchmark_report(CLI::App& benchmark) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *benchmark.add_subcommand(
      "report", "what a file of results says, or what changed between two");
  command.add_option("FILES", options->files, "one file of results, or before and after")
      ->required()
      ->expected(1, 2);
  command
      .add_option("-o,--output", options->output,
                  "HTML page to write; tables as CSV go beside it")
      ->check(is_output());
  command.add_option("--fail-below", options->floor,
                     "exit code 1 if a planner's success over all families is less: "
                     "success=0.99, decided=0.9, push.success=0.99");
  command.add_flag("--fail-if-worse", options->fail_if_worse,
                   "of two files: exit code 1 if success or cost got worse beyond noise");
  command.add_flag("--json", options->json, "print one JSON object on stdout");
  command.footer(
      "Example:\n  prehensile benchmark report results.sqlite -o report.html\n"
      "  prehensile benchmark report before.sqlite after.sqlite");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
