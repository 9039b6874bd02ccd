#include "apps/spread_report.h"

#include <cmath>

#include "apps/csv.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

constexpr std::array<const char*, kDeviations> kNames = {"normal mm", "tangential mm",
                                                         "angle deg"};
constexpr std::array<const char*, kDeviations> kKeys = {"normal", "tangential", "angle"};

double shown(int part, double value) { return part == 2 ? to_deg(value) : to_mm(value); }

SpreadQuantiles quantiles(const Ensemble& ensemble, int part, double level) {
  return spread_quantiles(ensemble.sorted(&EnsembleMember::end, kDeviationParts[part]),
                          level);
}

/// A share of real pushes is stated only where a factor was learnt on some.
std::string interval_name(const SpreadReport& report) {
  return report.has_factor
             ? text("stated %g %%", 100.0 * report.level)
             : text("%g %% of the box, without a factor", 100.0 * report.level);
}

std::string range_text(int part, double low, double high) {
  return text("%+.3f to %+.3f", shown(part, low), shown(part, high));
}

nlohmann::ordered_json ensemble_json(const SpreadReport& report, const Ensemble& ensemble,
                                     const UncertaintyBox& box) {
  nlohmann::ordered_json out = {{"box", to_json(box)},
                                {"samples", ensemble.members.size()},
                                {"completed", ensemble.completed()}};
  for (int part = 0; part < kDeviations; ++part) {
    const SpreadQuantiles q = quantiles(ensemble, part, report.level);
    out[kKeys[part]] = {
        {"low", number(q.low)}, {"median", number(q.middle)}, {"high", number(q.high)}};
  }
  return out;
}

UncertaintyBox both(const SpreadReport& report) {
  UncertaintyBox box = report.mechanics;
  for (std::size_t i = 0; i < box.half_width.size(); ++i) {
    if (report.registration.half_width[i] > 0.0) {
      box.half_width[i] = report.registration.half_width[i];
    }
  }
  return box;
}

plot::Scatter places(const Ensemble& ensemble, const char* label, plot::Colour colour,
                     plot::Mark mark, double size) {
  plot::Scatter out{.label = label, .colour = colour, .mark = mark, .size = size};
  for (const EnsembleMember& member : ensemble.members) {
    if (!member.completed()) continue;
    out.points.push_back({to_mm(member.end.normal), to_mm(member.end.tangential)});
  }
  return out;
}

plot::Steps distribution(const Ensemble& ensemble, const char* label,
                         plot::Colour colour) {
  plot::Steps out{.label = label, .colour = colour};
  const std::vector<double> values =
      ensemble.sorted(&EnsembleMember::end, &Deviation::angle);
  for (std::size_t i = 0; i < values.size(); ++i) {
    out.points.push_back({to_deg(values[i]), (static_cast<double>(i) + 1.0) /
                                                 static_cast<double>(values.size())});
  }
  return out;
}

}  // namespace

double SpreadReport::floor(int part) const {
  const Deviation& motion = from_both.nominal_motion;
  if (part == 2) return std::hypot(floor_share * motion.angle, scatter_angle);
  return std::hypot(floor_share * std::hypot(motion.normal, motion.tangential), scatter);
}

SpreadInterval SpreadReport::interval(int part) const {
  return stated_interval(quantiles(from_both, part, level), floor(part), factor[part]);
}

std::string describe(const SpreadReport& report) {
  const Ensemble& joint = report.from_both;
  std::string out = report.question + '\n';
  const Deviation& motion = joint.nominal_motion;
  out +=
      "nominal: " + std::string(name(joint.nominal.status)) +
      text(", moved %.3f mm along the normal, %.3f mm along the face, turned %.3f deg\n",
           to_mm(motion.normal), to_mm(motion.tangential), to_deg(motion.angle));
  if (!joint.nominal.reason.empty()) out += std::string(joint.nominal.reason) + '\n';
  out += text("of %zu pushes of the whole box: ", joint.members.size()) + joint.tally() +
         text(
             "\ndeviation of the end pose from the nominal one; the columns before the "
             "factor hold %g %% of the\npushes of their box, which is not the share of "
             "real pushes: that is what the factor is for\n",
             100.0 * report.level);
  Table table({"", "friction and pressure", "registration", "both", "floor ±", "factor",
               interval_name(report)});
  for (int part = 0; part < kDeviations; ++part) {
    const SpreadQuantiles a = quantiles(report.from_mechanics, part, report.level);
    const SpreadQuantiles b = quantiles(report.from_registration, part, report.level);
    const SpreadQuantiles c = quantiles(joint, part, report.level);
    const SpreadInterval stated = report.interval(part);
    table.add(
        {kNames[part], range_text(part, a.low, a.high), range_text(part, b.low, b.high),
         range_text(part, c.low, c.high), text("%.3f", shown(part, report.floor(part))),
         text("%.2f", report.factor[part]), range_text(part, stated.low, stated.high)});
  }
  out += table.str();
  out += "spread from friction and pressure: " + box_text(report.mechanics) + '\n';
  out += "registration: " + box_text(report.registration) + '\n';
  out += "these boxes: " + report.box_source + '\n';
  out += text("floor: %g %% of the motion, friction from spot to spot",
              100.0 * report.floor_share);
  if (report.scatter > 0.0) {
    out += text("; %.3g mm and %.3g deg that the calibration could not explain",
                to_mm(report.scatter), to_deg(report.scatter_angle));
  }
  out += '\n';
  return out + "factor: " + report.factor_source + '\n';
}

nlohmann::ordered_json to_json(const SpreadReport& report) {
  const Ensemble& joint = report.from_both;
  const Deviation& motion = joint.nominal_motion;
  nlohmann::ordered_json out = {
      {"question", report.question},
      {"level", number(report.level)},
      {"boxes", report.box_source},
      {"nominal",
       {{"status", std::string(name(joint.nominal.status))},
        {"reason", std::string(joint.nominal.reason)},
        {"normal", number(motion.normal)},
        {"tangential", number(motion.tangential)},
        {"angle", number(motion.angle)}}},
      {"spread_from_friction_and_pressure",
       ensemble_json(report, report.from_mechanics, report.mechanics)},
      {"registration",
       ensemble_json(report, report.from_registration, report.registration)},
      {"both", ensemble_json(report, joint, both(report))},
      {"floor",
       {{"share_of_motion", number(report.floor_share)},
        {"scatter", number(report.scatter)},
        {"scatter_angle", number(report.scatter_angle)}}},
      {"factor", {{"source", report.factor_source}}},
      {"interval", nlohmann::ordered_json::object()}};
  for (int part = 0; part < kDeviations; ++part) {
    const SpreadInterval stated = report.interval(part);
    out["floor"][kKeys[part]] = number(report.floor(part));
    out["factor"][kKeys[part]] = number(report.factor[part]);
    out["interval"][kKeys[part]] = {{"low", number(stated.low)},
                                    {"high", number(stated.high)}};
  }
  return out;
}

std::string to_csv(const SpreadReport& report) {
  std::string out = "box,index,status,normal_m,tangential_m,angle_rad,max_push_force_N\n";
  const auto add = [&](const char* box, const Ensemble& ensemble) {
    for (std::size_t i = 0; i < ensemble.members.size(); ++i) {
      const EnsembleMember& member = ensemble.members[i];
      out += csv_line({box, std::to_string(i),
                       member.is_scene ? std::string(name(member.status)) : "no scene",
                       csv_number(member.end.normal), csv_number(member.end.tangential),
                       csv_number(member.end.angle), csv_number(member.max_push_force)});
    }
  };
  add("friction and pressure", report.from_mechanics);
  add("registration", report.from_registration);
  add("both", report.from_both);
  return out;
}

std::string to_svg(const SpreadReport& report) {
  plot::Chart ends{.title = "Where the push ends", .subtitle = report.question};
  ends.x.label = "along the normal, against nominal [mm]";
  ends.y.label = "along the face, against nominal [mm]";
  const SpreadInterval x = report.interval(0);
  const SpreadInterval y = report.interval(1);
  ends.series = {
      places(report.from_both, "both", plot::Colour::kSky, plot::Mark::kCircle, 3.5),
      places(report.from_registration, "registration", plot::Colour::kOrange,
             plot::Mark::kSquare, 1.8),
      places(report.from_mechanics, "friction and pressure", plot::Colour::kBlue,
             plot::Mark::kDiamond, 2.2),
      plot::Region{.label = interval_name(report) + " of each",
                   .points = {{to_mm(x.low), to_mm(y.low)},
                              {to_mm(x.high), to_mm(y.low)},
                              {to_mm(x.high), to_mm(y.high)},
                              {to_mm(x.low), to_mm(y.high)}},
                   .colour = plot::Colour::kRed,
                   .filled = false}};
  plot::Chart angles{.title = "Angle at the end"};
  angles.x.label = "angle, against nominal [deg]";
  angles.y.label = "share of pushes";
  angles.y.from_zero = true;
  const SpreadInterval angle = report.interval(2);
  angles.series = {
      distribution(report.from_both, "both", plot::Colour::kSky),
      distribution(report.from_registration, "registration", plot::Colour::kOrange),
      distribution(report.from_mechanics, "friction and pressure", plot::Colour::kBlue),
      plot::Rule{.label = interval_name(report),
                 .value = to_deg(angle.low),
                 .vertical = true,
                 .colour = plot::Colour::kRed},
      plot::Rule{
          .value = to_deg(angle.high), .vertical = true, .colour = plot::Colour::kRed}};
  return plot::svg_of_sheet({ends, angles}, 2);
}

}  // namespace prehensile::apps
