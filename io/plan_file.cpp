#include "io/plan_file.h"

#include <algorithm>
#include <cmath>

#include "io/document.h"
#include "io/field_reader.h"
#include "io/field_schema.h"
#include "io/field_writer.h"
#include "io/plan_fields.h"
#include "mechanics/model.h"

namespace prehensile {
namespace {

using internal::Faults;
using internal::PushKind;
using internal::Value;
using internal::WrittenPlan;
using internal::WrittenPush;

constexpr double kUnitTolerance = 1e-6;

/// YAML begins with a key or a comment where JSON has a bracket.
bool looks_like_a_scene(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return false;
  return text[first] == '#' || text.compare(first, 8, "version:") == 0;
}

constexpr auto kVisit = [](auto& fields, WrittenPlan& record) {
  internal::visit_plan(fields, record);
};

PushKind kind_of(const Push& push) {
  if (std::holds_alternative<Roll>(push)) return PushKind::kRoll;
  const LinearPush linear = as_linear(push);
  const std::string_view kind = kind_name(linear.travel, linear.turn, 0.0);
  if (std::holds_alternative<Slide>(push) || kind == "slide") return PushKind::kSlide;
  if (std::holds_alternative<Pivot>(push) || kind == "pivot") return PushKind::kPivot;
  return PushKind::kPush;
}

WrittenPush record_of(const Model& model, const PlannedPush& planned) {
  WrittenPush record;
  const PushContact& contact =
      model.contacts.at(static_cast<std::size_t>(contact_of(planned.push)));
  record.kind = kind_of(planned.push);
  record.pusher = model.scene.pushers[contact.pusher].name;
  record.face = model.faces[contact.face].name;
  record.planned = planned;
  if (const auto* roll = std::get_if<Roll>(&planned.push)) {
    record.travel = roll->travel;
    if (roll->grip_force > 0.0) record.grip_force = roll->grip_force;
    return record;
  }
  const LinearPush linear = as_linear(planned.push);
  if (contact.grip_share != 1.0) {
    record.grip_force = grip_force_of(model, planned.push);
  }
  record.place = linear.place;
  record.direction = linear.e;
  record.travel = linear.travel;
  record.turn = linear.turn;
  if (const auto* slide = std::get_if<Slide>(&planned.push)) {
    record.guard_angle = slide->guard_angle;
  } else if (const auto* pivot = std::get_if<Pivot>(&planned.push)) {
    record.guard_distance = pivot->guard_distance;
  }
  return record;
}

/// Makes the push of a record, with its faults.
class PushMaker {
 public:
  PushMaker(const Model& model, const Value& root, Faults& faults)
      : model_(model), root_(root), faults_(faults) {}

  PlannedPush make(const WrittenPush& record, std::size_t number) {
    path_ = "pushes." + std::to_string(number);
    PlannedPush planned = record.planned;
    const int contact = contact_of_names(record);
    if (record.kind == PushKind::kRoll) {
      planned.push = roll(record, contact);
    } else {
      planned.push = linear(record, contact);
    }
    return planned;
  }

 private:
  void fault(const std::string& key, const std::string& what) {
    const std::string path = internal::join(path_, key);
    faults_.add(internal::place_of(root_, path), path, what);
  }

  int contact_of_names(const WrittenPush& record) {
    const bool is_roll = record.kind == PushKind::kRoll;
    const double own = model_.scene.gripper.grip_force;
    const double share =
        is_roll || own == 0.0 ? 1.0 : record.grip_force.value_or(own) / own;
    const int contact = find_contact(model_, record.pusher, record.face, share);
    if (contact >= 0 && !record.face.empty()) return contact;
    if (find_contact(model_, record.pusher, record.face) >= 0 && !record.face.empty()) {
      fault("grip_force",
            internal::number_text(*record.grip_force) +
                ": expected that of the scene, or one that plans try in its "
                "gripper.grip_range");
      return 0;
    }
    std::string faces;
    bool known = false;
    for (const PushContact& other : model_.contacts) {
      if (model_.scene.pushers[other.pusher].name != record.pusher) continue;
      known = true;
      faces += (faces.empty() ? "" : ", ") + model_.faces[other.face].name;
    }
    if (known) {
      fault("face", internal::shown(record.face) +
                        ": expected a face that the pusher may touch (" + faces + ")");
    } else {
      fault("pusher", internal::shown(record.pusher) +
                          ": expected the name of a pusher that touches the object");
    }
    return 0;
  }

  Push roll(const WrittenPush& record, int contact) {
    if (record.travel == 0.0) fault("travel", "0: expected a motion");
    if (model_.roll_radius == 0.0) {
      fault("kind", "roll: expected another kind, the object cannot roll");
    }
    if (record.place || record.direction || record.turn) {
      fault("kind", "roll: expected no place, direction or turn");
    }
    refuse("guard_angle", record.guard_angle);
    refuse("guard_distance", record.guard_distance);
    return Roll{contact, record.travel, record.grip_force.value_or(0.0)};
  }

  Push linear(const WrittenPush& record, int contact) {
    const bool complete = record.place && record.direction && record.turn;
    if (!record.place) fault("place", "missing: expected for every kind but roll");
    if (!record.direction)
      fault("direction", "missing: expected for every kind but roll");
    if (!record.turn) fault("turn", "missing: expected for every kind but roll");
    if (!complete) return LinearPush{};
    check_motion(record);
    const double place = *record.place;
    if (record.kind == PushKind::kSlide && record.guard_angle) {
      refuse("guard_distance", record.guard_distance);
      return Slide{contact, place, *record.direction, record.travel, *record.guard_angle};
    }
    if (record.kind == PushKind::kPivot && record.guard_distance) {
      refuse("guard_angle", record.guard_angle);
      return Pivot{contact, place, *record.turn, *record.guard_distance};
    }
    refuse("guard_angle", record.guard_angle);
    refuse("guard_distance", record.guard_distance);
    return LinearPush{contact, place, *record.direction, record.travel, *record.turn};
  }

  void check_motion(const WrittenPush& record) {
    const double length = record.direction->norm();
    if (!(std::abs(length - 1.0) < kUnitTolerance)) {
      fault("direction",
            "of length " + internal::number_text(length) + ": expected a unit vector");
    }
    if (record.travel < 0.0) {
      fault("travel", internal::number_text(record.travel) + ": expected a number >= 0");
    }
    if (record.travel == 0.0 && *record.turn == 0.0) {
      fault("travel", "0, and turn is 0: expected a motion");
    }
  }

  void refuse(const std::string& key, const std::optional<double>& value) {
    if (value) fault(key, "given: expected for other kinds of push only");
  }

  const Model& model_;
  const Value& root_;
  Faults& faults_;
  std::string path_;
};

/// What must hold between the fields of a plan.
void check_agreement(const WrittenPlan& record, const std::string& digest,
                     const Value& root, Faults& faults) {
  const auto fault = [&](const std::string& field, const std::string& what) {
    faults.add(internal::place_of(root, field), field, what);
  };
  if (record.scene_digest != digest) {
    fault("scene_digest", internal::shown(record.scene_digest) + ": expected " + digest +
                              ", the digest of the scene in this file");
  }
  const bool infeasible = record.plan.status == PlanStatus::kInfeasible;
  if (infeasible != record.proof.has_value()) {
    fault("proof", infeasible ? "missing: expected with status infeasible"
                              : "given: expected with status infeasible only");
  }
  const bool reached = record.plan.status == PlanStatus::kReachedGoal;
  if (reached == record.pushes.empty()) {
    fault("pushes", reached
                        ? "an empty list: expected the pushes that reach the goal"
                        : "pushes of a plan that has not reached the goal: expected an "
                          "empty list");
  }
}

std::optional<internal::WrittenExplanation> record_of(const Plan& plan) {
  if (!plan.explanation) return std::nullopt;
  internal::WrittenExplanation out{plan.explanation->text, {}, plan.explanation->changes};
  for (int i = 0; i < kPushConstraints; ++i) {
    const auto constraint = static_cast<PushConstraint>(i);
    if (plan.stopped_by[constraint] == 0) continue;
    out.stopped_by.push_back({std::string(name(constraint)),
                              static_cast<std::uint64_t>(plan.stopped_by[constraint])});
  }
  std::stable_sort(out.stopped_by.begin(), out.stopped_by.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  return out;
}

WrittenPlan record_of(const PlanFile& file) {
  const Model model = prepare(file.scene);
  WrittenPlan record;
  record.scene = scene_to_yaml(file.scene);
  record.scene_digest = file.scene_digest;
  record.plan = file.plan;
  record.gap = file.plan.gap();
  if (file.plan.proof.kind != Proof::Kind::kNone) record.proof = file.plan.proof;
  record.explanation = record_of(file.plan);
  for (const PlannedPush& planned : file.plan.pushes) {
    record.pushes.push_back(record_of(model, planned));
  }
  return record;
}

}  // namespace

std::string plan_to_json(const PlanFile& file) {
  WrittenPlan record = record_of(file);
  return internal::to_json(internal::FieldWriter::write(record, kVisit));
}

PlanFile parse_plan(const std::string& text, const std::string& label) {
  Faults faults(label);
  if (looks_like_a_scene(text)) {
    faults.fail({}, "",
                "a scene file: expected a plan file, as `prehensile plan` writes it");
  }
  const Value root = internal::parse_json(text, faults);
  WrittenPlan record;
  internal::FieldReader::read(root, "", faults, record, kVisit);
  faults.raise();
  const SceneFile scene = parse_scene(record.scene, label + ": scene");
  check_agreement(record, scene.digest, root, faults);

  PlanFile file{scene.scene, record.scene_digest, record.plan};
  if (record.proof) file.plan.proof = *record.proof;
  if (record.explanation) {
    file.plan.explanation = {record.explanation->text, record.explanation->changes};
    for (int i = 0; i < kPushConstraints; ++i) {
      const auto constraint = static_cast<PushConstraint>(i);
      for (const internal::WrittenConstraint& written : record.explanation->stopped_by) {
        if (written.constraint != name(constraint)) continue;
        file.plan.stopped_by.count[static_cast<std::size_t>(i)] =
            static_cast<std::int64_t>(written.count);
      }
    }
  }
  const Model model = prepare(scene.scene);
  PushMaker maker(model, root, faults);
  for (std::size_t i = 0; i < record.pushes.size(); ++i) {
    file.plan.pushes.push_back(maker.make(record.pushes[i], i));
  }
  faults.raise();
  return file;
}

PlanFile read_plan(const std::filesystem::path& file) {
  return parse_plan(internal::read_text(file, internal::kLargestPlan), file.string());
}

std::string plan_schema() {
  WrittenPlan defaults;
  return internal::FieldSchema::document(
      "Plan of prehensile",
      "A regrasp plan with the scene that it is for. SI units, radians.", defaults,
      kVisit);
}

}  // namespace prehensile
