#include "apps/sweep.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "apps/csv.h"
#include "apps/instant_report.h"
#include "apps/parallel.h"
#include "apps/plan_report.h"
#include "apps/table.h"
#include "mechanics/solvers.h"
#include "primitives/roll.h"

namespace prehensile::apps {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr int kMostValues = 1000000;

using QueryField = std::pair<const char*, double& (*)(SweepQuestion&)>;

/// Options of the query that may be swept, under the names of their options.
constexpr std::array<QueryField, 8> kQueryFields = {{
    {"place_mm", [](SweepQuestion& q) -> double& { return q.push.place_mm; }},
    {"direction_deg", [](SweepQuestion& q) -> double& { return q.push.direction_deg; }},
    {"speed_mm_s", [](SweepQuestion& q) -> double& { return q.speed_mm_s; }},
    {"turn_deg_s", [](SweepQuestion& q) -> double& { return q.turn_deg_s; }},
    {"height_mm", [](SweepQuestion& q) -> double& { return q.height_mm; }},
    {"rise_mm_s", [](SweepQuestion& q) -> double& { return q.rise_mm_s; }},
    {"travel_mm", [](SweepQuestion& q) -> double& { return q.path.travel_mm; }},
    {"turn_deg", [](SweepQuestion& q) -> double& { return q.path.turn_deg; }},
}};

bool to_number(const std::string& text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end && std::isfinite(value);
}

/// Parts between separators outside brackets.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (c == separator && depth == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

[[noreturn]] void refuse(const std::string& option, const std::string& what) {
  throw BadInput("--over " + option + ": " + what);
}

/// from:to:count[:log]
void fill_range(const std::string& option, const std::vector<std::string>& parts,
                SweptField& field) {
  double from = 0.0, to = 0.0, count = 0.0;
  field.is_log = parts.size() == 4;
  if (parts.size() < 3 || parts.size() > 4 || !to_number(parts[0], from) ||
      !to_number(parts[1], to) || !to_number(parts[2], count) ||
      (field.is_log && parts[3] != "log")) {
    refuse(option, "expected path=from:to:count, path=from:to:count:log or a list");
  }
  if (count != std::floor(count) || count < 2.0 || count > kMostValues) {
    refuse(option, "expected a count from 2 to 1000000");
  }
  if (field.is_log && (from <= 0.0 || to <= 0.0)) {
    refuse(option, "expected both ends above 0 for log");
  }
  const int n = static_cast<int>(count);
  for (int k = 0; k < n; ++k) {
    double value = from + k * (to - from) / (count - 1.0);
    if (field.is_log) value = from * std::pow(to / from, k / (count - 1.0));
    if (k == n - 1) value = to;
    if (std::abs(value) < 1e-14 * std::abs(to - from)) value = 0.0;
    // Twelve digits: 0.3 and not 0.30000000000000004.
    to_number(text("%.12g", value), value);
    field.numbers.push_back(value);
    field.values.push_back(csv_number(value));
  }
}

SpatialTwist pusher_rate(const SweepQuestion& question, const Grasp& grasp,
                         const Vec2& e_O) {
  const Vec2 v = 1e-3 * question.speed_mm_s * rotated(grasp.X_HO.theta, e_O);
  SpatialTwist V_HP = in_space({v.x(), v.y(), kRadPerDeg * question.turn_deg_s});
  V_HP[2] = 1e-3 * question.rise_mm_s;
  return V_HP;
}

SweepRow row_of(InstantStatus status, double certificate) {
  SweepRow row;
  row.status = name(status);
  row.answered = usable(status);
  if (!row.answered) row.reason = meaning(status);
  if (row.answered && !(certificate <= 1e-6)) {
    row.answered = false;
    row.status = "uncertified";
    row.reason = text("the answer fails its certificate: %.1e", certificate);
  }
  return row;
}

SweepRow ask_instant(const Model& model, const SweepQuestion& question) {
  const int contact = chosen_contact(model, question.push);
  const Grasp grasp = chosen_grasp(model, question.push);
  const PushContact& pusher = model.contacts[contact];
  const double place = 1e-3 * question.push.place_mm;
  const SpatialTwist V_HP =
      pusher_rate(question, grasp, chosen_direction(model, contact, question.push));
  if (V_HP.isZero()) {
    throw BadInput("a pusher at rest: expected a speed or a rate of turn");
  }
  SpatialQuestionOptions how;
  if (!std::isnan(question.height_mm)) {
    const Face& face = model.faces[pusher.face];
    how.height = 1e-3 * question.height_mm;
    if (*how.height < face.z_low || *how.height > face.z_high) {
      throw BadInput("height_mm: expected a place on the object");
    }
  }
  const InstantQuestion asked = question_at(model, pusher, place, grasp.X_HO, V_HP, how);
  if (asked.falls) {
    SweepRow row = row_of(InstantStatus::kDynamic, kNan);
    row.values.assign(sweep_columns(SweepOf::kInstant).size(), kNan);
    return row;
  }
  Solver solver = solver_called(question.solver);
  if (solver == Solver::kChoose) solver = chosen_solver(asked).solver;
  if (const char* why = refusal(solver, asked)) {
    throw BadInput("solver " + std::string(name(solver)) + ": " + why);
  }
  const InstantAnswer answer = solve(asked, {.solver = solver});
  SweepRow row = row_of(answer.status, answer.certificate);
  row.values.assign(sweep_columns(SweepOf::kInstant).size(), kNan);
  if (has_motion(answer.status)) {
    const Vec2 n_H = rotated(grasp.X_HO.theta, pusher.n);
    const Vec2 force = answer.w_push.head<2>();
    row.values = {answer.push_force, force.dot(n_H), force.dot(perp(n_H)), answer.V_HO[0],
                  answer.V_HO[1],    answer.V_HO[5], answer.certificate};
  }
  return row;
}

SweepRow ask_push(const Model& model, const SweepQuestion& question) {
  const int contact = chosen_contact(model, question.push);
  const Transition end = apply(model, chosen_grasp(model, question.push),
                               chosen_push(model, contact, question.push, question.path),
                               {.tolerance = 1e-6 * question.path.tolerance_um});
  SweepRow row;
  row.answered = end.completed();
  row.status = name(end.status);
  row.reason = end.reason;
  row.values = {end.max_push_force, end.min_push_force, end.end.X_HO.x,
                end.end.X_HO.y,     end.end.X_HO.theta, end.end.psi,
                end.slipped,        end.done,           end.worst_certificate};
  return row;
}

SweepRow ask_roll(const Model& model, const SweepQuestion& question) {
  const int contact = chosen_contact(model, question.push);
  const RollSection section =
      roll_section(model, contact, chosen_grasp(model, question.push));
  SweepRow row;
  row.values.assign(sweep_columns(SweepOf::kRoll).size(), kNan);
  if (!section.possible) {
    row.status = "refused";
    row.reason = section.reason;
    return row;
  }
  const CrossSectionDrive drive{.mu = model.contacts[contact].mu,
                                .sheet_rate = 1e-3 * question.speed_mm_s,
                                .weight = section.weight};
  if (drive.sheet_rate == 0.0) {
    throw BadInput("a support at rest: expected a speed");
  }
  const CrossSectionInstant answer = solve_cross_section(*model.cross_section, drive);
  const double residual = cross_section_residual(*model.cross_section, drive, answer);
  row = row_of(answer.status, residual);
  row.values.assign(sweep_columns(SweepOf::kRoll).size(), kNan);
  row.values[0] = rolling_threshold(*model.cross_section, drive.sheet_rate, drive.weight);
  if (!has_motion(answer.status)) return row;
  row.values = {row.values[0],
                answer.roll_rate * model.cross_section->radius / drive.sheet_rate,
                answer.push_force,
                answer.normal_force[kSheet],
                answer.roll_rate,
                answer.v_z,
                residual};
  return row;
}

}  // namespace

SweptField parse_swept_field(const std::string& option) {
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0) {
    refuse(option, "expected path=from:to:count, as in gripper.grip_force=5:40:8");
  }
  SweptField field;
  field.path = option.substr(0, equals);
  field.is_of_query =
      std::any_of(kQueryFields.begin(), kQueryFields.end(),
                  [&](const QueryField& known) { return field.path == known.first; });
  const std::string values = option.substr(equals + 1);
  if (const std::vector<std::string> parts = split(values, ':'); parts.size() > 1) {
    fill_range(option, parts, field);
    return field;
  }
  field.values = split(values, ',');
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    double number = 0.0;
    if (field.values[i].empty()) refuse(option, "an empty value");
    field.is_numeric = field.is_numeric && to_number(field.values[i], number);
    field.numbers.push_back(number);
  }
  if (!field.is_numeric && field.is_of_query) refuse(option, "expected numbers");
  if (!field.is_numeric) {
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      field.numbers[i] = static_cast<double>(i);
    }
  }
  return field;
}

const std::vector<SweepColumn>& sweep_columns(SweepOf of) {
  static const std::vector<SweepColumn> kInstant = {
      {"push_force", "push force [N]"},
      {"normal_force", "normal force [N]"},
      {"tangential_force", "tangential force [N]"},
      {"v_x", "object velocity x [m/s]"},
      {"v_y", "object velocity y [m/s]"},
      {"omega", "object turning [rad/s]"},
      {"certificate", "certificate"}};
  static const std::vector<SweepColumn> kPush = {
      {"max_push_force", "greatest push force [N]"},
      {"min_push_force", "least push force [N]"},
      {"x", "end x [m]"},
      {"y", "end y [m]"},
      {"theta", "end theta [rad]"},
      {"psi", "end roll [rad]"},
      {"slipped", "slip along the pusher [m]"},
      {"done", "share of the push done"},
      {"certificate", "certificate"}};
  static const std::vector<SweepColumn> kRoll = {
      {"threshold", "least friction for rolling", true},
      {"roll_share", "share of rolling"},
      {"push_force", "push force [N]"},
      {"normal_force", "load on the support [N]"},
      {"roll_rate", "roll rate [rad/s]"},
      {"v_z", "object velocity z [m/s]"},
      {"certificate", "certificate"}};
  return of == SweepOf::kInstant ? kInstant : of == SweepOf::kPush ? kPush : kRoll;
}

SweepRow ask(const Model& model, const SweepQuestion& question) {
  switch (question.of) {
    case SweepOf::kInstant:
      return ask_instant(model, question);
    case SweepOf::kPush:
      return ask_push(model, question);
    case SweepOf::kRoll:
      return ask_roll(model, question);
  }
  return {};
}

void run_sweep(Sweep& sweep, const SceneFile& file, const SceneOptions& scene, int jobs) {
  const int count = sweep.columns() * sweep.lines();
  const bool one_scene =
      std::all_of(sweep.fields.begin(), sweep.fields.end(),
                  [](const SweptField& field) { return field.is_of_query; });
  const PrepareOptions options{.points_per_pad = sweep.question.path.points,
                               .other_grips = false};
  const std::filesystem::path folder = std::filesystem::path(scene.file).parent_path();
  std::optional<Model> model;
  if (one_scene) model = prepare(file.scene, options);
  sweep.rows.assign(static_cast<std::size_t>(count), SweepRow{});
  std::vector<std::string> faults(static_cast<std::size_t>(count));
  for_each_index(count, jobs, [&](int i) {
    SweepQuestion question = sweep.question;
    std::vector<std::string> overrides = scene.overrides;
    const std::array<int, 2> index = {i % sweep.columns(), i / sweep.columns()};
    for (std::size_t k = 0; k < sweep.fields.size(); ++k) {
      const SweptField& field = sweep.fields[k];
      if (!field.is_of_query) {
        overrides.push_back(field.path + '=' + field.values[index[k]]);
        continue;
      }
      for (const auto& [key, member] : kQueryFields) {
        if (field.path == key) member(question) = field.numbers[index[k]];
      }
    }
    SweepRow& row = sweep.rows[static_cast<std::size_t>(i)];
    try {
      row = one_scene
                ? ask(*model, question)
                : ask(prepare(parse_scene_alone(file.text, scene.file, overrides, folder),
                              options),
                      question);
    } catch (const BadInput& bad) {
      row.status = "bad input";
      row.reason = faults[static_cast<std::size_t>(i)] = bad.what();
      row.values.assign(sweep_columns(question.of).size(), kNan);
    }
  });
  const bool all_bad = std::none_of(faults.begin(), faults.end(),
                                    [](const std::string& f) { return f.empty(); });
  if (all_bad) throw BadInput(faults.front());
}

}  // namespace prehensile::apps
