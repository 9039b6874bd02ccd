/// One row of the results of studies: what a program measured.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/suite/run_record.h"

namespace prehensile::suite {

/// How a study ended.
enum class StudyStatus {
  kDone,         ///< exit code 0
  kFailed,       ///< another exit code
  kTimeout,      ///< killed at the time limit of the suite
  kOutOfMemory,  ///< ended at the memory limit of the suite
  kCrashed,      ///< ended by a signal
  kNotBuilt,     ///< the build has no such program
  kSkipped       ///< its data are not there, or it has no quick variant
};
inline constexpr std::array<std::string_view, 7> kStudyStatusNames = {
    "done", "failed", "timeout", "out_of_memory", "crashed", "not_built", "skipped"};
inline std::string_view name(StudyStatus status) {
  return kStudyStatusNames[static_cast<std::size_t>(status)];
}

struct StudyChart {
  std::string name;  ///< of the file, without .svg
  std::string svg;   ///< as the program wrote it, or as somebody else's file says
};

struct StudyRecord {
  int study = 0;  ///< index in the suite
  std::string name;
  StudyStatus status = StudyStatus::kCrashed;
  std::string command;          ///< as run, files in a folder of its own
  int exit_code = -1;           ///< -1: none
  int signal = 0;               ///< that ended it; 0: none
  double time = kNothing;       ///< [s] processor time of the process
  double wall_time = kNothing;  ///< [s]
  double memory = kNothing;     ///< [MB] most that the process had
  std::string message;          ///< why it is not done; one line
  std::string host;
  std::string machine;
  std::string date;     ///< of its end, UTC
  std::string printed;  ///< its table, and what else it said
  std::string csv;      ///< its runs
  std::vector<StudyChart> charts;

  /// Whether the program ran: a file that goes on does not run it again.
  bool has_run() const {
    return status != StudyStatus::kNotBuilt && status != StudyStatus::kSkipped;
  }
  /// Whether it did what was asked for, as far as that could be.
  bool is_sound() const {
    return status == StudyStatus::kDone || status == StudyStatus::kSkipped;
  }
};

/// The columns of a record that are plain: f(name, member). Status and charts are not.
template <typename Record, typename F>
void visit_study_columns(Record& r, F&& f) {
  f("name", r.name);
  f("command", r.command);
  f("exit_code", r.exit_code);
  f("signal", r.signal);
  f("time", r.time);
  f("wall_time", r.wall_time);
  f("memory", r.memory);
  f("message", r.message);
  f("host", r.host);
  f("machine", r.machine);
  f("date", r.date);
  f("printed", r.printed);
  f("csv", r.csv);
}

}  // namespace prehensile::suite
