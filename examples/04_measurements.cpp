/// Measurements to calibrate with, made by simulation: a tip that is not quite where it
/// is said to be, pads that press more at the rim, frictions that are not those of the
/// scene, noise, and a few pushes that went wrong. Prints pushes, or with a second
/// argument readings of slip forces, as `prehensile calibrate` reads them.
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "io/measurements.h"

using namespace prehensile;

namespace {

/// Uniform and nearly normal numbers, the same on every machine.
class Noise {
 public:
  double in(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1.0p-53);
  }
  double normal(double scale) {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) sum += in(-0.5, 0.5);
    return scale * sum;
  }

 private:
  std::mt19937_64 bits_{2026};
};

/// A push against one of three faces: 3 mm of approach and 12 mm of contact.
MeasuredPush drawn_push(Noise& noise, int number) {
  const Vec2 normals[] = {{1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
  const Vec2 n = normals[number % 3];
  const double along =
      number % 3 == 0 ? noise.in(-0.015, 0.015) : noise.in(-0.035, 0.035);
  const Vec2 met = Vec2(-0.05 * n.x(), -0.02 * n.y()) + along * perp(n);
  const Vec2 way = rotated(noise.in(-0.8, 0.8), n);
  MeasuredPush push;
  push.X_HO_start = {noise.in(-0.01, 0.01), noise.in(-0.004, 0.004), noise.in(-0.1, 0.1)};
  push.from = transform(push.X_HO_start, met - 0.003 * way);
  push.to = transform(push.X_HO_start, met + 0.012 * way);
  return push;
}

void print_pushes(const Scene& nominal) {
  Scene truth = nominal;
  truth.pushers[0].friction = 0.22;
  truth.gripper.friction = {0.45, 0.45};
  truth.gripper.pressure.edge_load = 0.8;
  const Vec2 registration(0.6e-3, -0.4e-3);
  const Model model = prepare(truth);
  Noise noise;
  std::vector<MeasuredPush> pushes;
  for (int i = 0; i < 40; ++i) {
    MeasuredPush push = drawn_push(noise, i);
    const PredictedPush end = predict(model, push, registration);
    push.X_HO_end = end.X_HO_end;
    push.X_HO_end.x += noise.normal(1.5e-4);
    push.X_HO_end.y += noise.normal(1.5e-4);
    push.X_HO_end.theta += noise.normal(3e-3);
    push.push_force = end.push_force * (1.0 + noise.normal(0.05));
    if (i % 19 == 7) push.X_HO_end.y += 4e-3;  // two that went wrong
    pushes.push_back(push);
  }
  std::fputs(pushes_to_csv(pushes, model, 2).c_str(), stdout);
}

void print_slip_forces(const Scene& nominal) {
  constexpr double kFriction = 0.45;
  constexpr double kBias = 0.6;  // [N] weight of the object, and the sensor's zero
  const double c = 1.1 * ContactRegion(nominal, 64).torque_radius();
  Noise noise;
  std::printf("grip_force_N,slip_force_N,slip_torque_Nm\n");
  for (int i = 0; i < 24; ++i) {
    const double grip = 5.0 * (1 + i % 6);
    const double slip = 2.0 * kFriction * grip;
    std::printf("%.1f,%.3f,%.4f\n", grip, (slip + kBias) * (1.0 + noise.normal(0.03)),
                slip * c * (1.0 + noise.normal(0.03)));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: example_04_measurements SCENE.yaml [slip]\n");
    return 2;
  }
  const Scene scene = read_scene(argv[1]).scene;
  if (argc > 2 && std::strcmp(argv[2], "slip") == 0) {
    print_slip_forces(scene);
  } else {
    print_pushes(scene);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
