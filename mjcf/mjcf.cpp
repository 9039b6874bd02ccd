#include "mjcf/mjcf.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mjcf/elements.h"
#include "mjcf/key_frames.h"
#include "mjcf/looks.h"
#include "scene/pad_quadrature.h"
#include "scene/polygon_pieces.h"

namespace prehensile::mjcf {
namespace {

constexpr double kTimeStep = 1e-3;          // [s]
constexpr const char* kSolref = "0.002 1";  // [s] time constant, no less than two steps
constexpr const char* kSolimp = "0.95 0.95 0.001";
constexpr double kImpratio = 1000.0;     // friction as stiff as that: else it creeps
constexpr double kHeavy = 1e9;           // [kg] and [kg m^2] of the hand's joints
constexpr double kInertiaOfLoad = 3e-3;  // [kg/N] of a pad point along its slide
constexpr double kTip = 1e-4;            // [m] radius of the balls that touch
constexpr double kSkin = 5e-4;           // [m] half the depth of what they touch
constexpr double kEndless = 4.0;         // half length over the reach of the object
constexpr double kLeastPiece = 1e-10;    // [m^2] of a face
constexpr const char* kPusherColour = "0.79 0.64 0.36 1";

constexpr const char* kAbout =
    " Written by prehensile. World: W of the scene, z is the closing direction. SI "
    "units, "
    "radians, quaternions w x y z. qpos: hand x, y, z, angle; pad points; object x, y, "
    "z, "
    "quaternion. ctrl: grip force of each finger [N]. Reset to key frame push_k and step "
    "for push_k_seconds (custom numeric): the heavy hand coasts along the push. All "
    "contacts are explicit pairs. ";

class Writer {
 public:
  explicit Writer(const Stage& stage) : stage_(stage), model_(*stage.model) {}

  std::string write() {
    root_ = document_.NewElement("mujoco");
    document_.InsertEndChild(root_);
    set(root_, "model", model_.scene.name);
    root_->InsertEndChild(document_.NewComment(kAbout));
    write_settings();
    asset_ = child(root_, "asset");
    world_ = child(root_, "worldbody");
    contact_ = child(root_, "contact");
    XMLElement* hand = add_body(world_, "hand", Vec3::Zero());
    XMLElement* object = add_body(world_, std::string(kObject), Vec3::Zero());
    write_object(object);
    write_pushers(object);
    write_hand(hand);
    write_grip();
    write_key_frames(root_, stage_);
    tinyxml2::XMLPrinter printer;
    document_.Print(&printer);
    return printer.CStr();
  }

 private:
  void write_settings() {
    XMLElement* compiler = child(root_, "compiler");
    set(compiler, "angle", std::string("radian"));
    set(compiler, "balanceinertia", std::string("true"));
    XMLElement* option = child(root_, "option");
    const Scene& scene = model_.scene;
    set(option, "timestep", kTimeStep);
    set(option, "gravity", Vec3(scene.g_W.x(), scene.g_W.y(), scene.g_Wz));
    set(option, "cone", std::string("elliptic"));
    set(option, "impratio", kImpratio);
    set(option, "solver", std::string("Newton"));
    set(option, "iterations", 100.0);
    set(option, "tolerance", 1e-14);
    XMLElement* defaults = child(root_, "default");
    XMLElement* geom = child(defaults, "geom");
    set(geom, "contype", 0.0);
    set(geom, "conaffinity", 0.0);
    set(geom, "group", 3.0);
    XMLElement* pair = child(defaults, "pair");
    set(pair, "solref", std::string(kSolref));
    set(pair, "solimp", std::string(kSolimp));
    XMLElement* look = child(defaults, "default");
    set(look, "class", std::string("look"));
    set(child(look, "geom"), "group", 1.0);
  }

  void add_ball(XMLElement* body, const std::string& name, const Vec3& at) {
    XMLElement* ball = add_geom(body, name, "sphere");
    set(ball, "size", kTip);
    set(ball, "pos", at);
  }

  void add_pair(const std::string& one, const std::string& other, double mu) {
    XMLElement* pair = child(contact_, "pair");
    set(pair, "geom1", one);
    set(pair, "geom2", other);
    set(pair, "condim", mu > 0.0 ? 3.0 : 1.0);
    if (mu > 0.0) set(pair, "friction", text({mu, mu, 0.0, 0.0, 0.0}));
  }

  // ---- object

  void write_object(XMLElement* object) {
    child(object, "freejoint");
    XMLElement* inertial = child(object, "inertial");
    set(inertial, "pos", Vec3(model_.p_OCom.x(), model_.p_OCom.y(), model_.z_OCom));
    set(inertial, "mass", model_.mass);
    const Eigen::Matrix3d& I = model_.inertia_O;
    set(inertial, "fullinertia",
        text({I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)}));
    show_object(object, asset_, model_);
    write_held_faces(object);
  }

  /// What the pads press on, from both sides.
  void write_held_faces(XMLElement* object) {
    if (const auto* cylinder = std::get_if<CylinderShape>(&model_.scene.object.shape);
        cylinder && model_.cross_section) {
      // For pads a capsule, which meets boxes in closed form.
      for (const auto& [name, type] : {std::pair(kRoundSide, "cylinder"),
                                       std::pair("object_held_side", "capsule")}) {
        XMLElement* side = add_geom(object, name, type);
        set(side, "size", text({cylinder->radius, 0.5 * cylinder->length}));
        set(side, "zaxis", Vec3(Vec3::Unit(static_cast<int>(cylinder->axis))));
      }
      held_.emplace_back("object_held_side");
      return;
    }
    const double half = model_.half_thickness;
    if (!stage_.overhangs) {  // the whole pad presses, wherever it is
      const double wide = 2.0 * (reach_of(model_) + pad_reach(model_.scene.gripper.pad));
      add_box(object, "object_faces", Vec3::Zero(), {wide, wide, half});
      held_.emplace_back("object_faces");
      return;
    }
    if (const auto* box = std::get_if<BoxShape>(&model_.scene.object.shape)) {
      add_box(object, "object_faces", Vec3::Zero(), 0.5 * box->size);
      held_.emplace_back("object_faces");
      return;
    }
    for (const Triangle& piece : triangulate(model_.pad_face)) {
      if (area_of(piece) < kLeastPiece) continue;
      const std::string name = "object_faces_" + std::to_string(held_.size());
      add_prism_asset(asset_, name, {piece.vertices.begin(), piece.vertices.end()}, -half,
                      half);
      set(add_geom(object, name, "mesh"), "mesh", name);
      held_.push_back(name);
    }
  }

  // ---- pushers and where they touch

  void write_pushers(XMLElement* object) {
    for (std::size_t i = 0; i < model_.scene.pushers.size(); ++i) {
      const Pusher& pusher = model_.scene.pushers[i];
      XMLElement* body = add_body(world_, std::string(kPusherPrefix) + pusher.name,
                                  {pusher.p_WP.x(), pusher.p_WP.y(), pusher.z_WP});
      set(body, "quat", about_z(pusher.normal_angle));
      write_side(body, pusher);
      for (const int contact : stage_.contacts) {
        const PushContact& touched = model_.contacts[static_cast<std::size_t>(contact)];
        if (touched.pusher == static_cast<int>(i)) write_contact(object, body, contact);
      }
    }
  }

  /// The flat side of a pusher, x = 0 in the frame of its centre: what is looked at, and
  /// what the corners of the object touch.
  void write_side(XMLElement* body, const Pusher& pusher) {
    const double reach = reach_of(model_);
    const double length = length_in_plane(pusher.feature).value_or(0.0);
    const double width = width_across_plane(pusher.feature);
    const double half_length =
        std::isinf(length) ? kEndless * reach : std::max(0.5 * length, kSkin);
    const double half_width =
        std::isinf(width) ? 2.0 * model_.half_thickness : std::max(0.5 * width, kSkin);
    XMLElement* look = add_look(body, "box", kPusherColour);
    const double depth = 0.05 * reach;
    set(look, "pos", Vec3(-depth, 0.0, 0.0));
    set(look, "size", Vec3(depth, half_length, half_width));
    if (length == 0.0) return;  // a point in the pad plane: only its tips touch
    // Corners meet it at their own height, so it may be wider than what it stands for.
    add_box(body, side_of(pusher), {-depth, 0.0, 0.0},
            {depth, std::isinf(length) ? kEndless * reach : 0.5 * length,
             half_width + 2.0 * reach});
  }

  static std::string side_of(const Pusher& pusher) {
    return std::string(kPusherPrefix) + pusher.name + "_side";
  }

  void write_contact(XMLElement* object, XMLElement* body, int index) {
    const PushContact& contact = model_.contacts[static_cast<std::size_t>(index)];
    const Pusher& pusher = model_.scene.pushers[static_cast<std::size_t>(contact.pusher)];
    if (is_round_side(model_, contact) && !contact.is_point) {
      write_plane(body, pusher, contact);
      return;
    }
    const Face& face = model_.faces[static_cast<std::size_t>(contact.face)];
    const std::string name = pusher.name + "_on_" + face.name;
    // Where points of the pad plane are in an object that has rolled.
    const Eigen::Quaterniond rolled_back =
        attitude(model_, 0.0, -stage_.psi[static_cast<std::size_t>(index)]);
    std::set<double> heights{contact.z_low, contact.z_high};
    int count = 0;
    for (const double z : heights) {
      if (!contact.is_point) {  // the ends of the face
        for (const Vec2& end : {contact.a, contact.b}) {
          const std::string corner = name + "_corner_" + std::to_string(count++);
          const Vec2 at = end + kTip * contact.n;
          add_ball(object, corner, rolled_back * Vec3(at.x(), at.y(), z));
          add_pair(corner, side_of(pusher), contact.mu);
        }
      }
      if (!std::isfinite(contact.half_length)) continue;
      std::set<double> ends{-contact.half_length, contact.half_length};
      for (const double end : ends) {  // the ends of the pusher
        const std::string tip = name + "_tip_" + std::to_string(count++);
        add_ball(body, tip, {-kTip, end, z - pusher.z_WP});
        add_pair(tip, touched_by_tips(object, contact, face), contact.mu);
      }
    }
  }

  /// The line where a cylinder is lowest touches a plane over all its length.
  void write_plane(XMLElement* body, const Pusher& pusher, const PushContact& contact) {
    const std::string name = std::string(kPusherPrefix) + pusher.name + "_plane";
    if (!written_.insert(name).second) return;
    XMLElement* plane = add_geom(body, name, "plane");
    set(plane, "zaxis", Vec3(Vec3::UnitX()));
    set(plane, "size", Vec3(1.0, 1.0, 0.01));
    add_pair(name, kRoundSide, contact.mu);
  }

  /// The face as a thin box, behind the border of the object.
  std::string touched_by_tips(XMLElement* object, const PushContact& contact,
                              const Face& face) {
    if (is_round_side(model_, contact)) return kRoundSide;
    std::string name = "object_" + face.name;
    if (!written_.insert(name).second) return name;
    const Vec2 centre = face.centre() + kSkin * face.n;
    XMLElement* box =
        add_box(object, name, {centre.x(), centre.y(), 0.5 * (face.z_low + face.z_high)},
                {kSkin, 0.5 * face.length(),
                 std::max(kSkin, 0.5 * (face.z_high - face.z_low) + kTip)});
    set(box, "quat", about_z(std::atan2(face.n.y(), face.n.x())));
    return name;
  }

  // ---- hand and pads

  void write_hand(XMLElement* hand) {
    const std::array<const char*, kHandJoints> names{"hand_x", "hand_y", "hand_z",
                                                     "hand_theta"};
    for (int i = 0; i < kHandJoints; ++i) {
      XMLElement* joint = child(hand, "joint");
      set(joint, "name", std::string(names[static_cast<std::size_t>(i)]));
      set(joint, "type", std::string(i < 3 ? "slide" : "hinge"));
      set(joint, "axis", Vec3(Vec3::Unit(std::min(i, 2))));
      set(joint, "armature", kHeavy);  // no weight: gravity leaves it alone
    }
    add_light_inertia(hand);
    show_pads(hand, asset_, model_);
    for (int jaw = 0; jaw < 2; ++jaw) {
      for (int j = 0; j < stage_.points.count; ++j) write_pad_point(hand, jaw, j);
    }
  }

  static std::string pad_point(int jaw, int j) {
    return "jaw_" + std::to_string(jaw + 1) + "_point_" + std::to_string(j);
  }

  /// A ball that slides along the closing direction, pressed on the object with its share
  /// of the grip force. The springs keep the object in the middle and share out what the
  /// loads shift by, as an elastic foundation does.
  void write_pad_point(XMLElement* hand, int jaw, int j) {
    const double side = jaw == 0 ? -1.0 : 1.0;
    const double stiffness = stage_.points.weight[j] * stage_.stiffness;  // [N/m]
    // Less makes its contact soft, more rattles; and steps of time have to follow the
    // spring.
    const double load = stage_.points.weight[j] * model_.scene.gripper.grip_force;
    const double inertia =
        std::max(kInertiaOfLoad * load, 4.0 * stiffness * kTimeStep * kTimeStep);
    const std::string name = pad_point(jaw, j);
    XMLElement* point = add_body(
        hand, name,
        {stage_.points.x[j], stage_.points.y[j], side * (model_.half_thickness + kTip)});
    XMLElement* joint = child(point, "joint");
    set(joint, "name", name);
    set(joint, "type", std::string("slide"));
    set(joint, "axis", Vec3(0.0, 0.0, -side));
    set(joint, "armature", inertia);
    set(joint, "stiffness", stiffness);
    set(joint, "damping", 2.0 * std::sqrt(stiffness * inertia));
    add_light_inertia(point);
    if (model_.cross_section) {
      add_slat(point, name);
    } else {
      add_ball(point, name, Vec3::Zero());
    }
    const double mu = model_.scene.gripper.friction[static_cast<std::size_t>(jaw)];
    for (const std::string& face : held_) add_pair(name, face, mu);
  }

  /// On a round side a ball would push the object away from under it. A slat across the
  /// line of contact, as thin along it as a ball, is flat as a pad is.
  void add_slat(XMLElement* point, const std::string& name) {
    const Vec2 along(stage_.points.x[stage_.points.count - 1] - stage_.points.x[0],
                     stage_.points.y[stage_.points.count - 1] - stage_.points.y[0]);
    XMLElement* slat =
        add_box(point, name, Vec3::Zero(), {kTip, 0.5 * model_.half_thickness, kTip});
    set(slat, "quat", about_z(std::atan2(along.y(), along.x())));
  }

  void write_grip() {
    XMLElement* fixed = child(child(root_, "tendon"), "fixed");
    set(fixed, "name", std::string("grip"));
    for (int jaw = 0; jaw < 2; ++jaw) {
      for (int j = 0; j < stage_.points.count; ++j) {
        XMLElement* joint = child(fixed, "joint");
        set(joint, "joint", pad_point(jaw, j));
        set(joint, "coef", stage_.points.weight[j]);
      }
    }
    XMLElement* motor = child(child(root_, "actuator"), "motor");
    set(motor, "name", std::string("grip"));
    set(motor, "tendon", std::string("grip"));
  }

  static constexpr const char* kRoundSide = "object_side";

  const Stage& stage_;
  const Model& model_;
  tinyxml2::XMLDocument document_;
  XMLElement* root_ = nullptr;
  XMLElement* asset_ = nullptr;
  XMLElement* world_ = nullptr;
  XMLElement* contact_ = nullptr;
  std::vector<std::string> held_;  // geoms that the pads press on
  std::set<std::string> written_;  // geoms that several contacts share
};

}  // namespace

std::string document(const Stage& stage) { return Writer(stage).write(); }

std::string file_text(const Model& model, const std::vector<PlannedPush>& pushes) {
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const double bend = as_linear(pushes[i].push).bend;
    if (bend == 0.0) continue;
    throw NotCarried("push " + std::to_string(i + 1) + ": its path bends by " +
                     text(bend) + " rad: expected a straight one, as a hand coasts");
  }
  return document(stage(model, pushes));
}

}  // namespace prehensile::mjcf
