#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>

#include "apps/benchmark_commands.h"
#include "apps/benchmark_progress.h"
#include "apps/benchmark_studies.h"
#include "apps/benchmark_text.h"
#include "apps/interrupt.h"
#include "apps/option_checks.h"
#include "apps/version.h"
#include "benchmarks/suite/run_suite.h"
#include "io/plan_file.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  SuiteOptions suite;
  std::string output, shard, only, scene;
  std::string floor;
  int jobs = 0;
  double progress_seconds = 5.0;
  bool resume = false, json = false, list = false;
};

int jobs_of(const Options& options) {
  if (options.jobs > 0) return options.jobs;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

suite::Results header_of(const Options& options, const suite::SuiteFile& file,
                         const suite::ProblemList& problems) {
  suite::Provenance provenance = suite::provenance_here(version());
  provenance.quick = options.suite.quick;
  provenance.command = command_line();
  return suite::header_of(file, problems, provenance);
}

/// The programs of studies lie below the folder of this one.
std::filesystem::path folder_of_programs() {
  return std::filesystem::canonical("/proc/self/exe").parent_path();
}

/// One study again, in a process of its own; nothing if the suite has none of this name.
std::optional<int> run_only_study(const Options& options, const suite::SuiteFile& file) {
  const std::vector<suite::Study>& studies = file.suite.studies;
  const auto found =
      std::find_if(studies.begin(), studies.end(),
                   [&](const suite::Study& study) { return study.name == options.only; });
  if (found == studies.end()) return std::nullopt;
  suite::StudyRunner runner(file, folder_of_programs(), options.suite.quick);
  const suite::StudyRecord record =
      study_apart(file.suite, runner, static_cast<int>(found - studies.begin()));
  print_json(to_json(record));
  return record.status == suite::StudyStatus::kDone ? kDone : kNegative;
}

/// One run again, in a process of its own, and what became of it.
int run_only(const Options& options, const suite::SuiteFile& file,
             const suite::ProblemList& problems, const suite::PlannerTable& planners) {
  if (const auto code = run_only_study(options, file)) return *code;
  const suite::RunKey key = parse_run(options.only, file.suite, problems);
  if (!options.scene.empty()) {
    write_atomically(options.scene,
                     scene_to_yaml(problems.scene(key.family, key.problem)));
  }
  const suite::Results header = header_of(options, file, problems);
  const suite::RunRecord record = run_apart(file.suite, problems, planners, key);
  std::printf("%s\n", to_json(header, {key, record}).dump(2).c_str());
  return record.decided() ? kDone : kNegative;
}

int list_suite(const suite::Suite& suite, const suite::ProblemList& problems,
               bool quick) {
  for (int family = 0; family < problems.families(); ++family) {
    std::printf("%-40s %7d problems%s\n", problems.name(family).c_str(),
                problems.count(family),
                problems.is_constructed(family) ? ", made by pushes" : "");
  }
  std::printf("%-40s %7d problems\n", "all", problems.count());
  for (const suite::Study& study : suite.studies) {
    std::printf("study %-34s %s\n", study.name.c_str(),
                suite::command_of(study, quick).c_str());
  }
  return kDone;
}

/// Runs what the file lacks and tells how it went.
int run_all(const Options& options, const suite::SuiteFile& file,
            const suite::ProblemList& problems, const suite::PlannerTable& planners) {
  const bool is_part = !options.shard.empty();
  const Shard shard = is_part ? parse_shard(options.shard) : Shard{};
  const std::atomic<bool>& stop = stop_on_signals();
  std::signal(SIGXFSZ, SIG_IGN);  // a full disk is an error to report, not a death
  suite::StudyRunner studies(file, folder_of_programs(), options.suite.quick);
  const suite::Results header = header_of(options, file, problems);
  // What is wrong with it is told before hours of work.
  if (!options.floor.empty()) parse_floor(options.floor, header);
  suite::ResultsWriter writer(options.output, header, options.resume);
  SuiteProgressLine line(options.progress_seconds);
  suite::RunOptions run;
  run.jobs = jobs_of(options);
  run.shard = shard.index;
  run.shards = shard.count;
  run.stop = &stop;
  run.studies = &studies;
  run.progress = [&line](const suite::RunProgress& progress) { line.show(progress); };
  const suite::RunCount count = run_suite(file.suite, problems, planners, run, writer);
  writer.close(line.seconds());
  line.end();

  const suite::Results results = suite::read_results(options.output);
  const suite::Summary summary = suite::summarise(results);
  print_results(results, summary, options.json);
  if (!options.json) {
    std::printf("%d runs in %.1f s, %zu rows in %s\n", count.done, line.seconds(),
                results.rows.size() + results.studies.size(), options.output.c_str());
  }
  if (count.stopped) {
    std::fprintf(stderr, "stopped: go on with --resume\n");
    return kNegative;
  }
  if (is_part) return kDone;  // the merged file is for judging
  const std::string unsound = unsound_studies(results);
  std::fputs(unsound.c_str(), stderr);
  if (!summary.contradictions.empty() || !unsound.empty()) return kNegative;
  if (options.floor.empty()) return kDone;
  const std::string below = missed(parse_floor(options.floor, results), results, summary);
  std::fputs(below.c_str(), stderr);
  return below.empty() ? kDone : kNegative;
}

int run(const Options& options) {
  if (options.suite.file.empty()) {
    throw BadInput("benchmark: expected a suite file, or merge, report, export or slurm");
  }
  const suite::PlannerTable planners = suite::planners_of_build();
  const suite::SuiteFile file =
      suite::read_suite(options.suite.file, suite::names(planners), options.suite.data);
  const suite::ProblemList problems(file, options.suite.quick);
  if (options.list) return list_suite(file.suite, problems, options.suite.quick);
  if (!options.only.empty()) return run_only(options, file, problems, planners);
  if (options.output.empty()) {
    throw BadInput("benchmark: -o: missing: expected the file of results to write");
  }
  return run_all(options, file, problems, planners);
}

}  // namespace

Command add_benchmark(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "benchmark", "run a suite: planners on problems, and studies, one process each");
  command.add_option("SUITE", options->suite.file, "suite file (YAML)");
  command.add_option("-o,--output", options->output, "file of results (SQLite)")
      ->check(is_output());
  command.add_option("--data", options->suite.data,
                     "folder of the files that the suite names; by default its own");
  command.add_flag("--quick", options->suite.quick,
                   "few problems of each family, small studies");
  command
      .add_option("--jobs", options->jobs, "processes at a time; 0: one for each core")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--resume", options->resume,
                   "go on with the file of results where it ends, or begin it");
  command.add_option("--shard", options->shard,
                     "I/N: every N-th run and study only, from the I-th; merge the files "
                     "later");
  CLI::Option* const only = command.add_option(
      "--only", options->only,
      "PROBLEM,PLANNER,SEED: one run again, as in wide_square/17,push,1, or "
      "the name of a study; prints its row as JSON");
  command.add_option("--scene", options->scene, "write the scene of the problem")
      ->check(is_output())
      ->needs(only);
  command.add_flag("--list", options->list,
                   "print families, counts and studies, run nothing");
  command.add_option("--fail-below", options->floor,
                     "exit code 1 if a planner's success over all families is less: "
                     "success=0.99, decided=0.9, push.success=0.99");
  command
      .add_option("--progress-s", options->progress_seconds,
                  "seconds between lines of progress")
      ->check(in_range(0.0, 1e6))
      ->capture_default_str();
  command.add_flag("--json", options->json, "print one JSON object on stdout");
  const Command merge = add_benchmark_merge(command);
  const Command report = add_benchmark_report(command);
  const Command exporting = add_benchmark_export(command);
  const Command slurm = add_benchmark_slurm(command);
  command.require_subcommand(0, 1);
  command.footer(
      "Ctrl-C keeps the rows that are there (exit code 1); --resume goes on. Crashes, "
      "time-outs\nand exhausted memory of a run are rows. A study that fails makes the "
      "exit "
      "code 1.\n"
      "Example:\n  prehensile benchmark benchmarks/suites/quick.yaml -o quick.sqlite\n"
      "  prehensile benchmark report quick.sqlite -o quick.html");
  return [options, &command, merge, report, exporting, slurm] {
    if (command.got_subcommand("merge")) return merge();
    if (command.got_subcommand("report")) return report();
    if (command.got_subcommand("export")) return exporting();
    if (command.got_subcommand("slurm")) return slurm();
    return run(*options);
  };
}

}  // namespace prehensile::apps
