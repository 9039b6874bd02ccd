#include "apps/place_report.h"

#include <cmath>

#include "apps/csv.h"
#include "apps/json_number.h"
#include "apps/parallel.h"
#include "apps/plan_report.h"
#include "apps/table.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

/// Angle of the push from the normal of its face.
double direction_of(const Model& model, const LinearPush& push) {
  const PushContact& contact = model.contacts[push.contact];
  return std::atan2(push.e.dot(contact.t), push.e.dot(contact.n));
}

std::string twist_text(const PlanarTwist& V) {
  return text("(%.4g mm/s, %.4g mm/s, %.4g deg/s)", to_mm(V[0]), to_mm(V[1]),
              to_deg(V[2]));
}

/// The command that makes the push.
std::string command_of(const PlaceReport& report, const PlacedPush& placed,
                       const WantedMotion& motion) {
  const PushContact& contact = report.model.contacts[placed.push.contact];
  const PlanarPose& X_HO = motion.X_HO;
  std::string out =
      motion.is_path ? "prehensile query push " : "prehensile query instant ";
  out += report.scene + " --pusher " + report.model.scene.pushers[contact.pusher].name +
         " --face " + report.model.faces[contact.face].name +
         text(" --at %.9g,%.9g,%.9g --place-mm %.9g --direction-deg %.9g", to_mm(X_HO.x),
              to_mm(X_HO.y), to_deg(X_HO.theta), to_mm(placed.push.place),
              to_deg(direction_of(report.model, placed.push)));
  out += motion.is_path ? text(" --travel-mm %.9g --turn-deg %.9g",
                               to_mm(placed.push.travel), to_deg(placed.push.turn))
                        : text(" --speed-mm-s %.9g --turn-deg-s %.9g",
                               to_mm(placed.push.travel), to_deg(placed.push.turn));
  if (placed.grip_force != report.model.scene.gripper.grip_force) {
    out += text(" --set gripper.grip_force=%.9g", placed.grip_force);
  }
  return out;
}

std::string placed_text(const PlaceReport& report, const PlacedPush& placed,
                        const WantedMotion& motion) {
  std::string out =
      contact_text(report.model, placed.push.contact) +
      text(" at place %.3f mm, direction %.3f deg from its normal, grip force %.4g N\n",
           to_mm(placed.push.place), to_deg(direction_of(report.model, placed.push)),
           placed.grip_force);
  out += text("push force %.4f N, slack %.4f, over the box of uncertainty %.4f%s\n",
              placed.push_force, placed.slack, placed.robust_slack,
              placed.robust_slack < 0.0 ? " (does not survive the whole box)" : "");
  out += "forward, by the exact solver: " + std::string(name(placed.status)) +
         text(", twist off by %.1e, certificate %.1e\n", placed.twist_error,
              placed.certificate);
  if (motion.is_path) {
    out += "whole push: " + std::string(name(placed.forward.status)) +
           text(", ends %.2e mm and %.2e deg from the wanted pose\n",
                to_mm(placed.end_distance), to_deg(placed.end_angle));
  }
  return out + "  " + command_of(report, placed, motion) + '\n';
}

nlohmann::ordered_json placed_json(const PlaceReport& report, const PlacedPush& placed,
                                   const WantedMotion& motion) {
  const PushContact& contact = report.model.contacts[placed.push.contact];
  nlohmann::ordered_json out = {
      {"pusher", report.model.scene.pushers[contact.pusher].name},
      {"face", report.model.faces[contact.face].name},
      {"place", number(placed.push.place)},
      {"direction", number(direction_of(report.model, placed.push))},
      {"travel", number(placed.push.travel)},
      {"turn", number(placed.push.turn)},
      {"grip_force", number(placed.grip_force)},
      {"push_force", number(placed.push_force)},
      {"slack", number(placed.slack)},
      {"robust_slack", number(placed.robust_slack)},
      {"status", std::string(name(placed.status))},
      {"twist_error", number(placed.twist_error)},
      {"certificate", number(placed.certificate)},
      {"command", command_of(report, placed, motion)}};
  if (motion.is_path) {
    out["forward"] = {{"status", std::string(name(placed.forward.status))},
                      {"end_distance", number(placed.end_distance)},
                      {"end_angle", number(placed.end_angle)}};
  }
  return out;
}

plot::Point mm(const Vec2& p) { return {to_mm(p.x()), to_mm(p.y())}; }

/// Object, finger axis, wanted motion, pusher and its force, seen from the hand.
plot::Chart chart_of_push(const PlaceReport& report, const PlacedPush& placed,
                          const WantedMotion& motion) {
  const PlanarPose& X_HO = motion.X_HO;
  plot::Chart chart{.title = "Where to push", .subtitle = report.question};
  chart.x.label = "x in the hand [mm]";
  chart.y.label = "y in the hand [mm]";
  chart.equal_scales = true;
  plot::Region object{.label = "object", .colour = plot::Colour::kGrey};
  for (const Vec2& p : report.model.outline) {
    object.points.push_back(mm(transform(X_HO, p)));
  }
  chart.series.emplace_back(object);
  const PlanarTwist V = motion.twist_HO();
  double fastest = 1e-12;
  for (const Vec2& p : report.model.outline) {
    fastest = std::max(fastest, point_velocity(V, transform(X_HO, p)).norm());
  }
  const double scale = 0.25 * report.model.L / fastest;
  bool first = true;
  for (const Vec2& p_O : report.model.outline) {
    const Vec2 p = transform(X_HO, p_O);
    chart.series.emplace_back(plot::Arrow{.label = first ? "motion" : "",
                                          .tail = mm(p),
                                          .head = mm(p + scale * point_velocity(V, p)),
                                          .colour = plot::Colour::kBlue});
    first = false;
  }
  chart.series.emplace_back(plot::Scatter{.label = "finger axis",
                                          .points = {{0.0, 0.0}},
                                          .colour = plot::Colour::kGreen,
                                          .mark = plot::Mark::kDiamond,
                                          .size = 5.0});
  if (!placed.found) return chart;
  const PushContact& contact = report.model.contacts[placed.push.contact];
  const PushContact::Segment segment = contact.segment(placed.push.place);
  chart.series.emplace_back(plot::Line{
      .label = "pusher",
      .points = {mm(transform(X_HO, segment.a)), mm(transform(X_HO, segment.b))},
      .colour = plot::Colour::kBlack,
      .marks = true});
  const Vec2 middle = transform(X_HO, 0.5 * (segment.a + segment.b));
  const Vec2 n = rotated(X_HO.theta, contact.n);
  const double half_angle = std::atan(contact.mu);
  const double normal = std::atan2(n.y(), n.x());
  chart.series.emplace_back(
      plot::Region{.label = "friction cone",
                   .points = plot::sector(mm(middle), 0.0, to_mm(0.2 * report.model.L),
                                          normal - half_angle, normal + half_angle),
                   .colour = plot::Colour::kOrange});
  return chart;
}

plot::Chart chart_of_margin(const PlaceReport& report,
                            const std::vector<PlaceCurve>& curves) {
  plot::Chart chart{.title = "Margin against place",
                    .subtitle = "dashed: over the box of uncertainty; sticks above 0"};
  chart.x.label = "place along the face [mm]";
  chart.y.label = "slack";
  int index = 0;
  static constexpr std::array<plot::Colour, 4> kColours = {
      plot::Colour::kBlue, plot::Colour::kRed, plot::Colour::kGreen,
      plot::Colour::kPurple};
  for (const PlaceCurve& curve : curves) {
    const plot::Colour colour = kColours[static_cast<std::size_t>(index++) % 4];
    plot::Line nominal{.label = curve.label, .colour = colour};
    plot::Line robust{.colour = colour, .dash = plot::Dash::kDashed};
    for (std::size_t k = 0; k < curve.place.size(); ++k) {
      nominal.points.push_back({to_mm(curve.place[k]), curve.nominal[k]});
      robust.points.push_back({to_mm(curve.place[k]), curve.robust[k]});
    }
    chart.series.emplace_back(std::move(nominal));
    chart.series.emplace_back(std::move(robust));
  }
  chart.series.emplace_back(plot::Rule{.value = 0.0});
  if (report.answer.best.found) {
    chart.series.emplace_back(plot::Rule{.label = "chosen",
                                         .value = to_mm(report.answer.best.push.place),
                                         .vertical = true,
                                         .colour = plot::Colour::kBlack});
  }
  return chart;
}

}  // namespace

std::string describe(const PlaceReport& report) {
  const PlaceAnswer& answer = report.answer;
  std::string out = report.question + '\n' + std::string(name(answer.status));
  if (!answer.reason.empty()) out += ": " + std::string(answer.reason);
  out += '\n';
  if (answer.best.found) out += placed_text(report, answer.best, report.wanted);
  Table table({"contact", "possible", "grip force N", "why not", "proof"});
  for (const ContactVerdict& verdict : answer.verdicts) {
    const bool proved = proves(report.model, report.wanted, report.options, verdict);
    table.add(
        {contact_text(report.model, verdict.contact), verdict.possible ? "yes" : "no",
         verdict.possible ? text("%.4g to %.4g", verdict.grip_low, verdict.grip_high)
                          : "-",
         std::string(verdict.reason),
         proved                      ? twist_text(verdict.proof)
         : verdict.proof.allFinite() ? "does not hold"
                                     : "-"});
  }
  out += table.str();
  if (answer.status == PlaceAnswer::Status::kImpossible) {
    out +=
        "proof: against this twist no force of the contact works anywhere on its face, "
        "but "
        "the force that the sliding pads ask for does\n";
  }
  if (report.nearest.found) {
    out += text("nearest motion found that is possible, %.3f deg away in (v, c omega): ",
                to_deg(report.nearest.angle)) +
           twist_text(report.nearest.motion.twist_HO()) + '\n' +
           placed_text(report, report.nearest.answer.best, report.nearest.motion);
  }
  return out;
}

nlohmann::ordered_json to_json(const PlaceReport& report) {
  const PlaceAnswer& answer = report.answer;
  nlohmann::ordered_json out = {
      {"question", report.question},
      {"status", std::string(name(answer.status))},
      {"reason", std::string(answer.reason)},
      {"wanted_twist", numbers(report.wanted.twist_HO())},
      {"evaluations", answer.evaluations},
      {"push", answer.best.found ? placed_json(report, answer.best, report.wanted)
                                 : nlohmann::ordered_json(nullptr)},
      {"contacts", nlohmann::ordered_json::array()}};
  for (const ContactVerdict& verdict : answer.verdicts) {
    out["contacts"].push_back(
        {{"contact", contact_text(report.model, verdict.contact)},
         {"possible", verdict.possible},
         {"grip_force", {number(verdict.grip_low), number(verdict.grip_high)}},
         {"reason", std::string(verdict.reason)},
         {"proof", numbers(verdict.proof)},
         {"proof_holds", proves(report.model, report.wanted, report.options, verdict)}});
  }
  out["nearest"] = nullptr;
  if (report.nearest.found) {
    out["nearest"] = {
        {"angle", number(report.nearest.angle)},
        {"twist", numbers(report.nearest.motion.twist_HO())},
        {"push", placed_json(report, report.nearest.answer.best, report.nearest.motion)}};
  }
  return out;
}

std::vector<PlaceCurve> curves_of(const PlaceReport& report) {
  constexpr int kPlaces = 201;
  std::vector<PlaceCurve> curves;
  Scene scene = report.model.scene;
  if (std::isfinite(report.answer.best.grip_force)) {
    scene.gripper.grip_force = report.answer.best.grip_force;
  }
  const Model model = prepare(scene, report.model.options);
  for (const ContactVerdict& verdict : report.answer.verdicts) {
    const PushContact& contact = model.contacts[verdict.contact];
    const bool in_space = model.push_needs_space(contact);
    if (!verdict.possible || (in_space && contact.is_point)) continue;
    const double half = 0.5 * (contact.b - contact.a).norm();
    PlaceCurve curve{.label = contact_text(model, verdict.contact)};
    curve.place.resize(kPlaces);
    curve.nominal.resize(kPlaces);
    curve.robust.resize(kPlaces);
    for_each_index(kPlaces, number_of_jobs(0), [&](int k) {
      const double place = half * (2.0 * k / (kPlaces - 1.0) - 1.0);
      const PlaceSlack slack =
          slack_at(model, report.wanted, verdict.contact, place, report.options.margin);
      curve.place[k] = place;
      curve.nominal[k] = slack.nominal;
      curve.robust[k] = slack.robust;
    });
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::string to_csv(const std::vector<PlaceCurve>& curves) {
  std::string out = "contact,place_m,slack,robust_slack\n";
  for (const PlaceCurve& curve : curves) {
    for (std::size_t k = 0; k < curve.place.size(); ++k) {
      out += csv_line({csv_text(curve.label), csv_number(curve.place[k]),
                       csv_number(curve.nominal[k]), csv_number(curve.robust[k])});
    }
  }
  return out;
}

std::string to_svg(const PlaceReport& report, const std::vector<PlaceCurve>& curves) {
  std::vector<plot::Chart> charts = {
      chart_of_push(report, report.answer.best, report.wanted)};
  if (!report.answer.best.found && report.nearest.found) {
    charts.push_back(
        chart_of_push(report, report.nearest.answer.best, report.nearest.motion));
    charts.back().title = "Nearest possible motion";
  } else if (!curves.empty()) {
    charts.push_back(chart_of_margin(report, curves));
  }
  return plot::svg_of_sheet(charts, 2);
}

}  // namespace prehensile::apps
