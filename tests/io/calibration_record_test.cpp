/// The part of a scene that `prehensile calibrate` writes.
#include <gtest/gtest.h>

#include "io/scene_file.h"
#include "tests/io/random_scenes.h"

namespace prehensile::testing {
namespace {

CalibrationRecord random_record(Random& random) {
  CalibrationRecord record;
  record.data = "pushes \"of\" May.csv";
  record.pushes = random.bits() >> 1;
  record.registration = {random.in(-1e-2, 1e-2), random.in(-1e-2, 1e-2)};
  record.friction = random.in(0.0, 1.0);
  record.finger_friction = random.in(0.0, 1.0);
  record.torque_radius = random.in(0.0, 1.0);
  record.place = random.log_in(1e-6, 1e-2);
  record.scatter = random.log_in(1e-6, 1e-2);
  record.scatter_angle = random.log_in(1e-6, 1e-1);
  if (random.chance(0.5)) {
    record.factors_50 = Vec3(random.in(0.0, 9.0), random.in(0.0, 9.0), 1.0);
  }
  if (random.chance(0.5)) record.factors_90 = Vec3(2.0, random.in(0.0, 9.0), 1.0);
  return record;
}

TEST(CalibrationRecord, ReturnsUnchanged) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    Scene scene = random_scene(random);
    scene.calibration = random_record(random);
    ASSERT_TRUE(check(scene).empty()) << i << check(scene)[0].field;
    const std::string text = scene_to_yaml(scene);
    const SceneFile file = parse_scene(text, "random");
    EXPECT_EQ(scene_to_yaml(file.scene), text);
    ASSERT_TRUE(file.scene.calibration.has_value());
    const CalibrationRecord& record = *file.scene.calibration;
    EXPECT_EQ(record.pushes, scene.calibration->pushes);
    EXPECT_EQ(record.registration, scene.calibration->registration);
    EXPECT_EQ(record.factors_50, scene.calibration->factors_50);
    EXPECT_EQ(record.factors_90, scene.calibration->factors_90);
    EXPECT_EQ(record.place, scene.calibration->place);
    EXPECT_EQ(record.scatter, scene.calibration->scatter);
    EXPECT_EQ(record.scatter_angle, scene.calibration->scatter_angle);
  }
}

/// Scenes without one are written, and digested, as they were before it existed.
TEST(CalibrationRecord, IsWrittenOnlyIfThereIsOne) {
  Random random(2);
  Scene scene = random_scene(random);
  EXPECT_EQ(scene_to_yaml(scene).find("calibration"), std::string::npos);
  const std::string digest = parse_scene(scene_to_yaml(scene), "without").digest;
  scene.calibration = CalibrationRecord{};
  EXPECT_NE(parse_scene(scene_to_yaml(scene), "with").digest, digest);
}

TEST(CalibrationRecord, FaultsAreNamed) {
  Random random(3);
  const auto error_of = [&](const std::string& lines) -> std::string {
    try {
      parse_scene(scene_to_yaml(random_scene(random)) + "calibration:\n" + lines, "s");
    } catch (const BadInput& bad) {
      const std::string what = bad.what();
      return what.substr(what.find("calibration"));
    }
    return "no error";
  };
  EXPECT_EQ(error_of("  pushes: 20\n  friction: -0.1\n"),
            "calibration.friction: -0.1: expected a number from 0 to 1");
  EXPECT_EQ(error_of("  pushes: many\n"),
            "calibration.pushes: many: expected a whole number >= 0");
  EXPECT_EQ(error_of("  pushes: 20\n  factors_90: [1, 2]\n"),
            "calibration.factors_90: a list of 2: expected a list of 3 numbers");
  EXPECT_EQ(error_of("  pushes: 20\n  place: .nan\n"),
            "calibration.place: .nan: expected a number from 0 to 1 m");
  Scene scene = random_scene(random);
  scene.calibration = CalibrationRecord{.torque_radius = kNan};
  ASSERT_EQ(check(scene).size(), 1U);
  EXPECT_EQ(check(scene)[0].field, "calibration.torque_radius");
}

}  // namespace
}  // namespace prehensile::testing
