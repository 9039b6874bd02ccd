/// The schemas shipped for editors say what the readers say. Judged by valijson, which
/// shares nothing with them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "io/document.h"
#include "io/plan_file.h"
#include "tests/io/files.h"
#include "tests/io/random_scenes.h"

namespace prehensile::testing {
namespace {

using nlohmann::json;

class Schema {
 public:
  explicit Schema(const std::string& text) {
    const json document = json::parse(text);
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema_);
  }
  bool accepts(const std::string& text) const {
    const json document = json::parse(text);
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(document),
                              nullptr);
  }

 private:
  valijson::Schema schema_;
};

/// YAML as JSON, without the readers of fields.
std::string as_json(const std::string& yaml) {
  internal::Faults faults("yaml");
  return internal::to_json(internal::parse_yaml(yaml, faults));
}

TEST(Schema, ShippedFilesAreTheGeneratedOnes) {
  const std::vector<std::pair<std::string, std::string>> schemas = {
      {"schemas/scene.schema.json", scene_schema()},
      {"schemas/plan.schema.json", plan_schema()}};
  for (const auto& [name, text] : schemas) {
    if (text_of(kSourceTree / name) == text) continue;
    const std::filesystem::path fresh = std::filesystem::path(PREHENSILE_BINARY_DIR) /
                                        std::filesystem::path(name).filename();
    write_atomically(fresh, text);
    ADD_FAILURE() << name << " is out of date: copy " << fresh << " over it";
  }
}

TEST(Schema, AcceptsEveryShippedScene) {
  const Schema schema(scene_schema());
  for (const auto& file : files_below("problems", ".yaml")) {
    EXPECT_TRUE(schema.accepts(as_json(text_of(file)))) << file;
  }
}

TEST(Schema, AcceptsWhatIsWritten) {
  const Schema scenes(scene_schema());
  const Schema plans(plan_schema());
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const SceneFile scene = parse_scene(scene_to_yaml(random_scene(random)), "random");
    EXPECT_TRUE(scenes.accepts(as_json(scene_to_yaml(scene.scene))));
    const Plan plan = random_plan(random, prepare(scene.scene));
    EXPECT_TRUE(plans.accepts(plan_to_json({scene.scene, scene.digest, plan})));
  }
}

TEST(Schema, RejectsEveryFileOfWrongStructure) {
  const Schema scenes(scene_schema());
  const Schema plans(plan_schema());
  int checked = 0;
  for (const auto& file : files_below("tests/io/broken/structure", ".yaml")) {
    EXPECT_FALSE(scenes.accepts(as_json(text_of(file)))) << file;
    EXPECT_NE(message_of([&] { read_scene(file); }), "") << file;
    ++checked;
  }
  for (const auto& file : files_below("tests/io/broken/structure", ".json")) {
    EXPECT_FALSE(plans.accepts(text_of(file))) << file;
    EXPECT_NE(message_of([&] { read_plan(file); }), "") << file;
    ++checked;
  }
  EXPECT_GE(checked, 60);
}

/// One number of a schema with its range.
struct Range {
  std::string path;
  double low, high;
};

void collect_ranges(const json& schema, const std::string& path,
                    std::vector<Range>& ranges) {
  if (schema.contains("minimum") && schema.contains("maximum")) {
    ranges.push_back({path, schema["minimum"], schema["maximum"]});
  }
  if (!schema.contains("properties")) return;
  for (const auto& [key, member] : schema["properties"].items()) {
    collect_ranges(member, internal::join(path, key), ranges);
  }
}

/// A scene in which this field can be set.
std::string scene_around(const std::string& path) {
  std::string shape = "box: {size: [0.1, 0.1, 0.1]}";
  if (path.find("cylinder") != std::string::npos || path.ends_with("roll_deg") ||
      path.ends_with("roll")) {
    shape = "cylinder: {radius: 0.05, length: 0.1, axis: x}";
  }
  if (path.find("prism") != std::string::npos) {
    shape = "prism: {outline: [[-1, -1], [1, -1], [0, 1]], thickness: 0.1}";
  }
  if (path.find("solid") != std::string::npos) {
    shape =
        "solid: {outline: [[-1, -1], [1, -1], [0, 1]], "
        "pad_face: [[-1, -1], [1, -1], [0, 1]], "
        "heights: [[-1, 1], [-1, 1], [-1, 1]], thickness: 0.1, "
        "centroid: [0, 0, 0], spread: [0.1, 0.1, 0.1, 0, 0, 0]}";
  }
  std::string pad = "disc: {radius: 0.01}";
  if (path.find("pad.line") != std::string::npos) pad = "line: {length: 0.01}";
  if (path.find("pad.point") != std::string::npos) pad = "point: {}";
  return "version: 1\nobject: {" + shape + ", mass: 1}\ngripper: {pad: {" + pad +
         "}, friction: 1, grip_force: 1}\ngoal: {x: 0}\n";
}

/// Values out of a field's range are rejected by reader and schema alike; and what lies
/// in its range is never rejected by `check` as a number of that field.
TEST(Schema, RangesAreThoseOfTheScene) {
  const Schema schema(scene_schema());
  std::vector<Range> ranges;
  collect_ranges(json::parse(scene_schema()), "", ranges);
  EXPECT_GE(ranges.size(), 20u);
  for (const Range& range : ranges) {
    const std::string yaml = scene_around(range.path);
    const auto message_with = [&](double value) {
      const std::string set = range.path + '=' + internal::number_text(value);
      return message_of([&] { parse_scene(yaml, "scene", {set}); });
    };
    for (const double end : {range.low, range.high}) {
      const std::string message = message_with(end);
      EXPECT_EQ(message.find(range.path + ": " + internal::number_text(end)),
                std::string::npos)
          << message;
    }
    for (const double beyond :
         {range.low - 1e-3 - 1e-3 * std::abs(range.low), range.high * 1.001}) {
      EXPECT_NE(message_with(beyond).find(range.path + ": "), std::string::npos)
          << range.path << ' ' << beyond;
      internal::Faults faults("scene");
      internal::Value root = internal::parse_yaml(yaml, faults);
      internal::apply_overrides(root, {range.path + '=' + internal::number_text(beyond)},
                                faults);
      EXPECT_FALSE(schema.accepts(internal::to_json(root))) << range.path;
    }
  }
}

}  // namespace
}  // namespace prehensile::testing
