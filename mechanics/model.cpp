#include "mechanics/model.h"

#include <algorithm>
#include <cstdio>

#include "scene/constants.h"
#include "scene/lying_prism.h"

namespace prehensile {
namespace {

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    text += (text.empty() ? "" : "\n") + fault.field + ": " + fault.what;
  }
  return text;
}

/// Faces that this pusher may touch: as listed, or the one opposite to its normal while O
/// is aligned with W.
std::vector<int> touchable_faces(const Pusher& pusher, const std::vector<Face>& faces) {
  std::vector<int> touchable;
  touchable.reserve(pusher.faces.size() + 1);
  for (const std::string& wanted : pusher.faces)
    touchable.push_back(find_face(faces, wanted));
  if (pusher.faces.empty()) {
    const int face = face_towards(faces, rotated(pusher.normal_angle, {1.0, 0.0}));
    if (face >= 0) touchable.push_back(face);
  }
  return touchable;
}

/// The pusher meets the side of the object at its height.
bool meets(const Pusher& pusher, const Face& face) {
  constexpr double kSlack = 1e-6;  // [m]
  const double half_width = 0.5 * width_across_plane(pusher.feature);
  return pusher.z_WP + half_width >= face.z_low - kSlack &&
         pusher.z_WP - half_width <= face.z_high + kSlack;
}

PushContact make_contact(const Scene& scene, int pusher_index, const Face& face,
                         int face_index) {
  const Pusher& pusher = scene.pushers[pusher_index];
  PushContact contact;
  contact.pusher = pusher_index;
  contact.face = face_index;
  contact.n = face.n;
  contact.t = face.t;
  contact.a = face.a;
  contact.b = face.b;
  contact.mu = pusher.friction;
  const std::optional<double> length = length_in_plane(pusher.feature);
  contact.is_point = !length;
  contact.half_length = 0.5 * length.value_or(0.0);
  const double half_width = 0.5 * width_across_plane(pusher.feature);
  contact.z_low = std::clamp(pusher.z_WP - half_width, face.z_low, face.z_high);
  contact.z_high = std::clamp(pusher.z_WP + half_width, face.z_low, face.z_high);
  contact.theta_WO = wrapped(pusher.normal_angle - std::atan2(face.n.y(), face.n.x()));
  contact.g_O = rotated(-contact.theta_WO, scene.g_W);
  return contact;
}

/// Over or under that of the scene by more than this, a grip force is none to push with.
constexpr double kMostGripShare = 1e6;

/// The contacts again with other grip forces: the ends of the range and its middle.
void add_other_grips(const Scene& scene, Model& model) {
  const Gripper& gripper = scene.gripper;
  if (!gripper.grip_range) return;
  const auto say = [&model](const char* why) {
    model.decisions.push_back({"other grip forces of gripper.grip_range", why});
  };
  if (scene.g_W.isZero()) return say("without gravity they only scale the forces");
  const double least = (*gripper.grip_range)[0];
  const double greatest = (*gripper.grip_range)[1];
  if (!(gripper.grip_force * kMostGripShare > greatest &&
        least * kMostGripShare > gripper.grip_force)) {
    return say("they are a million times the scene's own, or a millionth");
  }
  std::vector<double> forces = {least};
  if (greatest > least) {
    forces.insert(forces.end(), {std::sqrt(least * greatest), greatest});
  }
  const std::size_t own = model.contacts.size();
  for (const double force : forces) {
    if (force == gripper.grip_force) continue;
    for (std::size_t i = 0; i < own; ++i) {
      PushContact contact = model.contacts[i];
      contact.grip_share = force / gripper.grip_force;
      contact.g_O /= contact.grip_share;
      model.contacts.push_back(contact);
    }
  }
}

CrossSectionModel make_cross_section(const Scene& scene) {
  CrossSectionModel section;
  section.radius = std::get<CylinderShape>(scene.object.shape).radius;
  section.mass = scene.object.mass;
  section.grip_force = scene.gripper.grip_force;
  section.friction = scene.gripper.friction;
  section.jaw_mode = scene.gripper.jaw_mode;
  return section;
}

LyingPrism make_prism(const PrismShape& shape, const Model& model) {
  LyingPrism prism;
  prism.section = shape.outline;
  if (shape.axis == Axis::kY) std::swap(prism.axis, prism.lateral);
  prism.com = {prism.lateral.dot(model.p_OCom), model.z_OCom};
  prism.length = shape.thickness;
  const std::size_t sides = prism.section.size();
  for (std::size_t i = 0; i < sides; ++i) {
    prism.circumference += (prism.section[(i + 1) % sides] - prism.section[i]).norm();
  }
  const double turn = symmetry_angle(prism.section);
  if (looks_alike(prism, turn)) prism.same_after = turn;
  return prism;
}

std::vector<std::string> load_shifts_of(const Scene& scene) {
  std::vector<std::string> found;
  if (scene.g_Wz != 0.0) found.emplace_back("gravity along the closing direction");
  const double height = height_of_mass(scene.object);
  if (std::abs(height) > 1e-6 * half_thickness(scene.object.shape)) {
    found.emplace_back("the centre of mass off the mid-plane");
  }
  if (scene.gripper.friction[0] != scene.gripper.friction[1]) {
    found.emplace_back("unequal friction of the fingers");
  }
  if (scene.gripper.pressure.law == PressureLaw::kFree) {
    found.emplace_back("free pressure");
  }
  return found;
}

/// Whether the pad plane is enough, and for which contacts it is not.
void explain_level(const Scene& scene, Model& model) {
  std::string why;
  for (const std::string& reason : model.load_shifts) {
    why += (why.empty() ? "" : ", ") + reason;
  }
  for (const PushContact& contact : model.contacts) {
    if (contact.is_symmetric()) continue;
    why += (why.empty() ? "pusher " : ", pusher ");
    why += scene.pushers[contact.pusher].name;
    why += " off the mid-plane";
  }
  if (why.empty()) {
    model.decisions.push_back(
        {"motion along the closing direction and out-of-plane turns",
         "pushers and loads are symmetric about the mid-plane, where the pads leave x, y "
         "and theta free"});
  } else {
    model.decisions.push_back(
        {"known loads of the pads (instants and pushes are solved in space, plans are "
         "searched in the pad plane)",
         std::move(why)});
  }
  if (model.jaw_force[0] + model.jaw_force[1] == 0.0 && scene.gripper.grip_force > 0.0) {
    model.decisions.push_back(
        {"friction of the pads",
         "the jaws cannot carry gravity along the closing direction"});
  }
}

void explain(const Scene& scene, Model& model) {
  const auto say = [&model](std::string what, std::string why) {
    model.decisions.push_back({std::move(what), std::move(why)});
  };
  explain_level(scene, model);
  if (scene.g_W.isZero() && scene.g_Wz == 0.0) say("gravity wrench", "gravity is zero");
  if (model.prism && !(scene.goal && scene.goal->psi)) {
    say("roll angle in plans", "the goal asks for no roll of the prism");
  } else if (!model.cross_section && !model.prism) {
    say("roll angle and cross-section", "the object cannot roll");
  }
  if (model.contacts.empty()) {
    say("planar pushes", scene.pushers.empty() ? "the scene has no pusher"
                                               : "no pusher lies flush with a face");
  }
  if (model.region.is_fixed_in_hand()) {
    say("clipping of the pads by the face", "overhang: ignore");
  }
  if (scene.gripper.friction[0] == scene.gripper.friction[1]) {
    say("separate fingers", "equal friction: points that coincide are merged");
  }
  const auto* point = std::get_if<PointPad>(&scene.gripper.pad);
  if (model.has_soft_points()) {
    say("points of the pads in the pad plane",
        "the pads are soft points: the ellipsoid is their law");
  } else if (point && point->spin_radius) {
    say("the soft point's own law in pushes and plans",
        "on a round side it is stood for, in the pad plane, by a round patch; instants "
        "know it exactly");
  }
  if (!scene.goal) say("goal", "the scene states none; it serves queries only");
  for (const PushContact& contact : model.contacts) {
    if (contact.mu > 0.0) continue;
    say("friction of pusher " + scene.pushers[contact.pusher].name, "it is zero");
  }
}

}  // namespace

BadScene::BadScene(std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

PushContact::Segment PushContact::segment(double place) const {
  const Vec2 centre = 0.5 * (a + b);
  if (is_point) {
    const Vec2 p = centre + place * t;
    return {p, p};
  }
  const double half_face = 0.5 * (b - a).norm();
  const double low = std::max(-half_face, place - half_length);
  const double high = std::min(half_face, place + half_length);
  return {centre + low * t, centre + high * t};
}

Model prepare(const Scene& scene, const PrepareOptions& options) {
  std::vector<Fault> faults = check(scene);
  if (!faults.empty()) throw BadScene(std::move(faults));

  Model model{
      .scene = scene, .options = options, .region = {scene, options.points_per_pad}};
  model.outline = outline_of(scene.object.shape);
  model.pad_face = pad_face_of(scene.object.shape);
  model.faces = faces_of(scene.object.shape);
  for (std::size_t i = 0; i < scene.pushers.size(); ++i) {
    for (const int face : touchable_faces(scene.pushers[i], model.faces)) {
      if (!meets(scene.pushers[i], model.faces[face])) {
        std::string what = "pusher " + scene.pushers[i].name;
        what += " on " + model.faces[face].name;
        model.decisions.push_back(
            {std::move(what), "the object has no side at the height of the pusher"});
        continue;
      }
      model.contacts.push_back(
          make_contact(scene, static_cast<int>(i), model.faces[face], face));
    }
  }
  if (options.other_grips) add_other_grips(scene, model);
  model.p_OCom = centre_of_mass(scene.object);
  model.mass = scene.object.mass;
  model.z_OCom = height_of_mass(scene.object);
  model.inertia_O = inertia_of(scene.object);
  model.jaw_force = jaw_forces(scene.gripper, model.mass * scene.g_Wz);
  model.F = scene.gripper.friction[0] * model.jaw_force[0] +
            scene.gripper.friction[1] * model.jaw_force[1];
  model.load_shifts = load_shifts_of(scene);
  const bool is_free = scene.gripper.pressure.law == PressureLaw::kFree;
  model.load_shifts_in_push = model.load_shifts.size() > (is_free ? 1u : 0u);
  model.c = model.region.torque_radius();
  model.L = longer_side(model.outline);
  model.half_thickness = half_thickness(scene.object.shape);
  if (can_roll(scene.object)) {
    model.cross_section = make_cross_section(scene);
    model.roll_radius = model.cross_section->radius;
  }
  if (const PrismShape* prism = lying_prism(scene.object.shape)) {
    model.prism = make_prism(*prism, model);
    model.roll_radius = model.prism->circumference / (2.0 * kPi);
  }
  explain(scene, model);
  return model;
}

bool looks_alike(const LyingPrism& prism, double psi) noexcept {
  constexpr double kSame = 1e-9;  // of the section's circumference
  return is_same_section(prism.section, psi) &&
         (rotated(psi, prism.com) - prism.com).norm() <= kSame * prism.circumference;
}

std::array<double, 2> jaw_forces(const Gripper& gripper, double w) {
  const double N = gripper.grip_force;
  std::array<double, 2> force{N, N};
  switch (gripper.jaw_mode) {
    case JawMode::kCoupled:
    case JawMode::kLocked:
      force = {N - 0.5 * w, N + 0.5 * w};
      break;
    case JawMode::kFixedJaw1:
      force = {N - w, N};
      break;
    case JawMode::kFixedJaw2:
      force = {N, N + w};
      break;
    case JawMode::kIndependent:
      if (w != 0.0) force = {0.0, 0.0};
      break;
  }
  if (force[0] < 0.0 || force[1] < 0.0) force = {0.0, 0.0};
  return force;
}

PlanarGrasp grasp_at(const Model& model, const PlanarPose& X_HO,
                     const Vec2& g_O) noexcept {
  const ContactPoints points = model.region.at(X_HO);
  PlanarGrasp grasp;
  grasp.count = model.F > 0.0 ? points.count : 0;
  for (int j = 0; j < grasp.count; ++j) {
    grasp.x[j] = points.x[j];
    grasp.y[j] = points.y[j];
    grasp.bound[j] = model.F * points.weight[j];
  }
  const Vec2 weight_H = model.mass * rotated(X_HO.theta, g_O);
  grasp.w_g = wrench_of(transform(X_HO, model.p_OCom), weight_H);
  return grasp;
}

void add_inertia(const Model& model, const PlanarPose& X_HO,
                 PlanarGrasp& grasp) noexcept {
  const Vec2 p_HCom = transform(X_HO, model.p_OCom);
  const double m = model.mass;
  grasp.inertia << m, 0.0, -m * p_HCom.y(),  //
      0.0, m, m * p_HCom.x(),                //
      -m * p_HCom.y(), m * p_HCom.x(), model.inertia_O(2, 2) + m * p_HCom.squaredNorm();
}

PlanarDrive drive_at(const PushContact& contact, double place, const PlanarPose& X_HO,
                     const PlanarTwist& V_HP) noexcept {
  const PushContact::Segment segment = contact.segment(place);
  PlanarDrive drive;
  drive.count = contact.is_point ? 1 : 2;
  drive.p_HC = {transform(X_HO, segment.a), transform(X_HO, segment.b)};
  drive.n_H = rotated(X_HO.theta, contact.n);
  drive.mu = contact.mu;
  drive.V_HP = V_HP;
  return drive;
}

bool pads_on_object(const Model& model, const PlanarPose& X_HO) noexcept {
  return contains(model.pad_face, finger_in_object(X_HO)) &&
         model.region.at(X_HO).count > 0;
}

int find_contact(const Model& model, const std::string& pusher, const std::string& face,
                 double grip_share) {
  constexpr double kSameGrip = 1e-6;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const PushContact& contact = model.contacts[i];
    const bool same_pusher = model.scene.pushers[contact.pusher].name == pusher;
    const bool same_face = face.empty() || find_face(model.faces, face) == contact.face;
    const bool same_grip =
        std::abs(contact.grip_share - grip_share) <= kSameGrip * grip_share;
    if (same_pusher && same_face && same_grip) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace prehensile
