#include "apps/spatial_report.h"

#include "apps/instant_report.h"
#include "apps/json_number.h"
#include "apps/table.h"

namespace prehensile::apps {
namespace {

const char* name_of(ContactBody body) {
  switch (body) {
    case ContactBody::kJaw1:
      return "jaw 1";
    case ContactBody::kJaw2:
      return "jaw 2";
    case ContactBody::kPusher:
      return "pusher";
  }
  return "";
}

/// Force of a point on the object, in H.
Vec3 force_of(const ContactPatch& patch, const SpatialPoint& point) {
  return point.normal_force * patch.n + point.tangential_force.x() * patch.t +
         point.tangential_force.y() * patch.o();
}

std::string twist_text(const char* what, const SpatialTwist& V) {
  return text(
      "%s: (%.4f, %.4f, %.4f) mm/s at the finger axis, turning (%.4f, %.4f, %.4f) "
      "deg/s\n",
      what, to_mm(V[0]), to_mm(V[1]), to_mm(V[2]), to_deg(V[3]), to_deg(V[4]),
      to_deg(V[5]));
}

std::string point_table(const SpatialReport& report) {
  Table table({"point", "on", "x mm", "y mm", "z mm", "normal N", "friction N",
               "force x N", "force y N", "force z N", "gap rate mm/s", "slip mm/s",
               "mode"});
  for (int p = 0; p < report.problem.patch_count; ++p) {
    const ContactPatch& patch = report.problem.patch[p];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = report.instant.point[i];
      const Vec3 place = report.problem.p_HC(i);
      const Vec3 force = force_of(patch, point);
      table.add(
          {text("%d", i + 1), name_of(patch.body), text("%.2f", to_mm(place.x())),
           text("%.2f", to_mm(place.y())), text("%.2f", to_mm(place.z())),
           text("%.4f", point.normal_force), text("%.4f", point.tangential_force.norm()),
           text("%.4f", force.x()), text("%.4f", force.y()), text("%.4f", force.z()),
           text("%.4f", to_mm(point.normal_rate)),
           text("%.4f", to_mm(point.slip_rate.norm())), std::string(name(point.mode))});
    }
  }
  return table.str();
}

/// What decides the answer: how many points of each body do what.
std::string modes_in_words(const SpatialReport& report) {
  std::string out;
  for (int p = 0; p < report.problem.patch_count; ++p) {
    const ContactPatch& patch = report.problem.patch[p];
    int stick = 0;
    int slip = 0;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const ContactMode mode = report.instant.point[i].mode;
      if (mode == ContactMode::kStick) ++stick;
      if (mode != ContactMode::kStick && mode != ContactMode::kOpen) ++slip;
    }
    out +=
        text("%s%s: %d of %d points slip, %d stick, %d open", p == 0 ? "" : "; ",
             name_of(patch.body), slip, patch.count, stick, patch.count - slip - stick);
  }
  return out + '\n';
}

std::string certificate_text(const SpatialCertificate& certificate) {
  std::string out = text(
      "certificate: worst %.1e (units of force, rate and length of the problem; accepted "
      "up to 1e-06)\n",
      certificate.worst);
  for (int i = 0; i < SpatialCertificate::kCheckCount; ++i) {
    const double value = certificate.entries[i].value;
    if (!std::isfinite(value)) continue;
    out +=
        text("  %-16s %.1e\n",
             std::string(name(static_cast<SpatialCertificate::Check>(i))).c_str(), value);
  }
  return out;
}

/// Of a spatial instant less is known than of a planar one: it is certified, but other
/// motions are not searched for.
const char* meaning_in_space(const SpatialReport& report) {
  const InstantStatus status = report.instant.status;
  if (status == InstantStatus::kMoves && report.probed) {
    return "the grasp breaks and the object moves, while the pads alone hold gravity; "
           "from other starts no other motion was found";
  }
  if (status == InstantStatus::kMoves) {
    return "the grasp breaks and the object moves, while the pads alone hold gravity; "
           "other motions are not searched for";
  }
  if (status == InstantStatus::kDynamic) {
    return "the object falls: the motion shown is certified, that nothing else is "
           "possible "
           "is not proved";
  }
  return meaning(status);
}

nlohmann::ordered_json points_json(const SpatialReport& report) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (int p = 0; p < report.problem.patch_count; ++p) {
    const ContactPatch& patch = report.problem.patch[p];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = report.instant.point[i];
      points.push_back({{"on", name_of(patch.body)},
                        {"position", numbers(report.problem.p_HC(i))},
                        {"normal_force", number(point.normal_force)},
                        {"force", numbers(force_of(patch, point))},
                        {"normal_rate", number(point.normal_rate)},
                        {"slip_rate", numbers(point.slip_rate)},
                        {"mode", std::string(name(point.mode))}});
    }
  }
  return points;
}

}  // namespace

std::string describe(const SpatialReport& report) {
  const SpatialInstant& now = report.instant;
  std::string out = report.question + '\n';
  out += std::string(name(now.status)) + ": " + meaning_in_space(report) + '\n';
  if (usable(now.status)) {
    out += text(
        "push force %.6g N: (%.4f, %.4f, %.4f) N on the object, moment (%.4f, %.4f, "
        "%.4f) "
        "N mm about the finger axis\n",
        now.push_force, now.w_push[0], now.w_push[1], now.w_push[2], 1e3 * now.w_push[3],
        1e3 * now.w_push[4], 1e3 * now.w_push[5]);
    out += twist_text("object twist", now.V_HO);
    out += text("jaws closing at %.4f, %.4f mm/s\n", to_mm(now.jaw_rate[0]),
                to_mm(now.jaw_rate[1]));
    if (now.status == InstantStatus::kNonuniqueForces) {
      out +=
          text("normal force of the pusher anywhere in [%.4f, %.4f] N, as far as known\n",
               now.force_low, now.force_high);
    }
  } else if (now.evidence.allFinite()) {
    out += twist_text("evidence", now.evidence.head<6>());
  }
  if (now.status == InstantStatus::kAmbiguous && now.other.allFinite()) {
    out += twist_text("other motion", now.other.head<6>());
  }
  if (usable(now.status)) out += modes_in_words(report) + point_table(report);
  out += describe(report.sensitivities);
  out += text("solver spatial: %d Newton steps, residual %.1e\n", now.iterations,
              now.residual);
  if (!report.why_this_solver.empty()) {
    out += "  chosen because " + report.why_this_solver + '\n';
  }
  return out + certificate_text(report.certificate);
}

nlohmann::ordered_json to_json(const SpatialReport& report) {
  const SpatialInstant& now = report.instant;
  nlohmann::ordered_json certificate = {{"worst", number(report.certificate.worst)}};
  for (int i = 0; i < SpatialCertificate::kCheckCount; ++i) {
    const auto check = static_cast<SpatialCertificate::Check>(i);
    certificate[std::string(name(check))] = number(report.certificate.entries[i].value);
  }
  nlohmann::ordered_json out = {
      {"question", report.question},
      {"solver", "spatial"},
      {"why_this_solver", report.why_this_solver},
      {"status", std::string(name(now.status))},
      {"meaning", meaning_in_space(report)},
      {"push_force", number(now.push_force)},
      {"push_wrench", numbers(now.w_push)},
      {"object_twist", numbers(now.V_HO)},
      {"jaw_rates", {number(now.jaw_rate[0]), number(now.jaw_rate[1])}},
      {"evidence", numbers(now.evidence)},
      {"other_twist", numbers(now.other)},
      {"force_interval", {number(now.force_low), number(now.force_high)}},
      {"iterations", now.iterations},
      {"residual", number(now.residual)},
      {"certificate", certificate},
      {"points",
       usable(now.status) ? points_json(report) : nlohmann::ordered_json::array()}};
  if (!report.sensitivities.rows.empty()) {
    out["sensitivities"] = to_json(report.sensitivities);
    out["mode_slack"] = number(report.sensitivities.mode_slack);
  }
  return out;
}

}  // namespace prehensile::apps
