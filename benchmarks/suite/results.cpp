#include "benchmarks/suite/results.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <map>
#include <sys/utsname.h>
#include <unistd.h>

#include "benchmarks/suite/results_schema.h"
#include "benchmarks/suite/study_results.h"
#include "io/document.h"

namespace prehensile::suite {
namespace {

namespace fs = std::filesystem;

std::string build_name() {
  std::string name =
#if defined(__clang__)
      "clang " __clang_version__;
#elif defined(__GNUC__)
      "gcc " __VERSION__;
#else
      "unknown compiler";
#endif
#if !defined(NDEBUG)
  name += ", with assertions";
#elif defined(__AVX__)
  name += ", tuned release";
#else
  name += ", portable release";
#endif
  return name;
}

std::string machine_name() {
  std::string model = "unknown processor";
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    model = line.substr(colon + 2);
    break;
  }
  utsname system{};
  const char* kernel = ::uname(&system) == 0 ? system.release : "unknown";
  return model + ", " + std::to_string(::sysconf(_SC_NPROCESSORS_ONLN)) +
         " cores, Linux " + kernel;
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

std::string settings_of(const PlannerEntry& entry) {
  std::string text = "planner = " + entry.planner;
  const auto add = [&text](const char* key, const std::string& value) {
    text += std::string("; ") + key + " = " + value;
  };
  char number[32];
  const auto with = [&number](double value) {
    std::snprintf(number, sizeof number, "%.10g", value);
    return std::string(number);
  };
  add("budget", with(entry.budget));
  add("time", with(entry.time_limit));
  add("margin", with(entry.margin));
  add("until", entry.until == SearchUntil::kBudget ? "budget" : "first_plan");
  add("polish", entry.polish ? "nlopt" : "none");
  add("seeds", std::to_string(entry.seeds));
  for (const auto& [name, value] : entry.settings) add(name.c_str(), with(value));
  return text;
}

/// [s] that the programs which wrote a file ran.
double total_time(const fs::path& file) {
  Database database(file, Database::Open::kRead);
  Statement spent(database, "SELECT max(totaltime) FROM experiments");
  return spent.step() ? spent.real(0) : 0.0;
}

/// What two answers to one run must share.
bool agree(const RunRecord& a, const RunRecord& b) {
  std::string text_a, text_b;
  const auto collect = [](const RunRecord& record, std::string& text) {
    RunRecord copy = record;
    copy.progress.clear();
    visit_columns(copy, [](const char* name, auto& value) {
      if (is_measurement(name)) value = {};
    });
    text = to_text(copy);
  };
  collect(a, text_a);
  collect(b, text_b);
  return text_a == text_b;
}

}  // namespace

std::string Provenance::digest() const {
  return internal::digest_of(suite_text + '\n' + (quick ? "quick" : "whole") + '\n' +
                             version + '\n' + build);
}

Provenance provenance_here(const std::string& version) {
  Provenance provenance;
  provenance.version = version;
  provenance.build = build_name();
  provenance.machine = machine_name();
  provenance.date = date_now();
  return provenance;
}

Results header_of(const SuiteFile& suite, const ProblemList& problems,
                  const Provenance& provenance) {
  Results header;
  header.suite = suite.suite.name;
  header.host = host_name();
  header.provenance = provenance;
  header.provenance.suite_text = suite.text;
  for (int i = 0; i < problems.families(); ++i) {
    header.families.push_back({problems.name(i), problems.count(i)});
  }
  for (const PlannerEntry& entry : suite.suite.planners) {
    header.planners.push_back({entry.label(), settings_of(entry)});
  }
  header.cpu_limit = suite.suite.limits.cpu_time;
  header.memory_limit_MB = suite.suite.limits.memory_MB;
  return header;
}

Results read_results(const fs::path& file) {
  Database database(file, Database::Open::kRead);
  Results results = read_header(database, file);
  const int families = static_cast<int>(results.families.size());
  const int planners = static_cast<int>(results.planners.size());
  std::map<std::int64_t, std::size_t> row_of_id;
  Statement runs(database, std::string("SELECT ") + kKeyColumns + ", " + value_columns() +
                               ", id FROM runs ORDER BY experimentid, problem, "
                               "plannerid, seed, repetition");
  int columns = kKeyColumnCount + 2;
  RunRecord blank;
  visit_columns(blank, [&](const char*, const auto&) { ++columns; });
  while (runs.step()) {
    ResultRow row = read_row(runs);
    const int status = static_cast<int>(row.record.status);
    const bool sound = row.key.family >= 0 && row.key.family < families &&
                       row.key.planner >= 0 && row.key.planner < planners &&
                       row.key.problem >= 0 && status >= 0 &&
                       status < static_cast<int>(kRunStatusNames.size());
    if (!sound) throw BadInput(file.string() + ": a row names what the file lacks");
    row_of_id[runs.integer(columns)] = results.rows.size();
    results.rows.push_back(std::move(row));
  }
  Statement progress(database,
                     "SELECT runid, time, best_cost FROM progress ORDER BY runid, time");
  while (progress.step()) {
    const auto found = row_of_id.find(progress.integer(0));
    if (found == row_of_id.end()) continue;
    results.rows[found->second].record.progress.push_back(
        {progress.real(1), progress.real(2)});
  }
  results.studies = read_studies(database, file);
  return results;
}

ResultsWriter::ResultsWriter(const fs::path& file, const Results& header, bool resume) {
  const bool goes_on = resume && fs::exists(file);
  database_ = std::make_unique<Database>(
      file, goes_on ? Database::Open::kAppend : Database::Open::kCreate);
  // A process may have died before its first transaction was through.
  Statement tables(*database_, "SELECT count(*) FROM sqlite_master");
  const bool is_empty = tables.step() && tables.integer(0) == 0;
  tables.step();
  if (is_empty) write_header(*database_, header);
  const Results found = read_header(*database_, file);
  const auto same_families = [](const auto& a, const auto& b) {
    return a.name == b.name && a.count == b.count;
  };
  const bool same =
      found.provenance.digest() == header.provenance.digest() &&
      std::equal(found.families.begin(), found.families.end(), header.families.begin(),
                 header.families.end(), same_families);
  if (!same) {
    throw BadInput(file.string() +
                   ": holds results of another suite, version or build (" + found.suite +
                   ", " + found.provenance.version + ", " + found.provenance.build +
                   "): expected the same, or another output file");
  }
  make_study_tables(*database_);
  read_done();
  std::string places;
  RunRecord blank;
  visit_columns(blank, [&](const char*, const auto&) { places += ", ?"; });
  insert_ = std::make_unique<Statement>(
      *database_, std::string("INSERT OR IGNORE INTO runs (") + kKeyColumns + ", " +
                      value_columns() + ") VALUES (?, ?, ?, ?, ?, ?, ?" + places + ')');
  insert_progress_ = std::make_unique<Statement>(
      *database_, "INSERT OR REPLACE INTO progress VALUES (?, ?, ?)");
}

ResultsWriter::~ResultsWriter() = default;

void ResultsWriter::read_done() {
  Statement keys(*database_, std::string("SELECT ") + kKeyColumns + " FROM runs");
  while (keys.step()) {
    const auto whole = [&](int column) { return static_cast<int>(keys.integer(column)); };
    done_.insert({whole(0) - 1, whole(2) - 1, whole(1) - 1, whole(3), whole(4)});
  }
  studies_done_ = studies_that_ran(*database_);
}

bool ResultsWriter::add(const StudyRecord& record) {
  try {
    database_->begin();
    const bool is_new = write_study(*database_, record);
    database_->commit();
    if (record.has_run()) studies_done_.insert(record.study);
    return is_new;
  } catch (...) {
    database_->roll_back();
    throw;
  }
}

bool ResultsWriter::add(const ResultRow& row) {
  try {
    database_->begin();
    bind_row(*insert_, row);
    insert_->step();
    const bool is_new = database_->changes() == 1;
    const std::int64_t id = database_->last_id();
    for (const ProgressPoint& point : row.record.progress) {
      if (!is_new) break;
      insert_progress_->bind(0, id);
      insert_progress_->bind(1, point.time);
      insert_progress_->bind(2, point.best_cost);
      insert_progress_->step();
    }
    database_->commit();
    done_.insert(row.key);
    return is_new;
  } catch (...) {
    database_->roll_back();
    throw;
  }
}

void ResultsWriter::close(double wall_time) {
  {
    Statement spent(*database_, "UPDATE experiments SET totaltime = totaltime + ?");
    spent.bind(0, wall_time);
    spent.step();
  }
  insert_.reset();
  insert_progress_.reset();
  database_->close();
}

Merged merge_results(const std::vector<fs::path>& files, const fs::path& output) {
  if (fs::exists(output)) {
    throw BadInput(output.string() + ": exists: expected a new file");
  }
  Merged merged;
  double spent = 0.0;
  std::map<RunKey, RunRecord> rows;
  std::map<int, StudyRecord> studies;
  Results header;
  for (const fs::path& file : files) {
    Results part = read_results(file);
    spent += total_time(file);
    if (merged.files > 0 && part.provenance.digest() != header.provenance.digest()) {
      throw BadInput(file.string() +
                     ": holds results of another suite, version or build "
                     "than " +
                     files.front().string());
    }
    for (ResultRow& row : part.rows) {
      const auto [place, is_new] = rows.try_emplace(row.key, row.record);
      if (is_new) continue;
      ++merged.doubled;
      if (!agree(place->second, row.record)) {
        throw BadInput(file.string() + ": family " +
                       part.families[static_cast<std::size_t>(row.key.family)].name +
                       ", problem " + std::to_string(row.key.problem + 1) +
                       ": another result than in the files before it");
      }
    }
    for (StudyRecord& study : part.studies) {
      const auto [place, is_new] = studies.try_emplace(study.study, study);
      if (is_new) continue;
      ++merged.doubled;
      if (!place->second.has_run()) place->second = std::move(study);
    }
    if (merged.files++ == 0) {
      part.rows.clear();
      part.studies.clear();
      header = std::move(part);
    }
  }
  merged.rows = static_cast<int>(rows.size() + studies.size());
  const fs::path temporary = output.string() + ".part" + std::to_string(::getpid());
  try {
    ResultsWriter writer(temporary, header, false);
    for (auto& [key, record] : rows) writer.add({key, std::move(record)});
    for (const auto& [study, record] : studies) writer.add(record);
    writer.close(spent);
    fs::rename(temporary, output);
  } catch (...) {
    std::error_code ignored;
    for (const char* ending : {"", "-wal", "-journal"}) {
      fs::remove(temporary.string() + ending, ignored);
    }
    throw;
  }
  return merged;
}

}  // namespace prehensile::suite
