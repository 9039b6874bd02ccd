#include "apps/benchmark_text.h"

#include <cmath>
#include <cstdlib>

#include "apps/csv.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

using suite::GroupSummary;
using suite::Results;
using suite::RunStatus;
using suite::Summary;
using Json = nlohmann::ordered_json;

std::string number_or_dash(const char* format, double value) {
  if (!std::isfinite(value)) return "-";
  char buffer[40];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(buffer, sizeof buffer, format, value);
#pragma GCC diagnostic pop
  return buffer;
}

/// Neither solved, nor refused with a proof, nor undecided: what should not happen.
int failures(const GroupSummary& group) {
  return group.runs - group.decided() - group.count(RunStatus::kUndecided) -
         group.count(RunStatus::kUnsupported);
}

void add_line(const Results& results, const GroupSummary& group, Table& table) {
  table.add({family_name(results, group.family),
             results.planners[static_cast<std::size_t>(group.planner)].name,
             std::to_string(group.runs), std::to_string(group.solved()),
             std::to_string(group.part_of_margin), std::to_string(group.nominal_only),
             std::to_string(group.count(RunStatus::kInfeasible)),
             std::to_string(group.count(RunStatus::kUndecided)),
             std::to_string(failures(group) + group.count(RunStatus::kUnsupported)),
             number_or_dash("%.2f", 100.0 * group.success()),
             group.feasible_runs > 0
                 ? text("%.2f-%.2f", 100.0 * group.success_interval.low,
                        100.0 * group.success_interval.high)
                 : "-",
             number_or_dash("%.3f", 1e3 * group.time_median),
             number_or_dash("%.1f", 1e3 * group.time_p99),
             number_or_dash("%.3f", group.cost_median),
             number_or_dash("%.1f", 100.0 * group.gap_median)});
}

Json json_of(const Results& results, const GroupSummary& group) {
  Json out = {{"family", family_name(results, group.family)},
              {"planner", results.planners[static_cast<std::size_t>(group.planner)].name},
              {"runs", group.runs}};
  for (std::size_t i = 0; i < suite::kRunStatusNames.size(); ++i) {
    out[std::string(suite::kRunStatusNames[i])] = group.by_status[i];
  }
  out["feasible_runs"] = group.feasible_runs;
  out["success"] = number(group.success());
  out["success_low"] = group.success_interval.low;
  out["success_high"] = group.success_interval.high;
  out["time_median"] = number(group.time_median);
  out["time_p99"] = number(group.time_p99);
  out["time_most"] = number(group.time_most);
  out["cost_median"] = number(group.cost_median);
  out["gap_median"] = number(group.gap_median);
  out["near_bound"] = group.near_bound;
  out["near_bound_at_goal"] = group.near_bound_at_goal;
  out["part_of_margin"] = group.part_of_margin;
  out["nominal_only"] = group.nominal_only;
  out["pushes_median"] = number(group.pushes_median);
  out["memory_most_MB"] = number(group.memory_most);
  return out;
}

std::string problem_text(const Results& results, const suite::ProblemKey& key) {
  return family_name(results, key.family) + '/' + std::to_string(key.problem + 1);
}

}  // namespace

std::string family_name(const Results& results, int family) {
  return family < 0 ? "all" : results.families[static_cast<std::size_t>(family)].name;
}

std::string describe(const Results& results, const Summary& summary) {
  Table table({"family", "planner", "runs", "solved", "part margin", "nominal only",
               "infeasible", "undecided", "other", "success %", "95 %", "ms med",
               "ms p99", "J med", "gap % med"});
  for (const GroupSummary& group : summary.groups) add_line(results, group, table);
  if (results.families.size() > 1) {
    for (const GroupSummary& group : summary.totals) add_line(results, group, table);
  }
  std::string out = table.str();
  for (const suite::ProblemKey& problem : summary.contradictions) {
    out += "contradiction: " + problem_text(results, problem) +
           " can be solved and is proved infeasible\n";
  }
  return out;
}

Json to_json(const Results& results, const Summary& summary) {
  Json out = {{"suite", results.suite},
              {"version", results.provenance.version},
              {"build", results.provenance.build},
              {"machine", results.provenance.machine},
              {"date", results.provenance.date},
              {"rows", results.rows.size()}};
  out["groups"] = Json::array();
  for (const GroupSummary& group : summary.groups) {
    out["groups"].push_back(json_of(results, group));
  }
  out["totals"] = Json::array();
  for (const GroupSummary& group : summary.totals) {
    out["totals"].push_back(json_of(results, group));
  }
  out["contradictions"] = Json::array();
  for (const suite::ProblemKey& problem : summary.contradictions) {
    out["contradictions"].push_back(problem_text(results, problem));
  }
  return out;
}

Json to_json(const Results& header, const suite::ResultRow& row) {
  const auto at = [](const auto& list, int index) {
    return list[static_cast<std::size_t>(index)].name;
  };
  Json out = {{"problem", at(header.families, row.key.family) + '/' +
                              std::to_string(row.key.problem + 1)},
              {"planner", at(header.planners, row.key.planner)},
              {"seed", row.key.seed},
              {"repetition", row.key.repetition},
              {"status", suite::name(row.record.status)},
              {"solved", row.record.solved()}};
  suite::visit_columns(row.record, [&](const char* column, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      out[column] = number(value);
    } else {
      out[column] = value;
    }
  });
  return out;
}

std::string summary_csv(const Results& results, const Summary& summary) {
  std::vector<std::vector<std::string>> lines;
  const auto add = [&](const GroupSummary& group) {
    const Json json = json_of(results, group);
    std::vector<std::string> names, cells;
    for (const auto& [key, value] : json.items()) {
      names.push_back(key);
      if (value.is_string()) {
        cells.push_back(csv_text(value.get<std::string>()));
      } else {
        cells.push_back(value.is_null() ? "" : csv_number(value.get<double>()));
      }
    }
    if (lines.empty()) lines.push_back(names);
    lines.push_back(cells);
  };
  for (const GroupSummary& group : summary.groups) add(group);
  for (const GroupSummary& group : summary.totals) add(group);
  std::string out;
  for (const auto& line : lines) out += csv_line(line);
  return out;
}

std::string runs_csv(const Results& results) {
  std::string out;
  for (const suite::ResultRow& row : results.rows) {
    std::vector<std::string> names = {"family",     "problem", "planner", "seed",
                                      "repetition", "status",  "solved"};
    std::vector<std::string> cells = {
        family_name(results, row.key.family),
        std::to_string(row.key.problem + 1),
        results.planners[static_cast<std::size_t>(row.key.planner)].name,
        std::to_string(row.key.seed),
        std::to_string(row.key.repetition),
        std::string(suite::name(row.record.status)),
        row.record.solved() ? "1" : "0"};
    suite::visit_columns(row.record, [&](const char* name, const auto& value) {
      using T = std::decay_t<decltype(value)>;
      names.emplace_back(name);
      if constexpr (std::is_same_v<T, std::string>) {
        cells.push_back(csv_text(value));
      } else if constexpr (std::is_same_v<T, double>) {
        cells.push_back(csv_number(value));
      } else {
        cells.push_back(std::to_string(value));
      }
    });
    if (out.empty()) out += csv_line(names);
    out += csv_line(cells);
  }
  return out;
}

std::string comparison_csv(const Results& results,
                           const std::vector<suite::Comparison>& comparisons) {
  std::string out =
      csv_line({"family", "a", "b", "pairs", "only_a", "only_b", "success_p", "both",
                "cheaper_a", "cheaper_b", "cost_p", "cost_ratio", "faster_a", "faster_b",
                "time_p", "time_ratio"});
  const auto planner = [&](int index) {
    return results.planners[static_cast<std::size_t>(index)].name;
  };
  for (const suite::Comparison& c : comparisons) {
    out += csv_line(
        {family_name(results, c.family), planner(c.a), planner(c.b),
         std::to_string(c.pairs), std::to_string(c.only_a), std::to_string(c.only_b),
         csv_number(c.success_p), std::to_string(c.both), std::to_string(c.cheaper_a),
         std::to_string(c.cheaper_b), csv_number(c.cost_p), csv_number(c.cost_ratio),
         std::to_string(c.faster_a), std::to_string(c.faster_b), csv_number(c.time_p),
         csv_number(c.time_ratio)});
  }
  return out;
}

Floor parse_floor(const std::string& words, const Results& results) {
  const auto refuse = [&]() -> Floor {
    throw BadInput("--fail-below " + words +
                   ": expected success=SHARE or decided=SHARE, share from 0 to 1, or of "
                   "one planner NAME.success=SHARE");
  };
  const std::size_t equals = words.rfind('=');
  if (equals == std::string::npos) return refuse();
  Floor floor;
  floor.metric = words.substr(0, equals);
  char* end = nullptr;
  const std::string value = words.substr(equals + 1);
  floor.value = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !(floor.value >= 0.0) || floor.value > 1.0) {
    return refuse();
  }
  const std::size_t dot = floor.metric.rfind('.');
  if (dot != std::string::npos) {
    floor.planner = floor.metric.substr(0, dot);
    floor.metric = floor.metric.substr(dot + 1);
    bool is_known = false;
    for (const auto& planner : results.planners)
      is_known |= planner.name == floor.planner;
    if (!is_known) throw BadInput("--fail-below " + words + ": no such planner");
  }
  return floor.metric == "success" || floor.metric == "decided" ? floor : refuse();
}

std::string missed(const Floor& floor, const Results& results, const Summary& summary) {
  std::string out;
  for (const GroupSummary& total : summary.totals) {
    const std::string& planner =
        results.planners[static_cast<std::size_t>(total.planner)].name;
    if (!floor.planner.empty() && planner != floor.planner) continue;
    const double share =
        floor.metric == "success" ? total.success() : total.decided_share();
    if (share >= floor.value) continue;
    out += planner + ": " + floor.metric + ' ' + number_or_dash("%.6g", share) +
           text(" is below %.6g\n", floor.value);
  }
  if (results.rows.empty()) out += "no runs\n";
  return out;
}

}  // namespace prehensile::apps
