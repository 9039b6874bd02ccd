#include "apps/benchmark_page.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/benchmark_studies.h"
#include "apps/benchmark_text.h"
#include "apps/table.h"
#include "benchmarks/suite/statistics.h"

namespace prehensile::apps {
namespace {

using suite::Comparison;
using suite::GroupSummary;
using suite::Results;
using suite::RunStatus;
using suite::Summary;

constexpr double kNoise = 0.01;      // p among all tests of a page
constexpr double kTimeNoise = 1.10;  // a machine is not the same twice

std::string planner_name(const Results& results, int planner) {
  return results.planners[static_cast<std::size_t>(planner)].name;
}

/// A number of the page, or a dash where there is none.
std::string cell(ReportPage& page, const std::string& id, double value,
                 const char* format) {
  return std::isfinite(value) ? page.number(id, value, format) : "–";
}

std::vector<std::string> success_line(const Results& results, const GroupSummary& group,
                                      ReportPage& page) {
  const std::string family = family_name(results, group.family);
  const std::string planner = planner_name(results, group.planner);
  const std::string id = "run." + family + '.' + planner;
  const auto count = [&](RunStatus status) {
    return cell(page, id + '.' + std::string(suite::name(status)), group.count(status),
                "%.0f");
  };
  std::string interval = "–";
  if (group.feasible_runs > 0) {
    interval = page.number(id + ".low", 100.0 * group.success_interval.low, "%.2f") +
               " to " +
               page.number(id + ".high", 100.0 * group.success_interval.high, "%.2f");
  }
  return {html(family),
          html(planner),
          cell(page, id + ".runs", group.runs, "%.0f"),
          count(RunStatus::kSolved),
          cell(page, id + ".part", group.part_of_margin, "%.0f"),
          cell(page, id + ".nominal", group.nominal_only, "%.0f"),
          count(RunStatus::kInfeasible),
          count(RunStatus::kUndecided),
          cell(page, id + ".success", 100.0 * group.success(), "%.2f"),
          interval,
          cell(page, id + ".time", 1e3 * group.time_median, "%.3g"),
          cell(page, id + ".time99", 1e3 * group.time_p99, "%.3g"),
          cell(page, id + ".pushes", group.pushes_median, "%.0f"),
          cell(page, id + ".cost", group.cost_median, "%.3f"),
          cell(page, id + ".gap", 100.0 * group.gap_median, "%.1f")};
}

void add_success(const Results& results, const Summary& summary, ReportPage& page) {
  page.heading("success", "Success");
  page.paragraph(
      "Solved: a plan whose replay with the exact mechanics at half the step agrees. "
      "Part of the margin, nominal only: those of the solved whose plans survive a part "
      "of the margin asked for, or hold for the values of the scene alone. "
      "Infeasible: refused with a proof that separate code accepts. Success is the share "
      "solved of the problems that nobody has proved infeasible, with Wilson's interval "
      "at "
      "95 %. Time is processor time of planning; the gap is that to the plan's own "
      "lower bound, over solved runs.");
  std::vector<std::vector<std::string>> rows = {
      {"family", "planner", "runs", "solved", "part of the margin", "nominal only",
       "infeasible", "undecided", "success %", "95 %", "median ms", "99 % ms", "pushes",
       "J", "gap %"}};
  for (const GroupSummary& group : summary.groups) {
    rows.push_back(success_line(results, group, page));
  }
  if (results.families.size() > 1) {
    for (const GroupSummary& group : summary.totals) {
      rows.push_back(success_line(results, group, page));
    }
  }
  page.table(rows, "objects");
  for (const suite::ProblemKey& key : summary.contradictions) {
    page.paragraph("<span class=\"differs\">Contradiction:</span> problem " +
                   html(family_name(results, key.family)) + '/' +
                   std::to_string(key.problem + 1) +
                   " can be solved and is proved infeasible.");
  }
  page.figure("success-chart", success_chart(results, summary).svg(),
              "Success of each family and planner.");
}

void add_curves(const Results& results, const Summary& summary, ReportPage& page) {
  page.heading("time", "Time");
  page.figure("time-chart", time_chart(results, summary).svg(),
              "Share solved within a processor time, all families.");
  if (results.planners.size() > 1) {
    page.figure("profile-chart", profile_chart(results).svg(),
                "How often a planner is how much slower than the fastest.");
  }
  page.heading("cost", "Cost");
  page.figure("cost-chart", cost_chart(results).svg(),
              "Planners tell their best cost at most every tenth of a second, and at the "
              "end; what is faster shows its end only.");
  page.figure("gap-chart", gap_chart(results).svg(),
              "The bound is the one that the plan carries at the end.");
}

/// Messages that differ only in their ends are one reason.
std::string shortened(const std::string& message) {
  constexpr std::size_t kMost = 160;
  if (message.size() <= kMost) return message;
  return message.substr(0, std::min(kMost, message.rfind(' ', kMost))) + " ...";
}

void add_failures(const Results& results, ReportPage& page) {
  page.heading("failures", "What was not solved");
  std::map<std::tuple<int, int, RunStatus, std::string>, std::pair<int, int>> reasons;
  for (const suite::ResultRow& row : results.rows) {
    if (row.record.solved()) continue;
    auto& [count, example] = reasons[{row.key.family, row.key.planner, row.record.status,
                                      shortened(row.record.message)}];
    if (count++ == 0) example = row.key.problem + 1;
  }
  if (reasons.empty()) {
    page.paragraph("Nothing: every run is solved.");
    return;
  }
  std::vector<std::vector<std::string>> rows = {
      {"family", "planner", "status", "runs", "first problem", "message"}};
  constexpr std::size_t kMost = 300;
  for (const auto& [key, value] : reasons) {
    if (rows.size() > kMost) break;
    const auto& [family, planner, status, message] = key;
    rows.push_back({html(family_name(results, family)),
                    html(planner_name(results, planner)),
                    std::string(suite::name(status)), std::to_string(value.first),
                    std::to_string(value.second), html(message)});
  }
  page.table(rows);
  if (reasons.size() > kMost) {
    page.paragraph("The first " + std::to_string(kMost) + " of " +
                   std::to_string(reasons.size()) + " reasons.");
  }
}

std::string p_value(double p) { return p < 1e-4 ? text("%.1e", p) : text("%.4f", p); }

void add_pairs(const Results& results, const std::vector<Comparison>& comparisons,
               const std::string& first, const std::string& second, ReportPage& page) {
  std::vector<std::vector<std::string>> rows = {
      {"family", first, second, "pairs", "only first", "only second", "p",
       "cheaper first", "cheaper second", "p", "cost ratio", "faster first",
       "faster second", "p", "time ratio"}};
  for (const Comparison& c : comparisons) {
    if (c.pairs == 0) continue;
    const auto ratio = [](double value) {
      return std::isfinite(value) ? text("%.3g", value) : std::string("–");
    };
    rows.push_back({html(family_name(results, c.family)),
                    html(planner_name(results, c.a)), html(planner_name(results, c.b)),
                    std::to_string(c.pairs), std::to_string(c.only_a),
                    std::to_string(c.only_b), p_value(c.success_p),
                    std::to_string(c.cheaper_a), std::to_string(c.cheaper_b),
                    p_value(c.cost_p), ratio(c.cost_ratio), std::to_string(c.faster_a),
                    std::to_string(c.faster_b), p_value(c.time_p), ratio(c.time_ratio)});
  }
  page.table(rows, "objects");
}

void add_origin(const Results& results, ReportPage& page) {
  page.heading("origin", "Where this comes from");
  std::vector<std::vector<std::string>> rows = {{"what", "value"}};
  const auto add = [&rows](const char* what, const std::string& value) {
    rows.push_back({what, html(value)});
  };
  add("command", results.provenance.command);
  add("machine", results.provenance.machine);
  add("host", results.host);
  add("build", results.provenance.build);
  add("version", results.provenance.version);
  add("begun (UTC)", results.provenance.date);
  if (!results.families.empty()) {  // of a suite of studies alone the file below says it
    add("limits of a run", text("%.6g s of processor time, %.6g MB", results.cpu_limit,
                                results.memory_limit_MB));
  }
  add("problems", results.provenance.quick ? "--quick: the first few of each family"
                                           : "all of the suite");
  for (const auto& planner : results.planners) {
    rows.push_back({"planner " + html(planner.name), html(planner.settings)});
  }
  page.table(rows);
  page.paragraph("The suite file:");
  page.paragraph("<code style=\"white-space: pre-wrap\">" +
                 html(results.provenance.suite_text) + "</code>");
}

const char* name(Measure measure) {
  switch (measure) {
    case Measure::kSuccess:
      return "success";
    case Measure::kCost:
      return "cost";
    case Measure::kTime:
      return "time";
  }
  return "unknown";
}

/// What the numbers of one test say.
void judge(const std::string& where, Measure measure, double p, int tests, int better,
           int worse, bool is_large, const std::string& how_much,
           std::vector<Finding>& out) {
  if (!is_large || suite::for_many(p, tests) >= kNoise) return;
  const bool is_better = better > worse;
  out.push_back({measure, is_better ? Change::kBetter : Change::kWorse,
                 where + ": " + name(measure) + (is_better ? " better" : " worse") +
                     " (" + how_much +
                     text("; %d pairs for, %d against, p = %.1e among %d "
                          "tests)",
                          std::max(better, worse), std::min(better, worse),
                          suite::for_many(p, tests), tests)});
}

}  // namespace

std::string benchmark_page(const Results& results, const Summary& summary) {
  ReportPage page;
  if (!results.families.empty()) {
    add_success(results, summary, page);
    add_curves(results, summary, page);
    add_failures(results, page);
  }
  if (results.planners.size() > 1) {
    page.heading("pairs", "Planner against planner");
    page.paragraph(
        "On the same problems, one run each (the first seed). p is that of the two-sided "
        "exact sign test, for success McNemar's exact test, not corrected for the number "
        "of tests. Ratios are medians of second over first, where both solve.");
    add_pairs(results, suite::compare_planners(results), "first", "second", page);
  }
  add_studies(results, page);
  add_origin(results, page);
  const std::string studies =
      results.studies.empty()
          ? ""
          : " and " + std::to_string(results.studies.size()) + " studies";
  const std::string lead = "<p>" + std::to_string(results.rows.size()) + " runs" +
                           studies + " of suite " + code(results.suite) +
                           " by prehensile " + html(results.provenance.version) +
                           ". Tables as CSV lie beside this page.</p>\n";
  return page.str("Benchmark " + results.suite, lead);
}

std::vector<Finding> findings(const Results& before,
                              const std::vector<Comparison>& comparisons) {
  const int tests = 3 * static_cast<int>(comparisons.size());
  std::vector<Finding> out;
  for (const Comparison& c : comparisons) {
    const std::string where =
        family_name(before, c.family) + ", " + planner_name(before, c.a);
    judge(where, Measure::kSuccess, c.success_p, tests, c.only_b, c.only_a, true,
          text("of %d pairs", c.pairs), out);
    judge(where, Measure::kCost, c.cost_p, tests, c.cheaper_b, c.cheaper_a, true,
          text("median ratio %.4g", c.cost_ratio), out);
    const double factor = std::max(c.time_ratio, 1.0 / c.time_ratio);
    judge(where, Measure::kTime, c.time_p, tests, c.faster_b, c.faster_a,
          factor > kTimeNoise, text("median ratio %.3g", c.time_ratio), out);
  }
  return out;
}

std::string comparison_page(const Results& before, const Results& after,
                            const std::vector<Comparison>& comparisons) {
  ReportPage page;
  page.heading("findings", "What changed beyond noise");
  const std::vector<Finding> found = findings(before, comparisons);
  if (found.empty()) page.paragraph("Nothing.");
  for (const Finding& finding : found) {
    page.paragraph(std::string("<span class=\"") +
                   (finding.change == Change::kBetter ? "confirmed" : "differs") + "\">" +
                   html(finding.words) + "</span>");
  }
  page.heading("pairs", "Run by run");
  page.paragraph(
      "The same problems, planners and seeds in both files. p is that of the two-sided "
      "exact sign test, not corrected. Ratios are medians of after over before.");
  add_pairs(before, comparisons, "before", "after", page);
  const auto origin = [](const Results& results) {
    return html(results.provenance.version + ", " + results.provenance.build + ", " +
                results.provenance.machine + ", " + results.provenance.date);
  };
  page.heading("origin", "Where this comes from");
  page.table({{"file", "version, build, machine, begun"},
              {"before", origin(before)},
              {"after", origin(after)}});
  if (!before.studies.empty() || !after.studies.empty()) {
    page.paragraph("Studies are not compared.");
  }
  return page.str("Benchmark " + before.suite + ": before and after",
                  "<p>" + std::to_string(before.rows.size()) + " and " +
                      std::to_string(after.rows.size()) + " runs.</p>\n");
}

}  // namespace prehensile::apps
