#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "apps/benchmark_page.h"
#include "apps/benchmark_text.h"
#include "benchmarks/suite/statistics.h"
#include "planner/checks/share_interval.h"

namespace prehensile::apps {
namespace {

using suite::ResultRow;
using suite::Results;

constexpr std::array<plot::Colour, 8> kColours = {
    plot::Colour::kBlue,   plot::Colour::kOrange, plot::Colour::kGreen,
    plot::Colour::kPurple, plot::Colour::kSky,    plot::Colour::kRed,
    plot::Colour::kYellow, plot::Colour::kBlack};

plot::Colour colour_of(int planner) {
  return kColours[static_cast<std::size_t>(planner) % kColours.size()];
}

std::vector<const ResultRow*> rows_of(const Results& results, int planner) {
  std::vector<const ResultRow*> rows;
  for (const ResultRow& row : results.rows) {
    if (row.key.planner == planner) rows.push_back(&row);
  }
  return rows;
}

using ProblemKey = std::pair<int, int>;
ProblemKey problem_of(const ResultRow& row) { return {row.key.family, row.key.problem}; }

/// Times at which curves over time are drawn: even on a logarithmic axis.
std::vector<double> grid_of_times(const Results& results) {
  double least = INFINITY;
  double most = 0.0;
  for (const ResultRow& row : results.rows) {
    for (const auto& point : row.record.progress) {
      if (!(point.time > 0.0) || !std::isfinite(point.best_cost)) continue;
      least = std::min(least, point.time);
      most = std::max(most, point.time);
    }
  }
  std::vector<double> times;
  if (!(least < most)) return times;
  constexpr int kPoints = 120;
  times.reserve(kPoints + 1);
  for (int i = 0; i <= kPoints; ++i) {
    times.push_back(least * std::pow(most / least, static_cast<double>(i) / kPoints));
  }
  return times;
}

/// The best cost that a run knew at a time; NaN: none.
double cost_at(const ResultRow& row, double time) {
  double cost = suite::kNothing;
  for (const auto& point : row.record.progress) {
    if (point.time > time) break;
    cost = std::fmin(cost, point.best_cost);
  }
  return cost;
}

/// Median and quartiles over time of what `value` makes of a run and its cost.
template <typename Value>
void add_over_time(const Results& results, const Value& value, plot::Chart& chart) {
  const std::vector<double> times = grid_of_times(results);
  for (int planner = 0; planner < static_cast<int>(results.planners.size()); ++planner) {
    plot::Line line{.label = results.planners[static_cast<std::size_t>(planner)].name,
                    .points = {},
                    .colour = colour_of(planner)};
    plot::Band band{.label = "", .rows = {}, .colour = line.colour};
    for (const double time : times) {
      std::vector<double> values;
      for (const ResultRow* row : rows_of(results, planner)) {
        if (!row->record.solved()) continue;
        const double cost = cost_at(*row, time);
        if (std::isfinite(cost)) values.push_back(value(*row, cost));
      }
      if (values.empty()) continue;
      line.points.push_back({time, suite::quantile(values, 0.5)});
      band.rows.push_back(
          {time, suite::quantile(values, 0.25), suite::quantile(values, 0.75)});
    }
    chart.series.emplace_back(std::move(band));
    chart.series.emplace_back(std::move(line));
  }
}

std::map<ProblemKey, double> best_of(const Results& results,
                                     double suite::RunRecord::*value) {
  std::map<ProblemKey, double> best;
  for (const ResultRow& row : results.rows) {
    if (!row.record.solved() || !std::isfinite(row.record.*value)) continue;
    const auto [place, is_new] = best.try_emplace(problem_of(row), row.record.*value);
    if (!is_new) place->second = std::min(place->second, row.record.*value);
  }
  return best;
}

}  // namespace

plot::Chart success_chart(const Results& results, const suite::Summary& summary) {
  const int families = static_cast<int>(results.families.size());
  const int planners = static_cast<int>(results.planners.size());
  plot::Chart chart;
  chart.title = "Success with 95 % intervals";
  chart.x.label = "solved, of problems not proved infeasible [%]";
  for (int family = families - 1; family >= 0; --family) {  // the first at the top
    chart.y.names.push_back(results.families[static_cast<std::size_t>(family)].name);
  }
  chart.y.low = -0.6;
  chart.y.high = families - 0.4;
  chart.height = std::clamp(120.0 + 22.0 * families, 220.0, 1500.0);
  double least = 100.0;
  for (int planner = 0; planner < planners; ++planner) {
    plot::Scatter marks{.label = results.planners[static_cast<std::size_t>(planner)].name,
                        .points = {},
                        .colour = colour_of(planner)};
    for (const suite::GroupSummary& group : summary.groups) {
      if (group.planner != planner || group.feasible_runs == 0) continue;
      const double y =
          families - 1 - group.family + 0.5 * (planner + 0.5) / planners - 0.25;
      const double low = 100.0 * group.success_interval.low;
      marks.points.push_back({100.0 * group.success(), y});
      least = std::min(least, low);
      chart.series.emplace_back(
          plot::Line{.label = "",
                     .points = {{low, y}, {100.0 * group.success_interval.high, y}},
                     .colour = colour_of(planner)});
    }
    chart.series.emplace_back(std::move(marks));
  }
  const double low = std::max(0.0, 10.0 * std::floor(least / 10.0 - 1.0));
  chart.x.low = low;
  chart.x.high = 100.0 + 0.02 * (100.0 - low);
  return chart;
}

plot::Chart time_chart(const Results& results, const suite::Summary& summary) {
  plot::Chart chart;
  chart.title = "Solved within a time";
  chart.subtitle = "share of problems not proved infeasible, with pointwise 95 % bands";
  chart.x = {.label = "processor time of planning [s]", .scale = plot::Scale::kLog};
  chart.y = {.label = "solved [%]", .low = 0.0, .high = 100.0};
  for (const suite::GroupSummary& total : summary.totals) {
    std::vector<double> times;
    for (const ResultRow* row : rows_of(results, total.planner)) {
      if (row->record.solved() && row->record.time > 0.0) {
        times.push_back(row->record.time);
      }
    }
    std::sort(times.begin(), times.end());
    plot::Steps steps{
        .label = results.planners[static_cast<std::size_t>(total.planner)].name,
        .points = {},
        .colour = colour_of(total.planner)};
    plot::Band band{.label = "", .rows = {}, .colour = steps.colour};
    // A thousand points show all that a screen can.
    const std::size_t stride = std::max<std::size_t>(1, times.size() / 1000);
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (i % stride != 0 && i + 1 != times.size()) continue;
      const int solved = static_cast<int>(i) + 1;
      const ShareInterval interval = wilson(solved, total.feasible_runs);
      steps.points.push_back({times[i], 100.0 * solved / total.feasible_runs});
      band.rows.push_back({times[i], 100.0 * interval.low, 100.0 * interval.high});
    }
    chart.series.emplace_back(std::move(band));
    chart.series.emplace_back(std::move(steps));
  }
  return chart;
}

plot::Chart profile_chart(const Results& results) {
  plot::Chart chart;
  chart.title = "Performance profile";
  chart.subtitle =
      "share of problems that some planner solves, solved within a multiple "
      "of the time of the fastest";
  chart.x = {.label = "time over that of the fastest planner",
             .scale = plot::Scale::kLog};
  chart.y = {.label = "problems [%]", .low = 0.0, .high = 100.0};
  const auto best = best_of(results, &suite::RunRecord::time);
  for (int planner = 0; planner < static_cast<int>(results.planners.size()); ++planner) {
    std::map<ProblemKey, double> ratios;  // the first seed stands for the planner
    for (const ResultRow* row : rows_of(results, planner)) {
      const auto found = best.find(problem_of(*row));
      if (!row->record.solved() || found == best.end() || !(found->second > 0.0))
        continue;
      ratios.try_emplace(problem_of(*row), row->record.time / found->second);
    }
    std::vector<double> sorted;
    sorted.reserve(ratios.size());
    for (const auto& [problem, ratio] : ratios) sorted.push_back(ratio);
    std::sort(sorted.begin(), sorted.end());
    plot::Steps steps{.label = results.planners[static_cast<std::size_t>(planner)].name,
                      .points = {},
                      .colour = colour_of(planner)};
    const std::size_t stride = std::max<std::size_t>(1, sorted.size() / 1000);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      if (i % stride != 0 && i + 1 != sorted.size()) continue;
      steps.points.push_back({sorted[i], 100.0 * static_cast<double>(i + 1) /
                                             static_cast<double>(best.size())});
    }
    chart.series.emplace_back(std::move(steps));
  }
  return chart;
}

plot::Chart cost_chart(const Results& results) {
  plot::Chart chart;
  chart.title = "Cost over time";
  chart.subtitle =
      "cost over the best found for that problem, median and quartiles of "
      "the runs that have a plan";
  chart.x = {.label = "processor time of planning [s]", .scale = plot::Scale::kLog};
  chart.y = {.label = "cost over the best known"};
  const auto best = best_of(results, &suite::RunRecord::cost);
  add_over_time(
      results,
      [&best](const ResultRow& row, double cost) {
        const double least = best.at(problem_of(row));
        return least > 0.0 ? cost / least : suite::kNothing;
      },
      chart);
  return chart;
}

plot::Chart gap_chart(const Results& results) {
  plot::Chart chart;
  chart.title = "Gap to the lower bound over time";
  chart.subtitle = "median and quartiles of the runs that have a plan";
  chart.x = {.label = "processor time of planning [s]", .scale = plot::Scale::kLog};
  chart.y = {.label = "gap [%]"};
  add_over_time(
      results,
      [](const ResultRow& row, double cost) {
        const double bound = row.record.bound;
        return bound > 0.0 ? 100.0 * (cost - bound) / bound : suite::kNothing;
      },
      chart);
  return chart;
}

}  // namespace prehensile::apps
