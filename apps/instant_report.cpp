#include "apps/instant_report.h"

#include <cmath>

#include "apps/json_number.h"
#include "apps/table.h"

namespace prehensile::apps {
namespace {

const char* const kContactNames[] = {"jaw 1", "jaw 2", "support"};

std::string pusher_table(const InstantReport& report) {
  Table table({"pusher point", "x mm", "y mm", "normal N", "tangential N",
               "gap rate mm/s", "slip mm/s", "mode"});
  for (int i = 0; i < report.instant.pusher_count; ++i) {
    const PusherPoint& point = report.instant.pusher[i];
    const Vec2& p = report.drive.p_HC[i];
    table.add({text("%d", i + 1), text("%.2f", to_mm(p.x())), text("%.2f", to_mm(p.y())),
               text("%.4f", point.normal_force), text("%.4f", point.tangential_force),
               text("%.4f", to_mm(point.normal_rate)),
               text("%.4f", to_mm(point.slip_rate)), std::string(name(point.mode))});
  }
  return table.str();
}

std::string finger_table(const InstantReport& report) {
  Table table(
      {"finger point", "x mm", "y mm", "bound N", "force x N", "force y N", "mode"});
  for (int j = 0; j < report.instant.finger_count; ++j) {
    const FingerPoint& point = report.instant.finger[j];
    table.add({text("%d", j + 1), text("%.2f", to_mm(report.grasp.x[j])),
               text("%.2f", to_mm(report.grasp.y[j])),
               text("%.4f", report.grasp.bound[j]), text("%.4f", point.force.x()),
               text("%.4f", point.force.y()), std::string(name(point.mode))});
  }
  return table.str();
}

/// What decides the answer: how many points of pusher and pads do what.
std::string modes_in_words(const InstantReport& report) {
  const PlanarInstant& now = report.instant;
  std::string out = "pusher:";
  for (int i = 0; i < now.pusher_count; ++i) {
    out += i == 0 ? " " : ", ";
    out += name(now.pusher[i].mode);
  }
  int sticking = 0;
  for (int j = 0; j < now.finger_count; ++j) {
    if (now.finger[j].mode == ContactMode::kStick) ++sticking;
  }
  if (now.finger_count == 0) return out + "; pads: as a whole\n";
  return out + text("; pads: %d of %d points slip\n", now.finger_count - sticking,
                    now.finger_count);
}

std::string certificate_text(const InstantReport& report) {
  std::string out = text(
      "certificate: worst %.1e (units of force, rate and length of the "
      "problem; accepted up to 1e-06)\n",
      report.certificate_worst);
  for (int i = 0; i < Certificate::kCheckCount; ++i) {
    const CertificateEntry& entry = report.certificate.entries[i];
    if (!std::isfinite(entry.value)) continue;
    out +=
        text("  %-16s %.1e\n",
             std::string(name(static_cast<Certificate::Check>(i))).c_str(), entry.value);
  }
  if (std::isfinite(report.certificate.force_high)) {
    out += text(
        "  push force in this direction: at least %.6f N by forces in balance, at most "
        "%.6f N by this motion\n",
        report.certificate.force_low, report.certificate.force_high);
  }
  if (report.solver == "ipopt" && report.certificate_worst > 1e-6) {
    out +=
        "  (expected: this solver's friction cones are polyhedra inside the circular "
        "ones "
        "of the certificate; its own laws it meets to the residual above)\n";
  }
  return out;
}

/// The reference does not look for other answers.
std::string meaning_of(const InstantReport& report) {
  if (report.solver == "ipopt" && report.instant.status == InstantStatus::kMoves) {
    return "the grasp breaks and the object moves; whether otherwise too is not examined";
  }
  return meaning(report.instant.status);
}

std::string roll_motion(const char* what, const CrossSectionMotion& motion) {
  return text(
      "%s: roll rate %.4f deg/s, object %.4f mm/s along the closing direction, %.4f mm/s "
      "off the support, jaws closing at %.4f mm/s\n",
      what, to_deg(motion.roll_rate), to_mm(motion.v_z), to_mm(motion.v_u),
      to_mm(motion.jaw_rate));
}

/// Forces of the three contacts; with their modes where those are given.
std::string roll_forces(const CrossSectionForces& forces,
                        const std::array<ContactMode, 3>* modes) {
  Table table(
      modes ? std::vector<std::string>{"contact", "normal N", "tangential N", "mode"}
            : std::vector<std::string>{"contact", "normal N", "tangential N"});
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> row = {kContactNames[i], text("%.4f", forces.normal[i]),
                                    text("%.4f", forces.tangential[i])};
    if (modes) row.emplace_back(name((*modes)[i]));
    table.add(std::move(row));
  }
  return table.str();
}

/// A change that people can picture, in SI and in words.
struct Step {
  double size;
  const char* text;
};

Step step_of(InstantParameter parameter) {
  switch (parameter) {
    case InstantParameter::kGripForce:
      return {1.0, "+1 N"};
    case InstantParameter::kMass:
      return {0.1, "+0.1 kg"};
    case InstantParameter::kPlace:
      return {1e-3, "+1 mm"};
    case InstantParameter::kDirection:
      return {0.017453292519943295, "+1 deg"};
    default:
      return {0.1, "+0.1"};
  }
}

nlohmann::ordered_json points_json(const InstantReport& report) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (int i = 0; i < report.instant.pusher_count; ++i) {
    const PusherPoint& point = report.instant.pusher[i];
    points.push_back({{"on", "pusher"},
                      {"position", numbers(report.drive.p_HC[i])},
                      {"normal_force", number(point.normal_force)},
                      {"tangential_force", number(point.tangential_force)},
                      {"normal_rate", number(point.normal_rate)},
                      {"slip_rate", number(point.slip_rate)},
                      {"mode", std::string(name(point.mode))}});
  }
  for (int j = 0; j < report.instant.finger_count; ++j) {
    const FingerPoint& point = report.instant.finger[j];
    points.push_back({{"on", "fingers"},
                      {"position", numbers(Vec2(report.grasp.x[j], report.grasp.y[j]))},
                      {"bound", number(report.grasp.bound[j])},
                      {"force", numbers(point.force)},
                      {"mode", std::string(name(point.mode))}});
  }
  return points;
}

}  // namespace

std::string describe(const Sensitivities& sensitivities) {
  if (sensitivities.rows.empty()) return {};
  if (!sensitivities.rows.front().V_HO.allFinite()) {
    return "sensitivities: none, because the answer does not change smoothly here\n";
  }
  Table table({"if this changes", "by", "push force N", "v_x mm/s", "v_y mm/s",
               "v_z mm/s", "turn deg/s"});
  for (std::size_t i = 0; i < sensitivities.rows.size(); ++i) {
    const auto parameter = static_cast<InstantParameter>(i);
    const Sensitivities::Row& change = sensitivities.rows[i];
    const auto [size, words] = step_of(parameter);
    table.add({std::string(name(parameter)), words,
               text("%+.4f", size * change.push_force),
               text("%+.4f", to_mm(size * change.V_HO[0])),
               text("%+.4f", to_mm(size * change.V_HO[1])),
               text("%+.4f", to_mm(size * change.V_HO[2])),
               text("%+.4f", to_deg(size * change.V_HO[5]))});
  }
  const double slack = sensitivities.mode_slack;
  return "sensitivities (linear):\n" + table.str() +
         text("nearest change of mode: %.2e of capacity or push rate away%s\n", slack,
              slack < 1e-6 ? "; the derivatives hold on one side only" : "");
}

nlohmann::ordered_json to_json(const Sensitivities& sensitivities) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < sensitivities.rows.size(); ++i) {
    const auto parameter = static_cast<InstantParameter>(i);
    const Sensitivities::Row& change = sensitivities.rows[i];
    rows.push_back({{"parameter", std::string(name(parameter))},
                    {"per", std::string(unit(parameter))},
                    {"push_force", number(change.push_force)},
                    {"push_wrench", numbers(change.w_push)},
                    {"object_twist", numbers(change.V_HO)}});
  }
  return rows;
}

const char* meaning(InstantStatus status) {
  switch (status) {
    case InstantStatus::kNotRun:
      return "this solver is not part of this build";
    case InstantStatus::kMoves:
      return "the grasp breaks and the object moves; motion and forces are unique";
    case InstantStatus::kHolds:
      return "the object stays in the grasp and the pusher slides along it";
    case InstantStatus::kNonuniqueForces:
      return "the motion is unique, the forces shown are one choice from an interval";
    case InstantStatus::kAmbiguous:
      return "more than one motion obeys every law (or the pusher has to carry the "
             "object)";
    case InstantStatus::kSeparated:
      return "the pusher leaves the object, which stays in the grasp";
    case InstantStatus::kDynamic:
      return "no equilibrium: the object falls or is flung; the twist shown proves it";
    case InstantStatus::kJammed:
      return "no motion is possible: the object is wedged";
    case InstantStatus::kOutOfIterations:
      return "no answer: the solver ran out of iterations";
    case InstantStatus::kBadInput:
      return "the question is not well posed (no push rate, no friction, or not finite)";
  }
  return "";
}

std::string describe(const InstantReport& report) {
  const PlanarInstant& now = report.instant;
  std::string out = report.question + '\n';
  out += std::string(name(now.status)) + ": " + meaning_of(report) + '\n';
  if (usable(now.status)) {
    out += text(
        "push force %.6g N: (%.4f, %.4f) N on the object, moment %.4f N mm about the "
        "finger axis\n",
        now.push_force, now.w_push[0], now.w_push[1], 1e3 * now.w_push[2]);
    out += text("object twist: %.4f, %.4f mm/s, %.4f deg/s\n", to_mm(now.V_HO[0]),
                to_mm(now.V_HO[1]), to_deg(now.V_HO[2]));
    if (now.status == InstantStatus::kNonuniqueForces) {
      out += text("normal push force anywhere in [%.4f, %.4f] N\n", now.force_low,
                  now.force_high);
    }
    out += modes_in_words(report);
  }
  if (now.evidence.allFinite()) {
    out += text("evidence twist: %.4f, %.4f mm/s, %.4f deg/s\n", to_mm(now.evidence[0]),
                to_mm(now.evidence[1]), to_deg(now.evidence[2]));
  }
  if (now.other.allFinite()) {
    out += text("other motion: %.4f, %.4f mm/s, %.4f deg/s\n", to_mm(now.other[0]),
                to_mm(now.other[1]), to_deg(now.other[2]));
  }
  if (usable(now.status)) {
    out += pusher_table(report);
    if (now.finger_count > 0) out += finger_table(report);
  }
  out += describe(report.sensitivities);
  out += text("solver %s: %d iterations", report.solver.c_str(), now.iterations);
  if (std::isfinite(now.residual)) out += text(", residual %.1e", now.residual);
  out += '\n';
  if (!report.why_this_solver.empty()) {
    out += "  chosen because " + report.why_this_solver + '\n';
  }
  return out + certificate_text(report);
}

nlohmann::ordered_json to_json(const InstantReport& report) {
  const PlanarInstant& now = report.instant;
  nlohmann::ordered_json certificate = {{"worst", number(report.certificate_worst)}};
  for (int i = 0; i < Certificate::kCheckCount; ++i) {
    const auto check = static_cast<Certificate::Check>(i);
    certificate[std::string(name(check))] = number(report.certificate.entries[i].value);
  }
  certificate["force_bounds"] = {number(report.certificate.force_low),
                                 number(report.certificate.force_high)};
  nlohmann::ordered_json out = {
      {"question", report.question},
      {"solver", report.solver},
      {"why_this_solver", report.why_this_solver},
      {"status", std::string(name(now.status))},
      {"meaning", meaning_of(report)},
      {"push_force", number(now.push_force)},
      {"push_wrench", numbers(now.w_push)},
      {"object_twist", numbers(now.V_HO)},
      {"evidence", numbers(now.evidence)},
      {"other_twist", numbers(now.other)},
      {"force_interval", {number(now.force_low), number(now.force_high)}},
      {"iterations", now.iterations},
      {"residual", number(now.residual)},
      {"certificate", certificate},
      {"points", points_json(report)}};
  if (!report.sensitivities.rows.empty()) {
    out["sensitivities"] = to_json(report.sensitivities);
    out["mode_slack"] = number(report.sensitivities.mode_slack);
  }
  return out;
}

std::string describe(const RollReport& report) {
  const CrossSectionInstant& now = report.instant;
  const bool ambiguous = now.status == InstantStatus::kAmbiguous;
  std::string out = report.question + '\n';
  out += std::string(name(now.status)) + ": " + meaning(now.status) + '\n';
  if (usable(now.status) || ambiguous) {
    out += roll_motion(ambiguous ? "one motion" : "motion", now.motion());
    out += text("force of the support %.4f N, its normal part in [%.6f, %.6f] N\n",
                now.push_force, now.sheet_force_low, now.sheet_force_high);
    out += roll_forces(now.forces(), &now.mode);
  }
  if (ambiguous) {
    out += roll_motion("another motion", now.other);
    out += roll_forces(now.other_forces, nullptr);
  }
  if (now.status == InstantStatus::kDynamic) out += roll_motion("evidence", now.evidence);
  if (now.status == InstantStatus::kJammed) {
    out += "forces that balance by themselves:\n";
    out += roll_forces(now.evidence_forces, nullptr);
  }
  if (std::isfinite(report.threshold)) {
    out += text("rolls from a support friction of %.4f on\n", report.threshold);
  }
  return out + text(
                   "%d distinct motions over all mode combinations; residual of all laws "
                   "%.1e, derived separately\n",
                   now.motions_found, report.residual);
}

nlohmann::ordered_json to_json(const RollReport& report) {
  const CrossSectionInstant& now = report.instant;
  nlohmann::ordered_json contacts = nlohmann::ordered_json::array();
  for (int i = 0; i < 3; ++i) {
    contacts.push_back({{"on", kContactNames[i]},
                        {"normal_force", number(now.normal_force[i])},
                        {"tangential_force", number(now.tangential_force[i])},
                        {"mode", std::string(name(now.mode[i]))}});
  }
  return {{"question", report.question},
          {"status", std::string(name(now.status))},
          {"meaning", meaning(now.status)},
          {"push_force", number(now.push_force)},
          {"roll_rate", number(now.roll_rate)},
          {"v_z", number(now.v_z)},
          {"other_roll_rate", number(now.other.roll_rate)},
          {"support_force_interval",
           {number(now.sheet_force_low), number(now.sheet_force_high)}},
          {"threshold", number(report.threshold)},
          {"motions_found", now.motions_found},
          {"residual", number(report.residual)},
          {"contacts", contacts}};
}

}  // namespace prehensile::apps
