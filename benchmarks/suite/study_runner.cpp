#include "benchmarks/suite/study_runner.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <unistd.h>

#include "benchmarks/suite/problem_list.h"
#include "benchmarks/suite/results.h"
#include "benchmarks/suite/study_programs.h"

namespace prehensile::suite {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCsvFile = "runs.csv";
constexpr std::uintmax_t kMostCsv = 64'000'000;  // [byte]
constexpr std::uintmax_t kMostSvg = 8'000'000;   // [byte] of a chart
constexpr std::size_t kMostCharts = 20;

/// Files that the program writes go to the folder that it runs in.
std::vector<std::string> arguments_of(const Study& study, const std::string& data,
                                      bool quick) {
  const StudyProgramFacts& program = program_of(study);
  std::vector<std::string> words;
  if (program.takes_data) words.push_back(data);
  if (program.writes_csv) words.insert(words.end(), {"-o", kCsvFile});
  if (!program.charts.empty()) {
    words.emplace_back(program.charts);
    words.emplace_back(program.charts == "--plots" ? "." : "charts.svg");
  }
  words.insert(words.end(), study.arguments.begin(), study.arguments.end());
  if (quick && program.quick == QuickStudy::kOption) words.emplace_back("--quick");
  return words;
}

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "prehensile_study_XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw BadInput(name + ": cannot be made: expected a folder to write to (TMPDIR)");
  }
  return name;
}

/// A plain file of bounded size; empty if it is none.
std::string text_of(const fs::path& file, std::uintmax_t most, std::string& message) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return {};
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size > most) {
    message += file.filename().string() + " is too large to keep; ";
    return {};
  }
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void read_files(const fs::path& folder, StudyRecord& record) {
  record.csv = text_of(folder / kCsvFile, kMostCsv, record.message);
  std::error_code error;
  std::vector<fs::path> charts;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".svg") charts.push_back(entry.path());
  }
  std::sort(charts.begin(), charts.end());
  charts.resize(std::min(charts.size(), kMostCharts));
  for (const fs::path& chart : charts) {
    const std::string svg = text_of(chart, kMostSvg, record.message);
    if (!svg.empty() && is_word(chart.stem().string()))
      record.charts.push_back({chart.stem().string(), svg});
  }
}

void judge(const Ending& ending, StudyRecord& record) {
  const bool lacked_memory = record.printed.find("bad_alloc") != std::string::npos;
  if (ending.kind == Ending::Kind::kDone) {
    record.status = StudyStatus::kDone;
  } else if (ending.kind == Ending::Kind::kTimeout) {
    record.status = StudyStatus::kTimeout;
    record.message += "killed at the time limit of the suite";
  } else if (lacked_memory) {
    record.status = StudyStatus::kOutOfMemory;
    record.message += "ended at the memory limit of the suite";
  } else if (ending.signal != 0) {
    record.status = StudyStatus::kCrashed;
    record.message += "ended by signal " + std::to_string(ending.signal);
  } else if (ending.exit_code == kExitNotStarted) {
    record.status = StudyStatus::kFailed;
    record.message += "cannot be started";
  } else {
    record.status = StudyStatus::kFailed;
    record.message += "exit code " + std::to_string(ending.exit_code);
  }
}

}  // namespace

std::string command_of(const Study& study, bool quick) {
  std::string words(program_of(study).file);
  for (const std::string& word : arguments_of(study, study.data, quick)) {
    words += ' ' + word;
  }
  return words;
}

StudyRunner::StudyRunner(const SuiteFile& file, fs::path programs, bool quick)
    : studies_(file.suite.studies),
      programs_(std::move(programs)),
      data_(file.folder.empty() ? fs::path(".") : file.folder),
      quick_(quick) {
  for (const Study& study : studies_) {
    if (study.data.empty() || !fs::exists(data_ / study.data)) continue;
    if (is_below(data_, data_ / study.data)) continue;
    throw BadInput("study " + study.name + ": " + study.data + ": leads out of " +
                   data_.string());
  }
}

StudyRunner::~StudyRunner() {
  std::error_code ignored;
  for (const auto& [study, folder] : folders_) fs::remove_all(folder, ignored);
}

StudyRecord StudyRunner::blank(int study) const {
  const Study& asked = studies_[static_cast<std::size_t>(study)];
  const Provenance here = provenance_here({});
  StudyRecord record;
  record.study = study;
  record.name = asked.name;
  record.command = command_of(asked, quick_);
  record.host = host_name();
  record.machine = here.machine;
  record.date = here.date;
  return record;
}

std::optional<StudyRecord> StudyRunner::start(int study, int ticket, WorkerPool& pool) {
  const Study& asked = studies_[static_cast<std::size_t>(study)];
  const StudyProgramFacts& program = program_of(asked);
  const fs::path file = programs_ / program.file;
  const auto refused = [&](StudyStatus status, const std::string& why) {
    StudyRecord record = blank(study);
    record.status = status;
    record.message = why;
    return record;
  };
  std::error_code error;
  if (quick_ && program.quick == QuickStudy::kLeftOut) {
    return refused(StudyStatus::kSkipped, "has no quick variant");
  }
  if (!fs::is_regular_file(file, error)) {
    return refused(StudyStatus::kNotBuilt, "no program " + file.string());
  }
  std::string data;
  if (program.takes_data) {
    const fs::path folder = fs::weakly_canonical(data_ / asked.data, error);
    if (error || !fs::is_directory(folder, error)) {
      return refused(StudyStatus::kSkipped, "no folder " + (data_ / asked.data).string() +
                                                ": expected the data there, or --data");
    }
    data = folder.string();
  }
  const fs::path folder = folders_[study] = new_folder();
  pool.start(ticket, ProgramCall{.program = file,
                                 .arguments = arguments_of(asked, data, quick_),
                                 .folder = folder});
  return std::nullopt;
}

StudyRecord StudyRunner::record_of(int study, const Ending& ending) {
  StudyRecord record = blank(study);
  record.exit_code = ending.exit_code;
  record.signal = ending.signal;
  record.time = ending.cpu_time;
  record.wall_time = ending.wall_time;
  record.memory = ending.memory_MB;
  record.printed = ending.text;
  const fs::path folder = folders_[study];
  read_files(folder, record);
  judge(ending, record);
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  folders_.erase(study);
  return record;
}

}  // namespace prehensile::suite
