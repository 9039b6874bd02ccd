#include "benchmarks/suite/results_schema.h"

#include <ctime>
#include <type_traits>

#include "benchmarks/suite/suite_file.h"
#include "io/scene_file.h"

namespace prehensile::suite {
namespace {

constexpr const char* kFormat = "prehensile benchmark 1";

/// As OMPL's script makes them; `problems` and what stands behind `plannerid` is ours.
constexpr const char* kTables = R"sql(
CREATE TABLE experiments
  (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512),
   totaltime REAL, timelimit REAL, memorylimit REAL, runcount INTEGER,
   version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT,
   date DATETIME, seed VARCHAR(24), setup TEXT, problems INTEGER);
CREATE TABLE plannerConfigs
  (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512) NOT NULL, settings TEXT);
CREATE TABLE enums
  (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
CREATE TABLE suite (key TEXT PRIMARY KEY, value TEXT);
CREATE TABLE progress
  (runid INTEGER, time REAL, best_cost REAL, PRIMARY KEY (runid, time),
   FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
)sql";

constexpr const char* kViews = R"sql(
CREATE VIEW bestPlannerConfigsPerExperiment AS
  SELECT plannerid, experimentid, MIN(avg_solved) AS avg_solved, avg_total_time FROM
    (SELECT plannerid, plannerConfigs.name AS plannerName, experimentid,
       AVG(solved) AS avg_solved, AVG(time) AS avg_total_time
     FROM runs INNER JOIN plannerConfigs ON plannerConfigs.id = runs.plannerid
     GROUP BY plannerid, experimentid)
  GROUP BY plannerName, experimentid ORDER BY avg_solved DESC, avg_total_time ASC;
CREATE VIEW bestPlannerConfigs AS
  SELECT plannerid, MIN(avg_solved) AS avg_solved, avg_total_time FROM
    (SELECT plannerid, plannerConfigs.name AS plannerName,
       AVG(solved) AS avg_solved, AVG(time) AS avg_total_time
     FROM runs INNER JOIN plannerConfigs ON plannerConfigs.id = runs.plannerid
     GROUP BY plannerid)
  GROUP BY plannerName ORDER BY avg_solved DESC, avg_total_time ASC;
)sql";

template <typename T>
const char* type_of() {
  if constexpr (std::is_same_v<T, bool>) return "BOOLEAN";
  if constexpr (std::is_same_v<T, double>) return "REAL";
  if constexpr (std::is_same_v<T, std::string>) return "TEXT";
  return "INTEGER";
}

std::string runs_table() {
  std::string sql =
      "CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, "
      "plannerid INTEGER, problem INTEGER, seed INTEGER, repetition INTEGER, "
      "status ENUM, solved BOOLEAN";
  RunRecord record;
  visit_columns(record, [&](const char* name, const auto& value) {
    sql += std::string(", ") + name + ' ' + type_of<std::decay_t<decltype(value)>>();
  });
  return sql +
         ", FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE"
         ", FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE"
         ", UNIQUE (experimentid, plannerid, problem, seed, repetition))";
}

template <typename Provenance, typename F>
void visit_provenance(Provenance& p, F&& f) {
  f("suite", p.suite_text);
  f("version", p.version);
  f("build", p.build);
  f("machine", p.machine);
  f("command", p.command);
  f("date", p.date);
}

void write_experiments(Database& database, const Results& header) {
  Statement insert(database,
                   "INSERT INTO experiments (name, totaltime, timelimit, memorylimit, "
                   "runcount, version, hostname, cpuinfo, date, seed, setup, problems) "
                   "VALUES (?, 0, ?, ?, ?, ?, ?, ?, ?, '1', ?, ?)");
  for (const Results::FamilyInfo& family : header.families) {
    insert.bind(0, family.name);
    insert.bind(1, header.cpu_limit);
    insert.bind(2, header.memory_limit_MB);
    insert.bind(3, static_cast<std::int64_t>(family.count));
    insert.bind(4, "prehensile " + header.provenance.version);
    insert.bind(5, header.host);
    insert.bind(6, header.provenance.machine);
    insert.bind(7, header.provenance.date);
    insert.bind(8, "family " + family.name + " of suite " + header.suite);
    insert.bind(9, static_cast<std::int64_t>(family.count));
    insert.step();
  }
}

void write_names(Database& database, const Results& header) {
  Statement planner(database,
                    "INSERT INTO plannerConfigs (name, settings) VALUES (?, ?)");
  for (const Results::PlannerInfo& info : header.planners) {
    planner.bind(0, info.name);
    planner.bind(1, info.settings);
    planner.step();
  }
  Statement status(database, "INSERT INTO enums VALUES ('status', ?, ?)");
  for (std::size_t i = 0; i < kRunStatusNames.size(); ++i) {
    status.bind(0, static_cast<std::int64_t>(i));
    status.bind(1, std::string(kRunStatusNames[i]));
    status.step();
  }
}

}  // namespace

void write_header(Database& database, const Results& header) {
  database.begin();
  database.run(kTables);
  database.run(runs_table());
  database.run(kViews);
  write_experiments(database, header);
  write_names(database, header);
  Statement suite(database, "INSERT INTO suite VALUES (?, ?)");
  const auto put = [&suite](const char* key, const std::string& value) {
    suite.bind(0, std::string(key));
    suite.bind(1, value);
    suite.step();
  };
  put("format", kFormat);
  put("name", header.suite);
  put("host", header.host);
  put("quick", header.provenance.quick ? "1" : "0");
  visit_provenance(header.provenance, put);
  database.commit();
}

Results read_header(Database& database, const std::filesystem::path& file) {
  Results header;
  const auto get = [&database](const char* key) {
    Statement select(database, "SELECT value FROM suite WHERE key = ?");
    select.bind(0, std::string(key));
    return select.step() ? select.text(0) : std::string();
  };
  if (get("format") != kFormat) {
    throw BadInput(file.string() + ": expected results of `prehensile benchmark`");
  }
  header.suite = get("name");
  header.host = get("host");
  header.provenance.quick = get("quick") == "1";
  visit_provenance(header.provenance,
                   [&](const char* key, std::string& value) { value = get(key); });
  Statement experiments(
      database,
      "SELECT name, problems, timelimit, memorylimit FROM experiments ORDER BY id");
  while (experiments.step()) {
    header.families.push_back(
        {experiments.text(0), static_cast<int>(experiments.integer(1))});
    // Files are named after them.
    if (const std::string& name = header.families.back().name; !is_word(name)) {
      throw BadInput(file.string() + ": experiments: name: \"" + name +
                     "\": expected one word of letters, digits, _ - and .");
    }
    header.cpu_limit = experiments.real(2);
    header.memory_limit_MB = experiments.real(3);
  }
  Statement planners(database, "SELECT name, settings FROM plannerConfigs ORDER BY id");
  while (planners.step()) header.planners.push_back({planners.text(0), planners.text(1)});
  return header;
}

std::string value_columns() {
  std::string names = "status, solved";
  RunRecord record;
  visit_columns(
      record, [&](const char* name, const auto&) { names += std::string(", ") + name; });
  return names;
}

void bind_row(Statement& statement, const ResultRow& row) {
  int at = 0;
  for (const int value :
       {row.key.family + 1, row.key.planner + 1, row.key.problem + 1, row.key.seed,
        row.key.repetition, static_cast<int>(row.record.status),
        row.record.solved() ? 1 : 0}) {
    statement.bind(at++, static_cast<std::int64_t>(value));
  }
  visit_columns(row.record, [&](const char*, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, double>) {
      statement.bind(at++, value);
    } else {
      statement.bind(at++, static_cast<std::int64_t>(value));
    }
  });
}

ResultRow read_row(const Statement& statement) {
  const auto whole = [&](int column) {
    return static_cast<int>(statement.integer(column));
  };
  ResultRow row;
  row.key = {whole(0) - 1, whole(2) - 1, whole(1) - 1, whole(3), whole(4)};
  int at = kKeyColumnCount;
  row.record.status = static_cast<RunStatus>(whole(at));
  at += 2;
  visit_columns(row.record, [&](const char*, auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      value = statement.text(at);
    } else if constexpr (std::is_same_v<T, double>) {
      value = statement.real(at);
    } else {
      value = static_cast<T>(statement.integer(at));
    }
    ++at;
  });
  return row;
}

}  // namespace prehensile::suite
