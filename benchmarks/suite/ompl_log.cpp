#include "benchmarks/suite/ompl_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <type_traits>

namespace prehensile::suite {
namespace {

std::string shown(double value) {
  if (!std::isfinite(value)) return "nan";
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.12g", value);
  return buffer;
}

/// Names that are one word in a log.
std::string one_word(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; }, '_');
  return text.empty() ? "unknown" : text;
}

std::string columns(int& count) {
  std::string out =
      "problem INTEGER\nseed INTEGER\nrepetition INTEGER\nstatus ENUM\nsolved BOOLEAN\n";
  count = 5;
  RunRecord record;
  visit_columns(record, [&](const char* name, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (!std::is_same_v<T, std::string>) {
      const char* type = std::is_same_v<T, bool>     ? "BOOLEAN"
                         : std::is_same_v<T, double> ? "REAL"
                                                     : "INTEGER";
      out += std::string(name) + ' ' + type + '\n';
      ++count;
    }
  });
  return out;
}

std::string line_of(const ResultRow& row) {
  std::string out;
  const auto add = [&out](const std::string& value) { out += value + "; "; };
  add(std::to_string(row.key.problem + 1));
  add(std::to_string(row.key.seed));
  add(std::to_string(row.key.repetition));
  add(std::to_string(static_cast<int>(row.record.status)));
  add(row.record.solved() ? "1" : "0");
  visit_columns(row.record, [&](const char*, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, double>) {
      add(shown(value));
    } else if constexpr (!std::is_same_v<T, std::string>) {
      add(std::to_string(value));
    }
  });
  return out + '\n';
}

std::string progress_of(const ResultRow& row) {
  std::string out;
  for (const ProgressPoint& point : row.record.progress) {
    out += shown(point.time) + ',' + shown(point.best_cost) + ",;";
  }
  return out + '\n';
}

/// "a = 1; b = 2" as lines.
std::string common_properties(const std::string& settings) {
  std::string lines;
  int count = 1;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (settings.compare(i, 2, "; ") == 0) {
      lines += '\n';
      ++count;
      ++i;
    } else {
      lines += settings[i];
    }
  }
  return std::to_string(count) + " common properties\n" + lines + '\n';
}

std::string planner_block(const Results& results, int family, int planner) {
  const auto& info = results.planners[static_cast<std::size_t>(planner)];
  int count = 0;
  const std::string names = columns(count);
  std::string lines, progress;
  int runs = 0;
  for (const ResultRow& row : results.rows) {
    if (row.key.family != family || row.key.planner != planner) continue;
    lines += line_of(row);
    progress += progress_of(row);
    ++runs;
  }
  return info.name + '\n' + common_properties(info.settings) + std::to_string(count) +
         " properties for each run\n" + names + std::to_string(runs) + " runs\n" + lines +
         "2 progress properties for each run\ntime REAL\nbest_cost REAL\n" +
         std::to_string(runs) + " runs\n" + progress + ".\n";
}

}  // namespace

std::string ompl_log(const Results& results, int family) {
  const Provenance& from = results.provenance;
  const auto& info = results.families[static_cast<std::size_t>(family)];
  std::string out = "prehensile version " + one_word(from.version) + '\n';
  out += "Experiment " + one_word(info.name) + '\n';
  out +=
      "1 experiment properties\nproblems INTEGER = " + std::to_string(info.count) + '\n';
  out += "Running on " + one_word(results.host) + "\nStarting at " + from.date + '\n';
  out += "<<<|\nfamily " + info.name + " of suite " + results.suite + "\n|>>>\n";
  out += "<<<|\n" + from.machine + "; " + from.build + "\n|>>>\n";
  out += "1 is the random seed\n" + shown(results.cpu_limit) + " seconds per run\n";
  out += shown(results.memory_limit_MB) + " MB per run\n";
  out += std::to_string(info.count) + " runs per planner\n";
  double spent = 0.0;
  for (const ResultRow& row : results.rows) {
    if (row.key.family == family && std::isfinite(row.record.time)) {
      spent += row.record.time;
    }
  }
  out += shown(spent) + " seconds spent to collect the data\n1 enum type\nstatus";
  for (const std::string_view name : kRunStatusNames) out += '|' + std::string(name);
  out += '\n' + std::to_string(results.planners.size()) + " planners\n";
  for (std::size_t i = 0; i < results.planners.size(); ++i) {
    out += planner_block(results, family, static_cast<int>(i));
  }
  return out;
}

}  // namespace prehensile::suite
