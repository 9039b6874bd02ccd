#include "benchmarks/precision_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "benchmarks/measure.h"
#include "plot/chart.h"

namespace prehensile::benchmarks {
namespace {

bool same_point(const PrecisionRun& a, const PrecisionRun& b) {
  return a.set == b.set && a.solver == b.solver && a.points == b.points &&
         a.generators == b.generators && a.compliance == b.compliance;
}

std::string number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

/// "spatial 0.1" in words.
std::string title_of(const std::string& set) {
  const std::size_t space = set.find(' ');
  if (space == std::string::npos) return set + " instants";
  return set.substr(0, space) + " instants at " + set.substr(space + 1) + " m/s^2";
}

/// Compliances between those drawn tell little.
bool is_drawn(const PrecisionRun& run) {
  return run.compliance != 0.1 && run.compliance != 1e-3;
}

/// What a line of the plot keeps fixed while something else varies.
std::string line_of(const PrecisionRun& run) {
  std::string label = run.solver;
  if (run.generators > 0) return label + ", g varies, k = " + std::to_string(run.points);
  if (run.set == "planar") return label;
  label += run.compliance > 0.0 ? ", R = " + number(run.compliance) : ", rigid";
  return label;
}

}  // namespace

std::vector<PrecisionPoint> points_of(const std::vector<PrecisionRun>& runs) {
  std::vector<PrecisionPoint> points;
  std::vector<std::vector<const PrecisionRun*>> members;
  for (const PrecisionRun& run : runs) {
    std::size_t at = 0;
    while (at < points.size() && !same_point(points[at].example, run)) ++at;
    if (at == points.size()) {
      points.push_back({.example = run});
      members.emplace_back();
    }
    if (run.asked) members[at].push_back(&run);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> force, twist, time;
    PrecisionPoint& point = points[i];
    for (const PrecisionRun* run : members[i]) {
      ++point.asked;
      time.push_back(run->time_us);
      if (!run->solved) continue;
      ++point.solved;
      point.residual = std::max(point.residual, run->residual);
      force.push_back(run->force_error);
      twist.push_back(run->twist_error);
    }
    point.force_median = quantile(force, 0.5);
    point.force_p95 = quantile(force, 0.95);
    point.twist_median = quantile(twist, 0.5);
    point.twist_p95 = quantile(twist, 0.95);
    point.time_median = quantile(time, 0.5);
  }
  return points;
}

std::string work_precision_svg(const std::vector<PrecisionPoint>& points,
                               const std::string& set) {
  plot::Chart chart;
  chart.title = "Error against run time, " + title_of(set);
  chart.subtitle =
      "solid: 95th percentile, dotted: median; points per pad vary unless said";
  chart.x = {.label = "median time [us]", .scale = plot::Scale::kLog};
  chart.y = {.label = "error of force or twist [1]", .scale = plot::Scale::kLog};
  chart.width = 860.0;
  chart.height = 560.0;
  std::vector<std::string> labels;
  for (const PrecisionPoint& point : points) {
    if (point.example.set != set || point.solved == 0 || !is_drawn(point.example)) {
      continue;
    }
    const std::string label = line_of(point.example);
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) {
      labels.push_back(label);
    }
  }
  for (const std::string& label : labels) {
    plot::Line p95{.label = label, .marks = true};
    plot::Line median{
        .colour = plot::Colour::kSame, .dash = plot::Dash::kDotted, .marks = true};
    for (const PrecisionPoint& point : points) {
      if (point.example.set != set || line_of(point.example) != label) continue;
      if (point.solved == 0) continue;
      p95.points.push_back(
          {point.time_median, std::max(point.force_p95, point.twist_p95)});
      median.points.push_back(
          {point.time_median, std::max(point.force_median, point.twist_median)});
    }
    chart.series.emplace_back(p95);
    chart.series.emplace_back(median);
  }
  return chart.svg();
}

std::string profile_svg(const std::vector<PrecisionRun>& runs,
                        const ProfileQuestion& question) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  constexpr double kLargest = 1e5;
  // Times by solver and instance; instants that someone solves.
  std::vector<std::string> solvers;
  std::map<int, std::map<std::string, double>> times;
  for (const PrecisionRun& run : runs) {
    const bool counts = run.set == question.set && run.points == question.points &&
                        run.compliance == question.compliance && run.asked &&
                        (run.generators == 0 || run.generators == question.generators);
    if (!counts) continue;
    if (std::find(solvers.begin(), solvers.end(), run.solver) == solvers.end()) {
      solvers.push_back(run.solver);
    }
    times[run.instance][run.solver] = run.solved ? run.time_us : kNever;
  }
  plot::Chart chart;
  chart.title = "Performance profile, " + title_of(question.set) + ", k = ";
  chart.title += std::to_string(question.points);
  chart.subtitle =
      std::to_string(times.size()) +
      " instants; polyhedral solvers on g = " + std::to_string(question.generators) +
      " generators";
  chart.x = {.label = "time over that of the fastest [1]", .scale = plot::Scale::kLog};
  chart.x.low = 1.0;
  chart.x.high = kLargest;
  chart.y = {.label = "share solved [1]", .low = 0.0, .high = 1.02};
  chart.width = 760.0;
  for (const std::string& solver : solvers) {
    std::vector<double> ratios;
    for (const auto& [instance, of] : times) {
      double fastest = kNever;
      for (const auto& [name, time] : of) fastest = std::min(fastest, time);
      const auto own = of.find(solver);
      if (own != of.end() && std::isfinite(own->second)) {
        ratios.push_back(own->second / fastest);
      }
    }
    std::sort(ratios.begin(), ratios.end());
    plot::Steps steps{.label = solver};
    double share = 0.0;
    steps.points.push_back({1.0, 0.0});
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      share = static_cast<double>(i + 1) / static_cast<double>(times.size());
      steps.points.push_back({ratios[i], share});
    }
    steps.points.push_back({kLargest, share});
    chart.series.emplace_back(steps);
  }
  return chart.svg();
}

}  // namespace prehensile::benchmarks
