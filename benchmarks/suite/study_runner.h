/// Runs studies: programs of the build, each a process with the limits of the suite and a
/// folder of its own for what it writes.
#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "benchmarks/suite/study_record.h"
#include "benchmarks/suite/suite_file.h"
#include "benchmarks/suite/worker_pool.h"

namespace prehensile::suite {

class StudyRunner {
 public:
  /// `programs`: the folder of the build, in which `benchmarks` and `tests` lie. Throws
  /// BadInput for data that lead out of the suite's folder.
  StudyRunner(const SuiteFile& file, std::filesystem::path programs, bool quick);
  /// Removes the folders of studies that did not end. The pool has to be gone.
  ~StudyRunner();
  StudyRunner(const StudyRunner&) = delete;
  StudyRunner& operator=(const StudyRunner&) = delete;

  /// Starts a study of the suite; or says at once why it cannot run.
  std::optional<StudyRecord> start(int study, int ticket, WorkerPool& pool);

  /// What became of a study that was started.
  StudyRecord record_of(int study, const Ending& ending);

 private:
  StudyRecord blank(int study) const;

  const std::vector<Study> studies_;
  std::filesystem::path programs_, data_;
  bool quick_;
  std::map<int, std::filesystem::path> folders_;
};

/// As a study is called in a shell, for people.
std::string command_of(const Study& study, bool quick);

}  // namespace prehensile::suite
