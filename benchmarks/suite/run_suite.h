/// Runs a suite: every planner on every problem, and every study, each in a process of
/// its own, each a row.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "benchmarks/suite/results.h"
#include "benchmarks/suite/run_one.h"
#include "benchmarks/suite/study_runner.h"

namespace prehensile::suite {

struct RunProgress {
  int done = 0;  ///< rows in the file, studies and those of earlier starts included
  int wanted = 0;
  int running = 0;
  double runs_per_second = 0.0;  ///< since this start
  double seconds_left = kNothing;
};

struct RunOptions {
  int jobs = 1;                    ///< processes at a time, >= 1
  int shard = 1, shards = 1;       ///< only every shards-th run, from the shard-th
  StudyRunner* studies = nullptr;  ///< null: the suite's studies are left out
  const std::atomic<bool>* stop =
      nullptr;  ///< set: no new runs, those under way are lost
  std::function<void(const RunProgress&)> progress;  ///< told after every run
};

/// All runs of a suite in their order: problem by problem, so that the first part of a
/// suite has all planners; of them, with several shards, the shard's.
std::vector<RunKey> runs_of(const Suite& suite, const ProblemList& problems,
                            const RunOptions& options);

/// The studies of a suite, numbered from 0; with several shards those that are the
/// shard's where they stand behind all runs.
std::vector<int> studies_of(const Suite& suite, const ProblemList& problems,
                            const RunOptions& options);

/// One study in a process of its own.
StudyRecord study_apart(const Suite& suite, StudyRunner& runner, int study);

/// One run in a process of its own.
RunRecord run_apart(const Suite& suite, const ProblemList& problems,
                    const PlannerTable& planners, const RunKey& key);

struct RunCount {
  int done = 0;  ///< rows that this call added
  bool stopped = false;
};

/// Adds the rows that the file lacks.
RunCount run_suite(const Suite& suite, const ProblemList& problems,
                   const PlannerTable& planners, const RunOptions& options,
                   ResultsWriter& results);

}  // namespace prehensile::suite
