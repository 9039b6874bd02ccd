#include "io/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "io/document.h"

namespace prehensile {
namespace {

using internal::Faults;
using internal::Place;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMm = 1e-3;
constexpr std::size_t kMostCells = 64;
constexpr std::size_t kLongestLine = 4096;

enum class Kind { kPush, kSlip, kBoth };

/// A column: whose it is, whether it must be there, and what its numbers may be.
struct Column {
  const char* name;
  Kind kind;
  bool required;
  double low, high;  // of the number as written; equal: words, not numbers
};

constexpr double kFarthest = 1e4;     // [mm]
constexpr double kMostTurn = 3600.0;  // [deg]
constexpr double kMostForce = 1e6;    // [N]
constexpr double kLeastForce = 1e-9;

constexpr std::array<Column, 18> kColumns = {{
    {"pusher", Kind::kPush, false, 0.0, 0.0},
    {"face", Kind::kPush, false, 0.0, 0.0},
    {"start_x_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"start_y_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"start_theta_deg", Kind::kPush, true, -kMostTurn, kMostTurn},
    {"from_x_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"from_y_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"to_x_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"to_y_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"turn_deg", Kind::kPush, false, -180.0, 180.0},
    {"end_x_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"end_y_mm", Kind::kPush, true, -kFarthest, kFarthest},
    {"end_theta_deg", Kind::kPush, true, -kMostTurn, kMostTurn},
    {"push_force_N", Kind::kPush, false, kLeastForce, kMostForce},
    {"grip_force_N", Kind::kBoth, false, kLeastForce, kMostForce},
    {"slip_force_N", Kind::kSlip, false, kLeastForce, kMostForce},
    {"slip_torque_Nm", Kind::kSlip, false, kLeastForce, kMostForce},
    {"note", Kind::kBoth, false, 0.0, 0.0},
}};

const Column* column_called(std::string_view name) {
  for (const Column& column : kColumns) {
    if (name == column.name) return &column;
  }
  return nullptr;
}

std::string trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return std::string(text);
}

/// Cells of a line, quotes taken off (RFC 4180, but a cell ends with its line).
std::vector<std::string> cells_of(std::string_view line, int number, Faults& faults) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"' && (quoted || trimmed(cells.back()).empty())) {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted) {
    faults.fail({number}, "", "a quote without its end: expected one on the same line");
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

class Reader {
 public:
  Reader(const std::string& text, const std::string& label, const Model& model)
      : rest_(internal::without_mark(text)), faults_(label), model_(model) {}

  Measurements read() {
    read_header();
    Measurements out;
    std::string line;
    while (next_line(line)) {
      if (out.size() == kMostMeasurements) {
        faults_.fail({line_}, "",
                     "more lines: expected at most " + std::to_string(kMostMeasurements));
      }
      cells_ = cells_of(line, line_, faults_);
      if (cells_.size() != columns_.size()) {
        faults_.fail({line_}, "",
                     std::to_string(cells_.size()) + " cells: expected " +
                         std::to_string(columns_.size()) + ", as in the header");
      }
      if (kind_ == Kind::kPush) {
        out.pushes.push_back(push());
      } else {
        out.readings.push_back(reading());
      }
    }
    faults_.raise();
    if (out.size() == 0) {
      faults_.fail({line_}, "", "no measurement: expected lines after the header");
    }
    return out;
  }

 private:
  /// The next line that is not empty and no comment.
  bool next_line(std::string& line) {
    while (!rest_.empty()) {
      ++line_;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      if (end > kLongestLine) {
        faults_.fail({line_}, "",
                     std::to_string(end) + " characters: expected at most " +
                         std::to_string(kLongestLine) + " in a line");
      }
      line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (!line.empty() && line[0] != '#') return true;
    }
    return false;
  }

  void read_header() {
    std::string line;
    if (!next_line(line)) {
      faults_.fail({1}, "", "empty: expected a header and lines of measurements");
    }
    const std::vector<std::string> names = cells_of(line, line_, faults_);
    if (names.size() > kMostCells) {
      faults_.fail({line_}, "",
                   std::to_string(names.size()) + " columns: expected at most " +
                       std::to_string(kMostCells));
    }
    for (const std::string& name : names) {
      const Column* column = column_called(name);
      if (!column) {
        faults_.fail({line_}, internal::shown(name),
                     "unknown column: expected " + known_columns());
      }
      if (std::find(columns_.begin(), columns_.end(), column) != columns_.end()) {
        faults_.fail({line_}, name, "column twice: expected once");
      }
      columns_.push_back(column);
    }
    decide_kind();
  }

  bool has(const char* name) const {
    return std::find(columns_.begin(), columns_.end(), column_called(name)) !=
           columns_.end();
  }

  void decide_kind() {
    const bool slips = has("slip_force_N") || has("slip_torque_Nm");
    kind_ = slips ? Kind::kSlip : Kind::kPush;
    for (const Column* column : columns_) {
      if (slips && column->kind == Kind::kPush) {
        faults_.fail({line_}, column->name,
                     "column of pushes beside one of slip forces: expected either");
      }
    }
    for (const Column& column : kColumns) {
      const bool required =
          slips ? std::string_view(column.name) == "grip_force_N" : column.required;
      if (required && !has(column.name)) {
        faults_.fail({line_}, column.name, "column missing: expected it in the header");
      }
    }
    if (!slips && !has("pusher") && model_.scene.pushers.size() != 1) {
      faults_.fail({line_}, "pusher",
                   "column missing: expected it, for the scene has " +
                       std::to_string(model_.scene.pushers.size()) + " pushers");
    }
  }

  static std::string known_columns() {
    std::string out;
    for (const Column& column : kColumns) {
      out += out.empty() ? "" : ", ";
      out += column.name;
    }
    return out;
  }

  const std::string* cell(const char* name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (std::string_view(columns_[i]->name) == name) return &cells_[i];
    }
    return nullptr;
  }

  void refuse(const char* name, const std::string& found, const std::string& expected) {
    std::string what = found.empty() ? "empty" : internal::shown(found);
    faults_.add({line_}, name, what += ": expected " + expected);
  }

  std::optional<double> optional_number(const char* name) {
    const std::string* found = cell(name);
    if (!found || found->empty()) return std::nullopt;
    return number(name);
  }

  double number(const char* name) {
    const Column& column = *column_called(name);
    const std::string* found = cell(name);
    double value = 0.0;
    if (!internal::to_number(*found, value) || value < column.low ||
        value > column.high) {
      refuse(name, *found,
             "a number from " + internal::number_text(column.low) + " to " +
                 internal::number_text(column.high));
      return 0.0;
    }
    return value;
  }

  PlanarPose pose(const char* x, const char* y, const char* theta) {
    return {kMm * number(x), kMm * number(y), kDegree * number(theta)};
  }

  int pusher() {
    const std::string* found = cell("pusher");
    if (!found) return 0;
    std::string known;
    const std::vector<Pusher>& pushers = model_.scene.pushers;
    for (std::size_t i = 0; i < pushers.size(); ++i) {
      if (pushers[i].name == *found) return static_cast<int>(i);
      known += known.empty() ? "" : ", ";
      known += pushers[i].name;
    }
    refuse("pusher", *found, "one of " + internal::shown(known));
    return 0;
  }

  int face(int pusher) {
    const std::string* found = cell("face");
    if (!found || found->empty()) return -1;
    std::string known;
    for (const PushContact& contact : model_.contacts) {
      if (contact.pusher != pusher) continue;
      const std::string& name = model_.faces[contact.face].name;
      if (name == *found) return contact.face;
      known += known.empty() ? "" : ", ";
      known += name;
    }
    refuse("face", *found, "a face that the pusher may touch: " + internal::shown(known));
    return -1;
  }

  MeasuredPush push() {
    MeasuredPush out;
    out.pusher = pusher();
    out.face = face(out.pusher);
    out.X_HO_start = pose("start_x_mm", "start_y_mm", "start_theta_deg");
    out.from = kMm * Vec2(number("from_x_mm"), number("from_y_mm"));
    out.to = kMm * Vec2(number("to_x_mm"), number("to_y_mm"));
    if (out.from == out.to) {
      faults_.add({line_}, "to_x_mm",
                  "the place that the pusher comes from: expected a path");
    }
    out.turn = kDegree * optional_number("turn_deg").value_or(0.0);
    out.X_HO_end = pose("end_x_mm", "end_y_mm", "end_theta_deg");
    out.push_force = optional_number("push_force_N");
    out.grip_force = optional_number("grip_force_N");
    return out;
  }

  SlipReading reading() {
    SlipReading out;
    out.grip_force = number("grip_force_N");
    out.slip_force = optional_number("slip_force_N");
    out.slip_torque = optional_number("slip_torque_Nm");
    if (!out.slip_force && !out.slip_torque) {
      faults_.add({line_}, "", "no force and no torque: expected one of them at least");
    }
    return out;
  }

  std::string_view rest_;
  Faults faults_;
  const Model& model_;
  int line_ = 0;
  Kind kind_ = Kind::kPush;
  std::vector<const Column*> columns_;
  std::vector<std::string> cells_;
};

std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

}  // namespace

Measurements parse_measurements(const std::string& text, const std::string& label,
                                const Model& model) {
  Faults faults(label);
  if (text.size() > kLargestMeasurements) {
    faults.fail({}, "",
                std::to_string(text.size()) + " bytes: expected at most " +
                    std::to_string(kLargestMeasurements) + " bytes");
  }
  internal::check_characters(text, faults);
  faults.raise();
  return Reader(text, label, model).read();
}

Measurements read_measurements(const std::filesystem::path& file, const Model& model) {
  return parse_measurements(internal::read_text(file, kLargestMeasurements),
                            file.string(), model);
}

std::string pushes_to_csv(const std::vector<MeasuredPush>& pushes, const Model& model,
                          int decimals) {
  bool turns = false, forces = false, grips = false;
  for (const MeasuredPush& push : pushes) {
    turns = turns || push.turn != 0.0;
    forces = forces || push.push_force.has_value();
    grips = grips || push.grip_force.has_value();
  }
  std::string out =
      "pusher,start_x_mm,start_y_mm,start_theta_deg,from_x_mm,from_y_mm,to_x_mm,to_y_mm,"
      "end_x_mm,end_y_mm,end_theta_deg";
  out += turns ? ",turn_deg" : "";
  out += forces ? ",push_force_N" : "";
  out += grips ? ",grip_force_N" : "";
  out += '\n';
  for (const MeasuredPush& push : pushes) {
    std::string name = model.scene.pushers[static_cast<std::size_t>(push.pusher)].name;
    if (name.find_first_of(",\"") != std::string::npos) {
      for (std::size_t i = 0; (i = name.find('"', i)) != std::string::npos; i += 2) {
        name.insert(i, 1, '"');
      }
      name = '"' + name + '"';
    }
    out += name;
    const auto add = [&](double value) { out += ',' + fixed(value, decimals); };
    const auto add_pose = [&](const PlanarPose& pose) {
      add(pose.x / kMm);
      add(pose.y / kMm);
      add(pose.theta / kDegree);
    };
    add_pose(push.X_HO_start);
    for (const Vec2& p : {push.from, push.to}) {
      add(p.x() / kMm);
      add(p.y() / kMm);
    }
    add_pose(push.X_HO_end);
    if (turns) add(push.turn / kDegree);
    const auto add_if_set = [&](const std::optional<double>& value) {
      out += ',';
      if (value) out += fixed(*value, decimals);
    };
    if (forces) add_if_set(push.push_force);
    if (grips) add_if_set(push.grip_force);
    out += '\n';
  }
  return out;
}

}  // namespace prehensile
