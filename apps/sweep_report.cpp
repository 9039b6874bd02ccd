#include "apps/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/csv.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

constexpr int kMostLines = 40;   // of a table on the screen
constexpr int kMostColumns = 8;  // of a table over two fields
constexpr int kMostCurves = 6;   // of a chart over two fields; more: a map

const char* name_of(SweepOf of) {
  return of == SweepOf::kInstant ? "instant" : of == SweepOf::kPush ? "push" : "roll";
}

/// `count` indices out of `size`, spread from the first to the last.
std::vector<int> spread_indices(int size, int count) {
  std::vector<int> out;
  out.reserve(static_cast<std::size_t>(std::min(size, count)));
  for (int k = 0; k < std::min(size, count); ++k) {
    out.push_back(size <= count
                      ? k
                      : static_cast<int>(std::lround(k * (size - 1.0) / (count - 1.0))));
  }
  return out;
}

/// The value stands for the one answer that there is.
bool is_unique(const Sweep& sweep, const SweepRow& row, int column) {
  return row.answered || sweep_columns(sweep.question.of)[column].is_of_question;
}

std::string cell(const Sweep& sweep, const SweepRow& row, int column) {
  const double value = row.values[column];
  if (is_unique(sweep, row, column) && std::isfinite(value)) return text("%.5g", value);
  return std::isfinite(value) ? text("(%.5g)", value) : "-";
}

std::string tally(const Sweep& sweep) {
  std::map<std::string, int> counts;
  std::map<std::string, std::string> reasons;
  int bracketed = 0;
  for (const SweepRow& row : sweep.rows) {
    ++counts[row.status];
    reasons.emplace(row.status, row.reason);
    bracketed += !row.answered && std::isfinite(row.values.front());
  }
  std::string out = text("%zu rows:", sweep.rows.size());
  for (const auto& [status, count] : counts) {
    out += text(" %d ", count) + status + ',';
  }
  out.back() = '\n';
  for (const auto& [status, reason] : reasons) {
    if (!reason.empty()) out += "  " + status + ": " + reason + '\n';
  }
  if (bracketed > 0) {
    out +=
        "in brackets: stopped, or not a unique answer to the whole question; see the "
        "status\n";
  }
  return out;
}

std::string table_over_one(const Sweep& sweep, const std::vector<int>& shown) {
  const auto& columns = sweep_columns(sweep.question.of);
  std::vector<std::string> header = {sweep.fields[0].path};
  for (const int column : shown) header.emplace_back(columns[column].label);
  header.emplace_back("status");
  Table table(header);
  for (const int i : spread_indices(sweep.columns(), kMostLines)) {
    const SweepRow& row = sweep.row(i, 0);
    std::vector<std::string> cells = {sweep.fields[0].values[i]};
    for (const int column : shown) cells.push_back(cell(sweep, row, column));
    cells.push_back(row.status);
    table.add(std::move(cells));
  }
  return table.str();
}

std::string table_over_two(const Sweep& sweep, int column) {
  const std::vector<int> across = spread_indices(sweep.lines(), kMostColumns);
  std::vector<std::string> header = {sweep.fields[0].path};
  for (const int j : across) header.push_back(sweep.fields[1].values[j]);
  Table table(header);
  for (const int i : spread_indices(sweep.columns(), kMostLines)) {
    std::vector<std::string> cells = {sweep.fields[0].values[i]};
    for (const int j : across) cells.push_back(cell(sweep, sweep.row(i, j), column));
    table.add(std::move(cells));
  }
  return text("%s, against %s down and %s across\n",
              sweep_columns(sweep.question.of)[column].label,
              sweep.fields[0].path.c_str(), sweep.fields[1].path.c_str()) +
         table.str();
}

/// One curve; where a push stopped, or an answer is one of several, its value goes to
/// `others`.
plot::Line curve(const Sweep& sweep, int line, int column, plot::Scatter& others) {
  plot::Line out;
  for (int i = 0; i < sweep.columns(); ++i) {
    const SweepRow& row = sweep.row(i, line);
    const plot::Point point{sweep.fields[0].numbers[i], row.values[column]};
    const bool unique = is_unique(sweep, row, column);
    out.points.push_back(unique ? point : plot::Point{point.x, kNan});
    if (!unique && std::isfinite(point.y)) others.points.push_back(point);
  }
  out.marks = sweep.columns() <= 40;
  return out;
}

/// Unit of a field, by the last word of its path; empty: none.
std::string unit_of(const std::string& path) {
  static const std::map<std::string, std::string> kUnits = {
      {"grip_force", "N"}, {"mass", "kg"},      {"inertia", "kg m²"},
      {"radius", "m"},     {"length", "m"},     {"thickness", "m"},
      {"size", "m"},       {"position", "m"},   {"x", "m"},
      {"y", "m"},          {"gravity", "m/s²"}, {"centre_of_mass", "m"},
      {"theta", "rad"},    {"roll", "rad"},     {"normal", "rad"}};
  std::string word = path.substr(path.rfind('.') + 1);
  if (word.find_first_not_of("0123456789") == std::string::npos) {
    const std::string above = path.substr(0, path.size() - word.size() - 1);
    word = above.substr(above.rfind('.') + 1);
  }
  for (const auto& [end, unit] : {std::pair{"_mm_s", "mm/s"},
                                  {"_deg_s", "deg/s"},
                                  {"_mm", "mm"},
                                  {"_deg", "deg"}}) {
    if (word.ends_with(end)) return unit;
  }
  const auto found = kUnits.find(word);
  return found == kUnits.end() ? "" : found->second;
}

plot::AxisOptions axis_of(const SweptField& field) {
  std::string label = field.path;
  if (const std::string unit = unit_of(label); !unit.empty()) {
    for (const char* end : {"_mm_s", "_deg_s", "_mm", "_deg"}) {
      if (label.ends_with(end)) label.resize(label.size() - std::string_view(end).size());
    }
    label += " [";
    label += unit + ']';
  }
  if (!field.is_numeric) {
    label += ':';
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      label += text(" %zu ", i) + field.values[i];
    }
  }
  return {.label = label,
          .scale = field.is_log ? plot::Scale::kLog : plot::Scale::kLinear};
}

plot::Chart curves_of(const Sweep& sweep, const std::vector<int>& shown) {
  const auto& columns = sweep_columns(sweep.question.of);
  plot::Chart chart;
  chart.x = axis_of(sweep.fields[0]);
  chart.y.label = columns[shown.front()].label;
  plot::Scatter any_others{.label = "stopped or not unique",
                           .colour = plot::Colour::kGrey,
                           .mark = plot::Mark::kCross};
  bool has_others = false;
  for (const int column : shown) {
    for (int j = 0; j < sweep.lines(); ++j) {
      plot::Scatter others{.colour = plot::Colour::kSame, .mark = plot::Mark::kCross};
      plot::Line line = curve(sweep, j, column, others);
      if (sweep.fields.size() > 1) {
        line.label = sweep.fields[1].path + ' ' + sweep.fields[1].values[j];
      }
      if (shown.size() > 1) {
        line.label += line.label.empty() ? "" : ", ";
        line.label += columns[column].label;
      }
      has_others = has_others || !others.points.empty();
      chart.series.emplace_back(std::move(line));
      chart.series.emplace_back(std::move(others));
    }
  }
  if (has_others) chart.series.emplace_back(std::move(any_others));
  return chart;
}

plot::Chart map_of(const Sweep& sweep, int column) {
  plot::Chart chart;
  chart.x = axis_of(sweep.fields[0]);
  chart.y = axis_of(sweep.fields[1]);
  plot::HeatMap map{.label = sweep_columns(sweep.question.of)[column].label,
                    .blank = "stopped or no unique answer"};
  // A map ascends along both axes, whatever the order of the sweep.
  const auto ascending = [](const std::vector<double>& numbers) {
    std::map<double, int> order;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      order.emplace(numbers[i], static_cast<int>(i));
    }
    return order;
  };
  const std::map<double, int> along = ascending(sweep.fields[0].numbers);
  for (const auto& [x, i] : along) map.x.push_back(x);
  for (const auto& [y, j] : ascending(sweep.fields[1].numbers)) {
    map.y.push_back(y);
    for (const auto& [x, i] : along) {
      const SweepRow& row = sweep.row(i, j);
      map.values.push_back(is_unique(sweep, row, column) ? row.values[column] : kNan);
    }
  }
  chart.map = std::move(map);
  return chart;
}

}  // namespace

std::string describe(const Sweep& sweep, const std::vector<int>& shown) {
  if (sweep.fields.size() == 1) return table_over_one(sweep, shown) + tally(sweep);
  std::string out;
  for (const int column : shown) out += table_over_two(sweep, column);
  return out + tally(sweep);
}

nlohmann::ordered_json to_json(const Sweep& sweep) {
  const auto& columns = sweep_columns(sweep.question.of);
  nlohmann::ordered_json out = {{"of", name_of(sweep.question.of)},
                                {"over", nlohmann::ordered_json::array()},
                                {"rows", nlohmann::ordered_json::array()}};
  const auto value_of = [](const SweptField& field, int i) {
    return field.is_numeric ? number(field.numbers[i])
                            : nlohmann::ordered_json(field.values[i]);
  };
  for (const SweptField& field : sweep.fields) {
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (int i = 0; i < static_cast<int>(field.values.size()); ++i) {
      values.push_back(value_of(field, i));
    }
    out["over"].push_back({{"path", field.path}, {"values", std::move(values)}});
  }
  for (int j = 0; j < sweep.lines(); ++j) {
    for (int i = 0; i < sweep.columns(); ++i) {
      const SweepRow& row = sweep.row(i, j);
      nlohmann::ordered_json at = nlohmann::ordered_json::array();
      at.push_back(value_of(sweep.fields[0], i));
      if (sweep.fields.size() > 1) at.push_back(value_of(sweep.fields[1], j));
      nlohmann::ordered_json entry = {{"at", std::move(at)},
                                      {"answered", row.answered},
                                      {"status", row.status},
                                      {"reason", row.reason}};
      for (std::size_t k = 0; k < columns.size(); ++k) {
        entry[columns[k].key] = number(row.values[k]);
      }
      out["rows"].push_back(std::move(entry));
    }
  }
  return out;
}

std::string to_csv(const Sweep& sweep) {
  std::vector<std::string> header;
  header.reserve(sweep.fields.size());
  for (const SweptField& field : sweep.fields) header.push_back(csv_text(field.path));
  for (const char* key : {"answered", "status", "reason"}) header.emplace_back(key);
  for (const SweepColumn& column : sweep_columns(sweep.question.of)) {
    header.emplace_back(column.key);
  }
  std::string out = csv_line(header);
  for (int j = 0; j < sweep.lines(); ++j) {
    for (int i = 0; i < sweep.columns(); ++i) {
      const SweepRow& row = sweep.row(i, j);
      std::vector<std::string> cells = {csv_text(sweep.fields[0].values[i])};
      if (sweep.fields.size() > 1) cells.push_back(csv_text(sweep.fields[1].values[j]));
      cells.emplace_back(row.answered ? "1" : "0");
      cells.push_back(csv_text(row.status));
      cells.push_back(csv_text(row.reason));
      for (const double value : row.values) cells.push_back(csv_number(value));
      out += csv_line(cells);
    }
  }
  return out;
}

std::string to_svg(const Sweep& sweep, const std::vector<int>& shown,
                   const std::string& title) {
  const bool map = sweep.fields.size() > 1 && sweep.lines() > kMostCurves &&
                   sweep.fields[1].is_numeric && sweep.fields[0].is_numeric;
  plot::Chart chart = map ? map_of(sweep, shown.front()) : curves_of(sweep, shown);
  chart.title = title;
  const auto unanswered =
      std::count_if(sweep.rows.begin(), sweep.rows.end(),
                    [](const SweepRow& row) { return !row.answered; });
  chart.subtitle =
      text("%zu rows of query %s", sweep.rows.size(), name_of(sweep.question.of));
  if (unanswered > 0) {
    chart.subtitle +=
        text(", %d stopped or without a unique answer", static_cast<int>(unanswered));
  }
  return chart.svg();
}

}  // namespace prehensile::apps
