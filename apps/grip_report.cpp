#include "apps/grip_report.h"

#include <cmath>
#include <limits>

#include "apps/json_number.h"
#include "apps/plan_report.h"
#include "apps/table.h"

namespace prehensile::apps {
namespace {

/// What a push with a grip force beyond the range does instead.
std::string failure(const GripEnd& end) {
  const Transition& push = end.outside;
  std::string out = text("with %.6g N: ", end.beyond) + std::string(name(push.status));
  if (!push.completed()) {
    return out + text(" after %.1f %% (", 100.0 * push.done) + std::string(push.reason) +
           ')';
  }
  return out + text(", %.3g mm off", to_mm(end.strayed));
}

std::string end_text(const char* which, const GripEnd& end) {
  std::string out = which + text(" grip force %.6g N", end.force);
  out += end.is_open ? " (end of the search)" : "; " + failure(end);
  return out + '\n';
}

std::string force(double value) {
  if (std::isnan(value)) return "-";
  if (value == std::numeric_limits<double>::infinity()) return "any";
  if (value == -std::numeric_limits<double>::infinity()) return "none";
  return text("%.4f", value);
}

/// With which grip forces the pusher sticks, where two numbers do not say it.
const char* sticks(const GripSample& sample) {
  if (std::isnan(sample.stick_low))
    return "unknown: a point, or no motion of the flush contact";
  if (!(sample.stick_low <= sample.stick_high)) return "never";
  return std::isfinite(sample.stick_high) ? "from stick_low to stick_high"
                                          : "from stick_low on";
}

nlohmann::ordered_json end_json(const GripEnd& end) {
  nlohmann::ordered_json out = {{"force", number(end.force)},
                                {"open", end.is_open},
                                {"push_force", number(end.inside.max_push_force)},
                                {"certificate", number(end.inside.worst_certificate)}};
  if (end.is_open) return out;
  out["beyond"] = {{"force", number(end.beyond)},
                   {"status", std::string(name(end.outside.status))},
                   {"reason", std::string(end.outside.reason)},
                   {"done", number(end.outside.done)},
                   {"off_nominal", number(end.strayed)}};
  return out;
}

}  // namespace

std::string grip_text(const Model& model, const GripRange& range) {
  std::string out;
  if (range.in_space) out += "by spatial instants: the push needs space\n";
  if (!range.found) out += std::string(range.reason) + '\n';
  if (range.found) {
    out += end_text("least", range.low) + end_text("greatest", range.high);
  }
  out += text("to hold the object alone: %.6g N before the push, ", range.hold_start) +
         text("%.6g N after it\n", range.hold_end);
  if (!range.profile.empty()) {
    out += "nominal end: " + pose_text(model, {range.nominal, 0.0}) + '\n';
    Table table({"done %", "hold N", "stick from N", "to N"});
    for (const GripSample& sample : range.profile) {
      table.add({text("%.1f", 100.0 * sample.s), force(sample.hold),
                 force(sample.stick_low), force(sample.stick_high)});
    }
    out += table.str();
  }
  return out;
}

nlohmann::ordered_json grip_json(const GripRange& range) {
  nlohmann::ordered_json out = {{"found", range.found},
                                {"reason", std::string(range.reason)},
                                {"in_space", range.in_space},
                                {"nominal",
                                 {{"x", number(range.nominal.x)},
                                  {"y", number(range.nominal.y)},
                                  {"theta", number(range.nominal.theta)}}},
                                {"hold_start", number(range.hold_start)},
                                {"hold_end", number(range.hold_end)}};
  if (range.found) {
    out["least"] = end_json(range.low);
    out["greatest"] = end_json(range.high);
  }
  out["profile"] = nlohmann::ordered_json::array();
  for (const GripSample& sample : range.profile) {
    out["profile"].push_back({{"done", number(sample.s)},
                              {"hold", number(sample.hold)},
                              {"sticks", sticks(sample)},
                              {"stick_low", number(sample.stick_low)},
                              {"stick_high", number(sample.stick_high)}});
  }
  return out;
}

}  // namespace prehensile::apps
