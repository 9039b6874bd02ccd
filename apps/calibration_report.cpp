#include "apps/calibration_report.h"

#include <cmath>

#include "apps/json_number.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"

namespace prehensile::apps {
namespace {

struct ShownPart {
  const char* key;
  const char* title;
  double factor;
};

constexpr ShownPart kPushParts[] = {{"along", "along mm", 1e3},
                                    {"across", "across mm", 1e3},
                                    {"angle", "angle deg", 57.29577951308232},
                                    {"force", "force %", 100.0}};
constexpr ShownPart kSlipParts[] = {{"force", "force %", 100.0},
                                    {"torque", "torque %", 100.0}};

const ShownPart& shown_part(const CalibratedSetup& setup, int part) {
  return setup.is_of_pushes() ? kPushParts[part] : kSlipParts[part];
}

std::string interval_text(const FitInterval& interval, double factor) {
  return text("%s%.4g to %.4g%s", interval.open_low ? "<= " : "", factor * interval.low,
              factor * interval.high, interval.open_high ? " <=" : "");
}

std::string parameters_text(const CalibratedSetup& setup) {
  Table table({"parameter", "before", "calibrated",
               text("%g %% interval", 100.0 * setup.options.level), "known before", ""});
  for (std::size_t j = 0; j < setup.fit.targets.size(); ++j) {
    const CalibratedParameter& parameter = setup.calibration.parameters[j];
    const FitParameter& it = setup.fit.problem.parameters[j];
    const ShownUnit shown = shown_unit(setup.fit.targets[j].target);
    table.add(
        {it.name, text("%.4g", shown.factor * it.start),
         text("%.4g", shown.factor * parameter.value),
         interval_text(parameter.profile.interval, shown.factor),
         text("±%.4g", shown.factor * it.known),
         parameter.told ? shown.unit : std::string(shown.unit) + " not told: kept"});
  }
  return table.str();
}

std::string errors_text(const CalibratedSetup& setup) {
  std::vector<std::string> header = {"mean absolute error"};
  std::vector<int> parts;
  for (int part = 0; part < setup.fit.problem.parts(); ++part) {
    if (std::isnan(mean_error(setup.calibration.before, part))) continue;
    parts.push_back(part);
    header.push_back(shown_part(setup, part).title);
  }
  Table table(header);
  const auto add = [&](const char* name, const Eigen::MatrixXd& residuals) {
    std::vector<std::string> row = {name};
    for (const int part : parts) {
      row.push_back(
          text("%.3f", shown_part(setup, part).factor * mean_error(residuals, part)));
    }
    table.add(row);
  };
  add("scene as it was", setup.calibration.before);
  add("held out", setup.calibration.held_out);
  add("fitted to all", setup.calibration.after);
  return table.str();
}

std::string pressure_text(const CalibratedSetup& setup) {
  if (!(setup.c_after > 0.0)) return {};
  const char* word = setup.k < 0.8   ? ": borne by the middle of the pads"
                     : setup.k > 1.2 ? ": borne by the rim of the pads"
                                     : "";
  return text(
             "torque radius %.3f mm, was %.3f mm; k = %.2f times that of these pads "
             "under uniform pressure",
             to_mm(setup.c_after), to_mm(setup.c_before), setup.k) +
         word + '\n';
}

std::string intervals_text(const CalibratedSetup& setup) {
  const CalibrationRecord& record = *setup.after.calibration;
  if (!setup.is_of_pushes()) return {};
  std::string out = "left uncertain (90 %): " + box_text(box_of(record)) + '\n';
  if (!record.factors_90) return out;
  const Vec3& f = *record.factors_90;
  out += text(
      "90 %% intervals of the end pose cover with the factors %.2f, %.2f, %.2f "
      "(normal, tangential, angle),\nlearnt on %d of these pushes, each in the "
      "fit that did not see it: `query spread` uses them\n",
      f[0], f[1], f[2], setup.scored);
  return out;
}

}  // namespace

ShownUnit shown_unit(Target target) {
  const bool is_place =
      target == Target::kRegistrationX || target == Target::kRegistrationY;
  if (is_place) return {1e3, "mm"};
  return {1.0, target == Target::kForceBias ? "N" : ""};
}

std::string worth_of(const CalibratedSetup& setup) {
  const std::size_t count = setup.data.size();
  if (!setup.is_of_pushes()) return text("%zu readings", count);
  std::string out = text("%zu pushes: ", count);
  out += count < kWeakCalibration   ? "not a calibration"
         : count < kRealCalibration ? "a weak calibration"
                                    : "a real calibration";
  return out + text(" (%d are a real one, 5 are not)", kRealCalibration);
}

std::string describe(const CalibratedSetup& setup) {
  std::string out = worth_of(setup) + '\n';
  out += parameters_text(setup) + pressure_text(setup);
  out += errors_text(setup);
  out +=
      text("held out: each predicted by a fit without its fold, %zu folds, seed %llu\n",
           setup.calibration.fold_at.size(),
           static_cast<unsigned long long>(setup.options.seed));
  out += intervals_text(setup);
  for (const std::string& warning : setup.warnings) out += "warning: " + warning + '\n';
  return out;
}

nlohmann::ordered_json to_json(const CalibratedSetup& setup) {
  using nlohmann::ordered_json;
  const CalibrationRecord& record = *setup.after.calibration;
  ordered_json out = {{"data", record.data},
                      {"measurements", setup.data.size()},
                      {"kind", setup.is_of_pushes() ? "pushes" : "slip readings"},
                      {"worth", worth_of(setup)},
                      {"usable", setup.is_usable()},
                      {"level", number(setup.options.level)},
                      {"parameters", ordered_json::array()}};
  for (std::size_t j = 0; j < setup.fit.targets.size(); ++j) {
    const CalibratedParameter& parameter = setup.calibration.parameters[j];
    const FitParameter& it = setup.fit.problem.parameters[j];
    const FitInterval& interval = parameter.profile.interval;
    ordered_json profile = ordered_json::array();
    for (const ProfilePoint& point : parameter.profile.points) {
      profile.push_back({number(point.value), number(point.rise)});
    }
    out["parameters"].push_back(
        {{"name", it.name},
         {"before", number(it.start)},
         {"value", number(parameter.value)},
         {"told", parameter.told},
         {"low", number(interval.low)},
         {"high", number(interval.high)},
         {"open_low", interval.open_low},
         {"open_high", interval.open_high},
         {"known_before", number(it.known)},
         {"exchangeable_with",
          parameter.confused_with < 0
              ? ordered_json(nullptr)
              : ordered_json(
                    setup.fit.problem
                        .parameters[static_cast<std::size_t>(parameter.confused_with)]
                        .name)},
         {"profile_limit", number(parameter.profile.limit)},
         {"profile", profile}});
  }
  out["torque_radius"] = {{"before", number(setup.c_before)},
                          {"after", number(setup.c_after)},
                          {"k", number(setup.k)}};
  out["mean_absolute_error"] = ordered_json::object();
  for (int part = 0; part < setup.fit.problem.parts(); ++part) {
    out["mean_absolute_error"][shown_part(setup, part).key] = {
        {"before", number(mean_error(setup.calibration.before, part))},
        {"held_out", number(mean_error(setup.calibration.held_out, part))},
        {"fitted", number(mean_error(setup.calibration.after, part))},
        {"scatter", number(setup.calibration.fit.scale[static_cast<std::size_t>(part)])}};
  }
  out["held_out"] = {{"folds", setup.calibration.fold_at.size()},
                     {"seed", setup.options.seed}};
  if (setup.is_of_pushes()) {
    out["left_uncertain"] = to_json(box_of(record));
    out["factors"] = {{"pushes", setup.scored}, {"50", nullptr}, {"90", nullptr}};
    if (record.factors_50) out["factors"]["50"] = numbers(*record.factors_50);
    if (record.factors_90) out["factors"]["90"] = numbers(*record.factors_90);
  }
  out["warnings"] = setup.warnings;
  return out;
}

}  // namespace prehensile::apps
