#include <cmath>

#include "apps/calibration_report.h"
#include "apps/table.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

plot::Scatter scatter(const char* label, plot::Colour colour, plot::Mark mark) {
  return {.label = label, .colour = colour, .mark = mark, .size = 2.6};
}

/// Where pushes ended against where they were predicted to end.
plot::Chart residual_chart(const CalibratedSetup& setup) {
  plot::Chart chart{.title = "End of each push against its prediction"};
  chart.x.label = "along the pusher's path [mm]";
  chart.y.label = "across it [mm]";
  const auto add = [&](const Eigen::MatrixXd& r, plot::Scatter out) {
    for (Eigen::Index i = 0; i < r.cols(); ++i) {
      out.points.push_back({to_mm(r(0, i)), to_mm(r(1, i))});
    }
    chart.series.push_back(out);
  };
  add(setup.calibration.before,
      scatter("scene as it was", plot::Colour::kOrange, plot::Mark::kSquare));
  add(setup.calibration.held_out,
      scatter("calibrated, held out", plot::Colour::kBlue, plot::Mark::kCircle));
  return chart;
}

plot::Chart turn_chart(const CalibratedSetup& setup) {
  plot::Chart chart{.title = "Turn of the object, predicted against measured"};
  chart.x.label = "measured [deg]";
  chart.y.label = "predicted [deg]";
  double least = 0.0, most = 0.0;
  const auto add = [&](const Eigen::MatrixXd& r, plot::Scatter out) {
    for (Eigen::Index i = 0; i < r.cols(); ++i) {
      const MeasuredPush& push = setup.data.pushes[static_cast<std::size_t>(i)];
      const double turn = wrapped(push.X_HO_end.theta - push.X_HO_start.theta);
      out.points.push_back({to_deg(turn), to_deg(turn - r(2, i))});
      least = std::min(least, to_deg(turn));
      most = std::max(most, to_deg(turn));
    }
    chart.series.push_back(out);
  };
  add(setup.calibration.before,
      scatter("scene as it was", plot::Colour::kOrange, plot::Mark::kSquare));
  add(setup.calibration.held_out,
      scatter("calibrated, held out", plot::Colour::kBlue, plot::Mark::kCircle));
  chart.series.push_back(plot::Line{.points = {{least, least}, {most, most}},
                                    .colour = plot::Colour::kGrey,
                                    .dash = plot::Dash::kDashed});
  return chart;
}

plot::Chart slip_chart(const CalibratedSetup& setup) {
  plot::Chart chart{.title = "Slip force against grip force"};
  chart.x.label = "grip force of each finger [N]";
  chart.y.label = "slip force [N]";
  chart.x.from_zero = chart.y.from_zero = true;
  plot::Scatter measured = scatter("measured", plot::Colour::kBlue, plot::Mark::kCircle);
  plot::Scatter predicted =
      scatter("calibrated, held out", plot::Colour::kOrange, plot::Mark::kCross);
  for (std::size_t i = 0; i < setup.data.readings.size(); ++i) {
    const SlipReading& reading = setup.data.readings[i];
    if (!reading.slip_force) continue;
    const double r = setup.calibration.held_out(0, static_cast<Eigen::Index>(i));
    measured.points.push_back({reading.grip_force, *reading.slip_force});
    predicted.points.push_back({reading.grip_force, *reading.slip_force * std::exp(-r)});
  }
  chart.series = {measured, predicted};
  return chart;
}

plot::Chart profile_chart(const CalibratedSetup& setup, std::size_t j) {
  const CalibratedParameter& parameter = setup.calibration.parameters[j];
  const ShownUnit shown = shown_unit(setup.fit.targets[j].target);
  plot::Chart chart{.title = setup.fit.problem.parameters[j].name};
  chart.subtitle = parameter.told ? "profile of the likelihood"
                                  : "profile of the likelihood: the data cannot tell";
  chart.x.label = setup.fit.problem.parameters[j].name +
                  (*shown.unit ? text(" [%s]", shown.unit) : std::string());
  chart.y.label = "rise of - log likelihood";
  chart.y.low = 0.0;
  chart.y.high = 3.0 * parameter.profile.limit;
  const FitInterval& interval = parameter.profile.interval;
  if (parameter.told) {
    // The search for the ends starts far outside: the picture does not.
    const double beyond = 0.4 * interval.half_width();
    chart.x.low = shown.factor * (interval.low - beyond);
    chart.x.high = shown.factor * (interval.high + beyond);
  }
  plot::Line line{.colour = plot::Colour::kBlue, .marks = true};
  for (const ProfilePoint& point : parameter.profile.points) {
    line.points.push_back({shown.factor * point.value, point.rise});
  }
  chart.series = {line, plot::Rule{.label = text("%g %%", 100.0 * setup.options.level),
                                   .value = parameter.profile.limit,
                                   .colour = plot::Colour::kRed}};
  return chart;
}

}  // namespace

std::string to_svg(const CalibratedSetup& setup) {
  std::vector<plot::Chart> charts;
  if (setup.is_of_pushes()) {
    charts = {residual_chart(setup), turn_chart(setup)};
  } else {
    charts = {slip_chart(setup)};
  }
  for (std::size_t j = 0; j < setup.fit.targets.size(); ++j) {
    charts.push_back(profile_chart(setup, j));
  }
  return plot::svg_of_sheet(charts, 2);
}

}  // namespace prehensile::apps
