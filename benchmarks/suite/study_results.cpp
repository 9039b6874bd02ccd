#include "benchmarks/suite/study_results.h"

#include <algorithm>
#include <type_traits>

#include "benchmarks/suite/suite_file.h"

namespace prehensile::suite {
namespace {

bool has_tables(Database& database) {
  Statement count(database,
                  "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN "
                  "('studies', 'study_charts')");
  return count.step() && count.integer(0) == 2;
}

/// Values as the columns of a record have them, in their order from `at`.
void bind_columns(Statement& statement, int at, const StudyRecord& record) {
  visit_study_columns(record, [&](const char*, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, int>) {
      statement.bind(at++, static_cast<std::int64_t>(value));
    } else {
      statement.bind(at++, value);
    }
  });
}

void read_columns(const Statement& statement, int at, StudyRecord& record) {
  visit_study_columns(record, [&](const char*, auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      value = statement.text(at++);
    } else if constexpr (std::is_same_v<T, double>) {
      value = statement.real(at++);
    } else {
      value = static_cast<int>(statement.integer(at++));
    }
  });
}

/// "name, command, ..." and as many places.
void list_columns(std::string& names, std::string& places) {
  StudyRecord blank;
  visit_study_columns(blank, [&](const char* name, const auto&) {
    names += std::string(", ") + name;
    places += ", ?";
  });
}

}  // namespace

void make_study_tables(Database& database) {
  if (has_tables(database)) return;
  std::string sql = "CREATE TABLE studies (id INTEGER PRIMARY KEY, status TEXT";
  StudyRecord blank;
  visit_study_columns(blank, [&](const char* name, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    const char* const type = std::is_same_v<T, double> ? " REAL"
                             : std::is_same_v<T, int>  ? " INTEGER"
                                                       : " TEXT";
    sql += std::string(", ") + name + type;
  });
  database.begin();
  database.run(sql + ")");
  database.run(
      "CREATE TABLE study_charts (studyid INTEGER, name TEXT, svg TEXT, PRIMARY KEY "
      "(studyid, name), FOREIGN KEY (studyid) REFERENCES studies(id) ON DELETE CASCADE)");
  database.commit();
}

std::vector<StudyRecord> read_studies(Database& database,
                                      const std::filesystem::path& file) {
  std::vector<StudyRecord> records;
  if (!has_tables(database)) return records;
  std::string names = "SELECT id, status", places;
  list_columns(names, places);
  Statement rows(database, names + " FROM studies ORDER BY id");
  Statement charts(database,
                   "SELECT name, svg FROM study_charts WHERE studyid = ? ORDER BY name");
  while (rows.step()) {
    StudyRecord& record = records.emplace_back();
    record.study = static_cast<int>(rows.integer(0)) - 1;
    const auto status =
        std::find(kStudyStatusNames.begin(), kStudyStatusNames.end(), rows.text(1));
    read_columns(rows, 2, record);
    bool sound = status != kStudyStatusNames.end() && is_word(record.name);
    charts.bind(0, rows.integer(0));
    while (charts.step()) {
      record.charts.push_back({charts.text(0), charts.text(1)});
      sound = sound && is_word(record.charts.back().name);
    }
    if (!sound) throw BadInput(file.string() + ": a study that no suite may have");
    record.status = static_cast<StudyStatus>(status - kStudyStatusNames.begin());
  }
  return records;
}

std::set<int> studies_that_ran(Database& database) {
  std::set<int> found;
  Statement rows(database,
                 "SELECT id FROM studies WHERE status NOT IN ('not_built', 'skipped')");
  while (rows.step()) found.insert(static_cast<int>(rows.integer(0)) - 1);
  return found;
}

bool write_study(Database& database, const StudyRecord& record) {
  const std::int64_t id = record.study + 1;
  Statement free(database,
                 "DELETE FROM studies WHERE id = ? AND status IN ('not_built', "
                 "'skipped')");
  free.bind(0, id);
  free.step();
  std::string names = "INSERT OR IGNORE INTO studies (id, status";
  std::string places = ") VALUES (?, ?";
  list_columns(names, places);
  Statement insert(database, names + places + ")");
  insert.bind(0, id);
  insert.bind(1, std::string(name(record.status)));
  bind_columns(insert, 2, record);
  insert.step();
  if (database.changes() != 1) return false;
  Statement chart(database, "INSERT INTO study_charts VALUES (?, ?, ?)");
  for (const StudyChart& drawn : record.charts) {
    chart.bind(0, id);
    chart.bind(1, drawn.name);
    chart.bind(2, drawn.svg);
    chart.step();
  }
  return true;
}

}  // namespace prehensile::suite
