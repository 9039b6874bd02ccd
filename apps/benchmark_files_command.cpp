/// `prehensile benchmark merge` and `export`: files of results into others.
#include <cstdio>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/benchmark_commands.h"
#include "apps/option_checks.h"
#include "benchmarks/suite/ompl_log.h"
#include "io/plan_file.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string output;
};

int merge(const Options& options) {
  const suite::Merged merged =
      suite::merge_results({options.files.begin(), options.files.end()}, options.output);
  std::printf("%d files, %d rows in %s; %d rows that several files had\n", merged.files,
              merged.rows, options.output.c_str(), merged.doubled);
  return kDone;
}

int export_logs(const Options& options) {
  namespace fs = std::filesystem;
  const suite::Results results = suite::read_results(options.files.front());
  std::error_code error;
  fs::create_directories(options.output, error);
  if (error) throw BadInput(options.output + ": cannot be made: " + error.message());
  for (std::size_t i = 0; i < results.families.size(); ++i) {
    const fs::path file = fs::path(options.output) / (results.families[i].name + ".log");
    write_atomically(file, suite::ompl_log(results, static_cast<int>(i)));
  }
  std::printf("%zu logs in %s\n", results.families.size(), options.output.c_str());
  return kDone;
}

}  // namespace

Command add_benchmark_merge(CLI::App& benchmark) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *benchmark.add_subcommand(
      "merge", "one file of results from several of the same suite");
  command.add_option("FILES", options->files, "files of results")->required();
  command.add_option("-o,--output", options->output, "new file of results")
      ->check(is_output())
      ->required();
  command.footer(
      "Example:\n  prehensile benchmark merge a.sqlite b.sqlite -o all.sqlite");
  return [options] { return merge(*options); };
}

Command add_benchmark_export(CLI::App& benchmark) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *benchmark.add_subcommand(
      "export", "results as logs of OMPL's benchmarks, one for each family");
  command.add_option("FILE", options->files, "file of results")->required()->expected(1);
  command.add_option("-o,--output", options->output, "folder for the logs")->required();
  command.footer(
      "OMPL's script reads the logs, and the file of results itself:\n"
      "  prehensile benchmark export quick.sqlite -o logs\n"
      "  ompl_benchmark_statistics -d ompl.db logs/*.log");
  return [options] { return export_logs(*options); };
}

}  // namespace prehensile::apps
