/// The results of a suite, in a SQLite file with the schema of OMPL's benchmark database:
/// a family of problems is an experiment, an entry of the suite's planners a planner
/// configuration, a run a row. OMPL's `ompl_benchmark_statistics` and Planner Arena read
/// it. Beside their tables, `suite` holds what the runs came from, and `studies` with
/// `study_charts` what other programs measured.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/suite/problem_list.h"
#include "benchmarks/suite/run_record.h"
#include "benchmarks/suite/study_record.h"
#include "benchmarks/suite/suite_file.h"

namespace prehensile::suite {

class Database;
class Statement;

/// What all rows of a file have in common.
struct Provenance {
  std::string suite_text;
  bool quick = false;
  std::string version;  ///< of the program
  std::string build;    ///< compiler and build type
  std::string machine;  ///< processor and number of cores
  std::string command;  ///< as typed
  std::string date;     ///< of the first start, UTC

  /// Files may be resumed and merged where this agrees.
  std::string digest() const;
};

/// Version, build and machine of this process; the rest is the caller's.
Provenance provenance_here(const std::string& version);

struct ResultRow {
  RunKey key;
  RunRecord record;
};

/// A whole file of results in memory. Families and planners in the order of the suite.
struct Results {
  std::string suite;  ///< its name
  std::string host;   ///< where it was begun
  Provenance provenance;
  struct FamilyInfo {
    std::string name;
    int count = 0;  ///< problems
  };
  std::vector<FamilyInfo> families;
  struct PlannerInfo {
    std::string name;
    std::string settings;
  };
  std::vector<PlannerInfo> planners;
  double cpu_limit = 0.0, memory_limit_MB = 0.0;
  std::vector<ResultRow> rows;       ///< by key
  std::vector<StudyRecord> studies;  ///< by their place in the suite
};

/// The same without rows, before a run.
Results header_of(const SuiteFile& suite, const ProblemList& problems,
                  const Provenance& provenance);

/// Reads a file; throws BadInput for one that is none of ours.
Results read_results(const std::filesystem::path& file);

/// A file that grows row by row. A row is there in full once `add` has returned, whatever
/// becomes of the process.
class ResultsWriter {
 public:
  /// A new file, or with `resume` one that goes on if it exists. Throws BadInput where it
  /// belongs to another suite, version or build.
  ResultsWriter(const std::filesystem::path& file, const Results& header, bool resume);
  ~ResultsWriter();
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  const std::set<RunKey>& done() const { return done_; }
  /// Studies that need not run again.
  const std::set<int>& studies_done() const { return studies_done_; }
  /// False if the row is there already.
  bool add(const ResultRow& row);
  bool add(const StudyRecord& record);
  /// Adds to the time spent and leaves a single file.
  void close(double wall_time);

 private:
  void read_done();

  std::unique_ptr<Database> database_;
  std::unique_ptr<Statement> insert_, insert_progress_;
  std::set<RunKey> done_;
  std::set<int> studies_done_;
};

/// How a merge went.
struct Merged {
  int files = 0;
  int rows = 0;     ///< of runs and of studies
  int doubled = 0;  ///< rows that several files had, kept once
};

/// One new file, written to a temporary and renamed, from files of the same suite. Throws
/// BadInput where they differ, or where they answer the same run differently. Of studies,
/// whose figures are times, the first that ran is kept.
Merged merge_results(const std::vector<std::filesystem::path>& files,
                     const std::filesystem::path& output);

}  // namespace prehensile::suite
