/// The commands below `prehensile benchmark`.
#pragma once

#include <filesystem>
#include <string>

#include "apps/commands.h"
#include "benchmarks/suite/results.h"

namespace prehensile::apps {

Command add_benchmark_merge(CLI::App& benchmark);
Command add_benchmark_report(CLI::App& benchmark);
Command add_benchmark_export(CLI::App& benchmark);
Command add_benchmark_slurm(CLI::App& benchmark);

/// A suite, and where the files that it names lie.
struct SuiteOptions {
  std::string file;
  std::string data;  ///< empty: the folder of the suite
  bool quick = false;
};

/// "I/N", 1 <= I <= N; throws BadInput.
struct Shard {
  int index = 1;
  int count = 1;
};
Shard parse_shard(const std::string& text);

/// "family/17,planner,3" of a suite: one run. Throws BadInput with what exists.
suite::RunKey parse_run(const std::string& text, const suite::Suite& suite,
                        const suite::ProblemList& problems);

}  // namespace prehensile::apps
