#include "viewer/animation_glb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <tiny_gltf.h>

#include <Eigen/Geometry>

#include "viewer/film_state.h"
#include "viewer/surfaces.h"

namespace prehensile::viewer {
namespace {

constexpr double kRate = 30.0;                           // [Hz] of the key frames
constexpr double kThickPad = 0.06, kThickPusher = 0.06;  // over the reach of the object

struct Colour {
  double r, g, b, a;
};

/// Adds buffers, meshes and nodes to one glTF document.
class Document {
 public:
  Document() {
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "prehensile";
    gltf_.buffers.emplace_back();
    gltf_.scenes.emplace_back();
    gltf_.defaultScene = 0;
  }

  int add_node(const std::string& name, int parent) {
    tinygltf::Node node;
    node.name = name;
    const int index = static_cast<int>(gltf_.nodes.size());
    gltf_.nodes.push_back(node);
    if (parent < 0) {
      gltf_.scenes[0].nodes.push_back(index);
    } else {
      gltf_.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    }
    return index;
  }

  void place(int node, const Vec3& p, const Eigen::Quaterniond& q) {
    tinygltf::Node& placed = gltf_.nodes[static_cast<std::size_t>(node)];
    placed.translation = {p.x(), p.y(), p.z()};
    placed.rotation = {q.x(), q.y(), q.z(), q.w()};
  }

  void show(int node, const Surface& surface, const Colour& colour) {
    if (surface.triangles.empty()) return;
    std::vector<float> positions, normals;
    positions.reserve(9 * surface.triangles.size());
    normals.reserve(9 * surface.triangles.size());
    for (const auto& [a, b, c] : surface.triangles) {
      const Vec3 n = (b - a).cross(c - a).normalized();
      for (const Vec3& p : {a, b, c}) {
        for (int i = 0; i < 3; ++i) {
          positions.push_back(static_cast<float>(p[i]));
          normals.push_back(static_cast<float>(n[i]));
        }
      }
    }
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] =
        add_values(positions, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] =
        add_values(normals, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.material = add_material(colour);
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive);
    gltf_.nodes[static_cast<std::size_t>(node)].mesh =
        static_cast<int>(gltf_.meshes.size());
    gltf_.meshes.push_back(mesh);
  }

  /// Times [s] of all animations.
  void set_times(const std::vector<float>& times) {
    times_ = add_values(times, TINYGLTF_TYPE_SCALAR, 0);
    gltf_.animations.emplace_back();
    gltf_.animations[0].name = "plan";
  }

  void animate(int node, const std::string& path, const std::vector<float>& values) {
    tinygltf::Animation& animation = gltf_.animations[0];
    tinygltf::AnimationSampler sampler;
    sampler.input = times_;
    sampler.output = add_values(
        values, path == "rotation" ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, 0);
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
  }

  std::string bytes() {
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&gltf_, out, false, true)) {
      throw std::runtime_error("tinygltf cannot write this scene");
    }
    return out.str();
  }

 private:
  int add_values(const std::vector<float>& values, int type, int target) {
    std::vector<unsigned char>& data = gltf_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(float);
    view.target = target;
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    const auto width = static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(gltf_.bufferViews.size());
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    accessor.type = type;
    accessor.count = values.size() / width;
    accessor.minValues.assign(width, 1e300);
    accessor.maxValues.assign(width, -1e300);
    for (std::size_t i = 0; i < values.size(); ++i) {
      double& least = accessor.minValues[i % width];
      double& most = accessor.maxValues[i % width];
      least = std::min(least, static_cast<double>(values[i]));
      most = std::max(most, static_cast<double>(values[i]));
    }
    gltf_.bufferViews.push_back(view);
    gltf_.accessors.push_back(accessor);
    return static_cast<int>(gltf_.accessors.size()) - 1;
  }

  int add_material(const Colour& colour) {
    tinygltf::Material material;
    material.pbrMetallicRoughness.baseColorFactor = {colour.r, colour.g, colour.b,
                                                     colour.a};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.7;
    material.doubleSided = true;
    if (colour.a < 1.0) material.alphaMode = "BLEND";
    gltf_.materials.push_back(material);
    return static_cast<int>(gltf_.materials.size()) - 1;
  }

  tinygltf::Model gltf_;
  int times_ = -1;
};

Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

/// The axis about which psi turns the object.
Vec3 roll_axis(const ObjectBody& body) {
  Axis axis = Axis::kX;
  for (const PrismBody& prism : body.prisms) axis = prism.axis;
  for (const CylinderBody& cylinder : body.cylinders) axis = cylinder.axis;
  return axis == Axis::kX   ? Vec3::UnitX()
         : axis == Axis::kY ? Vec3::UnitY()
                            : Vec3::UnitZ();
}

/// Translations and rotations of a node, one after the other.
struct Track {
  std::vector<float> translation, rotation;
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();

  void add(const Vec3& p, Eigen::Quaterniond q) {
    if (q.dot(last) < 0.0) q.coeffs() *= -1.0;  // the short way between key frames
    last = q;
    for (int i = 0; i < 3; ++i) translation.push_back(static_cast<float>(p[i]));
    for (int i = 0; i < 4; ++i) rotation.push_back(static_cast<float>(q.coeffs()[i]));
  }
};

/// Times of the key frames: even, and at the ends of all phases.
std::vector<double> key_times(const Film& film) {
  std::vector<double> times;
  for (const FilmPhase& phase : film.phases) {
    const double length = phase.end - phase.begin;
    const int steps = std::max(1, static_cast<int>(std::ceil(kRate * length)));
    if (length <= 0.0) continue;
    for (int i = 0; i < steps; ++i) times.push_back(phase.begin + length * i / steps);
  }
  times.push_back(duration_of(film));
  return times;
}

}  // namespace

std::string animation_glb(const Model& model, const Film& film) {
  const ObjectBody body = object_body(model);
  const Vec3 axis = roll_axis(body);
  const double reach = reach_of(model);
  Document document;
  const int world = document.add_node("world", -1);
  for (std::size_t i = 0; i < model.scene.pushers.size(); ++i) {
    const Pusher& pusher = model.scene.pushers[i];
    const PusherBody feature = pusher_in(film, model, static_cast<int>(i));
    const int node = document.add_node(pusher.name, world);
    document.place(node, {pusher.p_WP.x(), pusher.p_WP.y(), pusher.z_WP},
                   about_z(pusher.normal_angle));
    document.show(node, surface_of(feature, kThickPusher * reach),
                  {0.79, 0.64, 0.36, 1.0});
  }
  const int hand = document.add_node("hand", world);
  const std::array<int, 2> jaws{document.add_node("jaw 1", hand),
                                document.add_node("jaw 2", hand)};
  const int object = document.add_node("object", hand);
  const double thick = kThickPad * reach;
  const PadBody pad = pad_body(model);
  document.show(jaws[0], surface_of(pad, -thick, 0.0), {0.2, 0.22, 0.25, 0.6});
  document.show(jaws[1], surface_of(pad, 0.0, thick), {0.2, 0.22, 0.25, 0.6});
  document.show(object, film.surface ? surface_of(*film.surface) : surface_of(body),
                {0.45, 0.62, 0.82, 1.0});
  if (model.scene.obstacles) {
    const auto show_bodies = [&](const std::vector<ConvexBody>& bodies, int parent) {
      for (const ConvexBody& one : bodies) {
        document.show(document.add_node(one.name, parent),
                      surface_of(one, extent_of(model)), {0.55, 0.55, 0.58, 0.35});
      }
    };
    show_bodies(model.scene.obstacles->fixture, world);
    show_bodies(model.scene.obstacles->hand, hand);
  }

  if (film.phases.empty()) {
    const Grasp& start = model.scene.start;
    const PlanarPose X_WH = inverse(start.X_HO);
    document.place(hand, {X_WH.x, X_WH.y, 0.0}, about_z(X_WH.theta));
    document.place(object, {start.X_HO.x, start.X_HO.y, 0.0},
                   about_z(start.X_HO.theta) *
                       Eigen::Quaterniond(Eigen::AngleAxisd(start.psi, axis)));
    document.place(jaws[0], {0.0, 0.0, -model.half_thickness}, about_z(0.0));
    document.place(jaws[1], {0.0, 0.0, model.half_thickness}, about_z(0.0));
    return document.bytes();
  }

  std::vector<float> times;
  Track hand_track, object_track;
  std::array<Track, 2> jaw_tracks;
  for (const double time : key_times(film)) {
    times.push_back(static_cast<float>(time));
    const FilmState state = state_at(film, time);
    const PlanarPose& X_HO = state.grasp.X_HO;
    hand_track.add({state.X_WH.x, state.X_WH.y, state.z_WH}, about_z(state.X_WH.theta));
    object_track.add({X_HO.x, X_HO.y, state.z_HO},
                     about_z(X_HO.theta) *
                         Eigen::Quaterniond(Eigen::AngleAxisd(state.grasp.psi, axis)));
    for (std::size_t jaw = 0; jaw < 2; ++jaw) {
      jaw_tracks[jaw].add({0.0, 0.0, state.jaw_z[jaw]}, about_z(0.0));
    }
  }
  document.set_times(times);
  document.animate(hand, "translation", hand_track.translation);
  document.animate(hand, "rotation", hand_track.rotation);
  document.animate(object, "translation", object_track.translation);
  document.animate(object, "rotation", object_track.rotation);
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    document.animate(jaws[jaw], "translation", jaw_tracks[jaw].translation);
  }
  return document.bytes();
}

bool has_glb() { return true; }

}  // namespace prehensile::viewer
