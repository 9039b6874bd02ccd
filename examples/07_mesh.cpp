/// An object of your own: at which faces flat jaws can hold the body of a mesh file, and
/// one push of it.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "mechanics/model.h"
#include "mesh/face_pairs.h"
#include "primitives/transition.h"

using namespace prehensile;

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: 07_mesh MESH (in millimetres)\n");
    return 2;
  }
  const TriangleMesh mesh = read_mesh(argv[1], 1e-3);
  const std::vector<FacePair> pairs = find_face_pairs(mesh);
  std::printf("%zu pairs of faces\n", pairs.size());
  for (const FacePair& pair : pairs) {
    std::printf("  %s: %.1f mm apart, %.0f mm^2\n", pair.name.c_str(),
                1e3 * pair.thickness, 1e6 * pair.area);
  }
  if (pairs.empty()) return 1;

  const HeldBody body = body_between(mesh, pairs.front());
  Scene scene;
  scene.object.shape = body.shape;
  scene.object.mass = 0.15;
  scene.gripper.pad = DiscPad{.radius = 0.006};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "wall", .feature = PlaneFeature{}, .friction = 0.4}};
  const Model model = prepare(scene);
  for (const std::string& note : body.notes) std::printf("note: %s\n", note.c_str());

  const LinearPush push{.contact = 0, .e = model.contacts[0].n, .travel = 0.003};
  const Transition out = apply(model, scene.start, push);
  std::printf("%s: %.2f mm, %.2f mm, %.2f deg at up to %.2f N\n",
              std::string(name(out.status)).c_str(), 1e3 * out.end.X_HO.x,
              1e3 * out.end.X_HO.y, 57.29577951308232 * out.end.X_HO.theta,
              out.max_push_force);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
