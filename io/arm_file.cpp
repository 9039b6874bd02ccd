#include "io/arm_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/document.h"

namespace prehensile {
namespace {

using internal::number_text;

constexpr std::size_t kLargestArm = 64u << 20;  // [bytes]
constexpr double kUnitTolerance = 1e-6;

constexpr std::array<ArmPhase, 5> kPhases = {ArmPhase::kTransit, ArmPhase::kApproach,
                                             ArmPhase::kGrip, ArmPhase::kPush,
                                             ArmPhase::kRetreat};

constexpr const char* kColumns =
    "t,phase,push,grip_force,hand_x,hand_y,hand_z,hand_qx,hand_qy,hand_qz,hand_qw,"
    "tool_x,tool_y,tool_z,tool_qx,tool_qy,tool_qz,tool_qw,force_x,force_y,force_z,"
    "moment_x,moment_y,moment_z,guard_force";
constexpr std::size_t kColumnCount = 25;

/// -0 is written as 0, so that files do not depend on how a zero came about; and readers
/// of YAML 1.1 take 5e-04 without a point for a text.
std::string number(double value) {
  std::string text = number_text(value == 0.0 ? 0.0 : value);
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) {
    text.insert(exponent, ".0");
  }
  return text;
}

std::string joined(std::initializer_list<double> values, const char* separator) {
  std::string out;
  for (const double value : values) {
    if (!out.empty()) out += separator;
    out += number(value);
  }
  return out;
}

std::string pose(const ArmPose& X, const char* separator) {
  const Eigen::Quaterniond& q = X.orientation;
  return joined(
      {X.position.x(), X.position.y(), X.position.z(), q.x(), q.y(), q.z(), q.w()},
      separator);
}

/// Quoted where YAML needs it, one line.
std::string yaml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out += '"';
}

struct Note {
  std::string key, value;
};

/// Under the names of plan files: shares, [m] and [rad].
std::string margin_text(const Margin& margin) {
  std::string out = "{friction: " + number(margin.friction);
  out += ", force: " + number(margin.force);
  out += ", torque_radius: " + number(margin.torque_radius);
  out += ", place: " + number(margin.place);
  out += ", centre_of_mass: " + number(margin.centre_of_mass);
  out += ", grasp: " + number(margin.grasp);
  out += ", tilt: " + number(margin.tilt);
  if (margin.weightless) out += ", gravity: must not help";
  return out + "}";
}

/// What the plan says of itself, which a robot cannot find in the samples.
void add_promise(const Plan& plan, std::vector<Note>& notes) {
  notes.push_back({"promise", yaml_text(std::string(name(plan.promise)))});
  notes.push_back({"margin", margin_text(plan.margin)});
  if (!plan.message.empty()) notes.push_back({"message", yaml_text(plan.message)});
}

std::vector<Note> notes_of(const PlanFile& file, const ArmMotion& motion,
                           const ArmLimits& limits) {
  const Model model = prepare(file.scene);
  const ToolTransform& tool = file.scene.gripper.tool;
  const auto list = [](const std::string& inside) { return "[" + inside + "]"; };
  std::vector<Note> notes = {
      {"format", "prehensile arm motion"},
      {"version", "1"},
      {"scene", yaml_text(file.scene.name)},
      {"scene_digest", yaml_text(file.scene_digest)},
      {"gripper", yaml_text(file.scene.gripper.name)},
      {"world", yaml_text("W is fixed to the pushers as in the scene; z is the closing "
                          "direction of the gripper, the object's mid-plane is z = 0")},
      {"hand",
       yaml_text("X_WH: frame H at the middle of the pads, z from jaw 1 to jaw 2")},
      {"tool", yaml_text("X_WT = X_WH * X_HT: the robot's tool frame")},
      {"tool_in_hand_position",
       list(joined({tool.p_HT.x(), tool.p_HT.y(), tool.p_HT.z()}, ", "))},
      {"tool_in_hand_quaternion_xyzw",
       list(joined({tool.q_HT[0], tool.q_HT[1], tool.q_HT[2], tool.q_HT[3]}, ", "))},
      {"quaternion_order", "xyzw"},
      {"units", yaml_text("m, s, N, N m")},
      {"interpolation",
       yaml_text("follow the samples; between those of a push, straight in the frame of "
                 "the pusher, which stands still in W")},
      {"load",
       yaml_text("force and moment on the tool by the object, in T about its "
                 "origin: push and weight of the object, not of the gripper; stop "
                 "where the force exceeds guard_force")},
      {"push_speed", number(limits.push_speed)},
      {"approach_speed", number(limits.approach_speed)},
      {"transit_speed", number(limits.transit_speed)},
      {"acceleration", number(limits.acceleration)},
      {"turn_speed", number(limits.turn_speed)},
      {"turn_acceleration", number(limits.turn_acceleration)},
      {"clearance", number(limits.clearance)}};
  add_promise(file.plan, notes);
  for (std::size_t i = 0; i < file.plan.pushes.size(); ++i) {
    const auto contact = static_cast<std::size_t>(contact_of(file.plan.pushes[i].push));
    const PushContact& touched = model.contacts.at(contact);
    std::string key = "push_";
    key += std::to_string(i + 1);
    std::string value =
        model.scene.pushers[static_cast<std::size_t>(touched.pusher)].name;
    value += " on ";
    value += model.faces[static_cast<std::size_t>(touched.face)].name;
    notes.push_back({std::move(key), yaml_text(value)});
  }
  for (const int push : motion.blocked_transits) {
    notes.push_back(
        {"transit_to_push_" + std::to_string(push + 1),
         yaml_text("straight, and not allowed: no way was found that is clear of "
                   "obstacles, within limits, and on which the grasp holds "
                   "the object")});
  }
  return notes;
}

std::string comments(const std::vector<Note>& notes) {
  std::string out;
  for (const Note& note : notes) {
    out += "# ";
    out += note.key + ": " + note.value + '\n';
  }
  return out;
}

std::string to_csv(const std::vector<Note>& notes, const ArmMotion& motion) {
  std::string out = comments(notes) + kColumns + '\n';
  for (const ArmSample& sample : motion.samples) {
    out +=
        number(sample.t) + ',' + std::string(name(sample.phase)) + ',' +
        std::to_string(sample.push + 1) + ',' + number(sample.grip_force) + ',' +
        pose(sample.X_WH, ",") + ',' + pose(sample.X_WT, ",") + ',' +
        joined({sample.force.x(), sample.force.y(), sample.force.z(), sample.moment.x(),
                sample.moment.y(), sample.moment.z(), sample.guard_force},
               ",") +
        '\n';
  }
  return out;
}

std::string to_tum(const std::vector<Note>& notes, const ArmMotion& motion) {
  std::string out = comments(notes);
  out += "# columns: t x y z qx qy qz qw of the tool in W\n";
  double last = -1.0;
  for (const ArmSample& sample : motion.samples) {
    if (sample.t == last) continue;
    last = sample.t;
    out += number(sample.t) + ' ' + pose(sample.X_WT, " ") + '\n';
  }
  return out;
}

std::string yaml_pose(const ArmPose& X) {
  const Eigen::Quaterniond& q = X.orientation;
  return "{position: [" + joined({X.position.x(), X.position.y(), X.position.z()}, ", ") +
         "], quaternion_xyzw: [" + joined({q.x(), q.y(), q.z(), q.w()}, ", ") + "]}";
}

std::string to_yaml(const std::vector<Note>& notes, const ArmMotion& motion) {
  std::string out;
  for (const Note& note : notes) {
    out += note.key;
    out += ": " + note.value + '\n';
  }
  out += motion.samples.empty() ? "samples: []\n" : "samples:\n";
  for (const ArmSample& sample : motion.samples) {
    const Vec3& f = sample.force;
    const Vec3& m = sample.moment;
    out += "- {t: " + number(sample.t) + ", phase: " + std::string(name(sample.phase)) +
           ", push: " + std::to_string(sample.push + 1) +
           ", grip_force: " + number(sample.grip_force) +
           ", hand: " + yaml_pose(sample.X_WH) + ", tool: " + yaml_pose(sample.X_WT) +
           ", force: [" + joined({f.x(), f.y(), f.z()}, ", ") + "], moment: [" +
           joined({m.x(), m.y(), m.z()}, ", ") +
           "], guard_force: " + number(sample.guard_force) + "}\n";
  }
  return out;
}

/// Takes the lines of a CSV file apart, with its faults.
class CsvReader {
 public:
  CsvReader(const std::string& text, std::string label)
      : text_(internal::without_mark(text)), label_(std::move(label)) {}

  ArmMotion read() {
    ArmMotion motion;
    bool has_columns = false;
    std::string line;
    while (next(line)) {
      if (line.empty() || line[0] == '#') continue;
      if (!has_columns) {
        if (line != kColumns) refuse("expected the columns " + std::string(kColumns));
        has_columns = true;
        continue;
      }
      ArmSample sample = read_sample(line);
      if (!motion.samples.empty() && sample.t < motion.samples.back().t) {
        refuse("t: " + number(sample.t) + ": expected a time that does not fall");
      }
      motion.samples.push_back(sample);
    }
    if (!has_columns) refuse("no samples: expected the columns " + std::string(kColumns));
    if (!motion.samples.empty()) motion.seconds = motion.samples.back().t;
    return motion;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw BadInput(label_ + ": line " + std::to_string(line_) + ": " + what);
  }

  bool next(std::string& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = std::string(text_.substr(at_, end - at_));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at_ = end + 1;
    ++line_;
    return true;
  }

  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t from = 0; from <= line.size();) {
      const std::size_t comma = std::min(line.find(',', from), line.size());
      cells.push_back(line.substr(from, comma - from));
      from = comma + 1;
    }
    return cells;
  }

  ArmSample read_sample(const std::string& line) {
    cells_ = split(line);
    if (cells_.size() != kColumnCount) {
      refuse(std::to_string(cells_.size()) + " cells: expected " +
             std::to_string(kColumnCount));
    }
    ArmSample sample;
    sample.t = number_at(0);
    const auto* phase = std::find_if(kPhases.begin(), kPhases.end(),
                                     [&](ArmPhase p) { return cells_[1] == name(p); });
    if (phase == kPhases.end()) {
      refuse("phase: " + internal::shown(cells_[1]) +
             ": expected transit, approach, grip, push or retreat");
    }
    sample.phase = *phase;
    const double push = number_at(2);
    if (!(push >= 1.0 && push <= 1e6) || push != std::floor(push)) {
      refuse("push: " + internal::shown(cells_[2]) + ": expected a number from 1 up");
    }
    sample.push = static_cast<int>(push) - 1;
    sample.grip_force = number_at(3);
    sample.X_WH = pose_at(4, "hand");
    sample.X_WT = pose_at(11, "tool");
    sample.force = {number_at(18), number_at(19), number_at(20)};
    sample.moment = {number_at(21), number_at(22), number_at(23)};
    sample.guard_force = number_at(24);
    return sample;
  }

  double number_at(std::size_t i) const {
    double value = 0.0;
    if (!internal::to_number(cells_[i], value)) {
      refuse(split(kColumns)[i] + ": " + internal::shown(cells_[i]) +
             ": expected a finite number");
    }
    return value;
  }

  ArmPose pose_at(std::size_t i, const char* whose) const {
    ArmPose pose;
    pose.position = {number_at(i), number_at(i + 1), number_at(i + 2)};
    pose.orientation = Eigen::Quaterniond(number_at(i + 6), number_at(i + 3),
                                          number_at(i + 4), number_at(i + 5));
    if (!(std::abs(pose.orientation.norm() - 1.0) <= kUnitTolerance)) {
      refuse(std::string(whose) + "_q: expected a quaternion of unit length");
    }
    return pose;
  }

  std::string_view text_;
  std::string label_;
  std::vector<std::string> cells_;
  std::size_t at_ = 0;
  int line_ = 0;
};

}  // namespace

ArmFormat arm_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".csv") return ArmFormat::kCsv;
  if (extension == ".tum" || extension == ".txt") return ArmFormat::kTum;
  if (extension == ".yaml" || extension == ".yml") return ArmFormat::kYaml;
  throw BadInput(file.string() +
                 ": expected a name that ends in .csv, .tum or .yaml, "
                 "or in .txt (TUM) or .yml");
}

std::string arm_to_text(const PlanFile& plan, const ArmMotion& motion,
                        const ArmLimits& limits, ArmFormat format) {
  const std::vector<Note> notes = notes_of(plan, motion, limits);
  switch (format) {
    case ArmFormat::kCsv:
      break;
    case ArmFormat::kTum:
      return to_tum(notes, motion);
    case ArmFormat::kYaml:
      return to_yaml(notes, motion);
  }
  return to_csv(notes, motion);
}

ArmMotion parse_arm_csv(const std::string& text, const std::string& label) {
  return CsvReader(text, label).read();
}

ArmMotion read_arm_csv(const std::filesystem::path& file) {
  return parse_arm_csv(internal::read_text(file, kLargestArm), file.string());
}

}  // namespace prehensile
