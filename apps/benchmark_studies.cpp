#include "apps/benchmark_studies.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/benchmark_text.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "plot/plain_svg.h"

namespace prehensile::apps {
namespace {

using suite::Results;
using suite::StudyRecord;
using suite::StudyStatus;
using Json = nlohmann::ordered_json;

std::string seconds(double value) {
  return std::isfinite(value) ? text("%.1f", value) : "-";
}

/// What a file says, without what a terminal would take for orders.
std::string harmless(const std::string& words) {
  std::string out;
  for (const char c : words) {
    const bool is_shown = static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
    if (is_shown || c == '\n') out += c;
    if (c == '\t') out += ' ';
  }
  return out;
}

int lines_of(const std::string& csv) {
  return static_cast<int>(std::count(csv.begin(), csv.end(), '\n'));
}

/// "done", or how else it ended and why.
std::string ending(const StudyRecord& record) {
  std::string words(suite::name(record.status));
  if (!record.message.empty()) words += ": " + record.message;
  return harmless(words);
}

}  // namespace

std::string describe_studies(const Results& results) {
  if (results.studies.empty()) return {};
  Table table({"study", "status", "CPU s", "s", "MB", "runs", "charts"});
  std::string out;
  for (const StudyRecord& record : results.studies) {
    table.add({record.name, std::string(suite::name(record.status)), seconds(record.time),
               seconds(record.wall_time),
               std::isfinite(record.memory) ? text("%.0f", record.memory) : "-",
               std::to_string(std::max(0, lines_of(record.csv) - 1)),
               std::to_string(record.charts.size())});
    out += "\n== " + record.name + ": " + harmless(record.command) + '\n';
    if (record.status != StudyStatus::kDone) out += "== " + ending(record) + '\n';
    out += harmless(record.printed);
    if (!out.ends_with('\n')) out += '\n';
  }
  return table.str() + out;
}

Json to_json(const StudyRecord& record) {
  Json out = {{"name", record.name}, {"status", suite::name(record.status)}};
  out["command"] = record.command;
  out["exit_code"] = record.exit_code;
  out["signal"] = record.signal;
  out["time"] = number(record.time);
  out["wall_time"] = number(record.wall_time);
  out["memory"] = number(record.memory);
  out["message"] = record.message;
  out["host"] = record.host;
  out["machine"] = record.machine;
  out["date"] = record.date;
  out["runs"] = std::max(0, lines_of(record.csv) - 1);
  out["printed"] = record.printed;
  out["charts"] = Json::array();
  for (const suite::StudyChart& chart : record.charts)
    out["charts"].push_back(chart.name);
  return out;
}

void print_json(const Json& json) {
  const std::string words = json.dump(2, ' ', false, Json::error_handler_t::replace);
  std::printf("%s\n", words.c_str());
}

void print_results(const Results& results, const suite::Summary& summary, bool as_json) {
  if (as_json) {
    Json out = to_json(results, summary);
    out["studies"] = Json::array();
    for (const StudyRecord& record : results.studies) {
      out["studies"].push_back(to_json(record));
    }
    print_json(out);
    return;
  }
  if (!results.families.empty()) std::fputs(describe(results, summary).c_str(), stdout);
  std::fputs(describe_studies(results).c_str(), stdout);
}

void add_studies(const Results& results, ReportPage& page) {
  for (const StudyRecord& record : results.studies) {
    const std::string id = "study-" + record.name;
    page.heading(id, "Study " + record.name);
    std::string how = code(harmless(record.command)) + ' ' + html(ending(record));
    if (record.has_run()) {
      how += ", " + html(seconds(record.time)) + " s of processor time, " +
             html(seconds(record.wall_time)) + " s in all, on " +
             html(harmless(record.machine)) + " at " + html(harmless(record.date));
    }
    page.paragraph(how + (record.csv.empty() ? "." : ". Its runs are beside this page."));
    const std::string printed = harmless(record.printed);
    if (!printed.empty()) page.printed(printed);
    for (const suite::StudyChart& chart : record.charts) {
      const std::string fault = plot::fault_of_chart(chart.svg);
      if (fault.empty()) {
        page.figure(id + '-' + chart.name, chart.svg, html(chart.name));
      } else {
        page.paragraph("<span class=\"differs\">Left out:</span> " + html(chart.name) +
                       ", which has " + html(harmless(fault)));
      }
    }
  }
}

std::string unsound_studies(const Results& results) {
  std::string out;
  for (const StudyRecord& record : results.studies) {
    if (!record.is_sound()) out += "study " + record.name + ": " + ending(record) + '\n';
  }
  return out;
}

}  // namespace prehensile::apps
