#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "io/document.h"
#include "mesh/face_pairs.h"
#include "mesh/urdf.h"

namespace prehensile::apps {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string unit = "m";
  bool json = false;
};

/// Without the minus sign of what is shown as zero.
Vec3 rounded(const Vec3& v) {
  return v.unaryExpr([](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; });
}

double metres_of(const std::string& unit) {
  if (unit == "mm") return 0.001;
  if (unit == "cm") return 0.01;
  if (unit == "inch") return 0.0254;
  return 1.0;
}

/// A file, and what can be done with it; `refusal` is empty where jaws can hold it.
struct MeshReport {
  std::string file;
  std::string refusal;
  TriangleMesh mesh;
  MeshProperties properties;
  std::optional<double> mass;
  std::vector<FacePair> pairs;
  std::vector<HeldBody> bodies;          ///< of the pairs
  std::vector<std::string> passed_over;  ///< pairs that cannot be held, and why
};

MeshReport examine(const std::string& file, double unit) {
  MeshReport report;
  report.file = file;
  try {
    report.mesh = read_mesh(file, unit);
    report.properties = properties_of(report.mesh);
    report.mass = mass_beside(file);
    for (const FacePair& pair : find_face_pairs(report.mesh)) {
      try {
        report.bodies.push_back(body_between(report.mesh, pair));
        report.pairs.push_back(pair);
      } catch (const BadMesh& bad) {
        report.passed_over.push_back(pair.name + ": " + bad.what());
      }
    }
    if (report.pairs.empty()) {
      report.refusal = file +
                       ": no two flat faces that look away from each other: expected a "
                       "body that flat jaws can hold";
    }
  } catch (const BadMesh& bad) {
    report.refusal = bad.what();
  }
  return report;
}

std::string describe(const MeshReport& report) {
  std::string out;
  if (report.mesh.triangles.empty()) return "refused: " + report.refusal + '\n';
  out += text("%s: %zu vertices, %zu faces, volume %.4g cm^3", report.file.c_str(),
              report.mesh.vertices.size(), report.mesh.triangles.size(),
              1e6 * report.properties.volume);
  if (report.mass) out += text(", mass %.4g kg (URDF)", *report.mass);
  out += '\n';
  constexpr double kLongest = 2.0;  // [m] of what a gripper holds
  if (const double size = extent(report.mesh.vertices).maxCoeff(); size > kLongest) {
    out +=
        text("  note: %.3g m long: --unit mm, if the file counts in millimetres\n", size);
  }
  for (const std::string& repair : report.mesh.repairs)
    out += "  mended: " + repair + '\n';
  for (const std::string& pair : report.passed_over)
    out += "  passed over: " + pair + '\n';
  if (!report.refusal.empty()) return out + "refused: " + report.refusal + '\n';
  Table table({"pair", "thickness mm", "face mm^2", "closing direction", "centre mm",
               "silhouette mm", "edges"});
  constexpr std::size_t kMostShown = 12;
  const std::size_t shown = std::min(kMostShown, report.pairs.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const FacePair& pair = report.pairs[i];
    const std::vector<Vec2>& outline = report.bodies[i].shape.outline;
    Vec2 low = outline.front();
    Vec2 high = low;
    for (const Vec2& v : outline) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    const Vec3 d = rounded(pair.closing);
    const Vec3 c = 1e-3 * rounded(1e3 * pair.centre);
    table.add({pair.name, text("%.2f", to_mm(pair.thickness)),
               text("%.0f", 1e6 * pair.area),
               text("(%.3f, %.3f, %.3f)", d.x(), d.y(), d.z()),
               text("(%.1f, %.1f, %.1f)", to_mm(c.x()), to_mm(c.y()), to_mm(c.z())),
               text("%.1f x %.1f", to_mm(high.x() - low.x()), to_mm(high.y() - low.y())),
               text("%zu", outline.size())});
  }
  out += table.str();
  if (shown < report.pairs.size()) {
    out +=
        text("  and %zu smaller ones (--json lists all)\n", report.pairs.size() - shown);
  }
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    for (const std::string& note : report.bodies[i].notes) {
      out += "  " + report.pairs[i].name + ": " + note + '\n';
    }
  }
  return out;
}

nlohmann::ordered_json to_json(const MeshReport& report) {
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < report.pairs.size() && i < report.bodies.size(); ++i) {
    const FacePair& pair = report.pairs[i];
    const Eigen::Isometry3d& X_MO = report.bodies[i].X_MO;
    pairs.push_back({{"name", pair.name},
                     {"thickness", number(pair.thickness)},
                     {"area", number(pair.area)},
                     {"closing_direction", numbers(pair.closing)},
                     {"centre", numbers(pair.centre)},
                     {"object_origin", numbers(Vec3(X_MO.translation()))},
                     {"object_x_axis", numbers(Vec3(X_MO.linear().col(0)))},
                     {"notes", report.bodies[i].notes}});
  }
  nlohmann::ordered_json out = {{"file", report.file},
                                {"refusal", report.refusal},
                                {"vertices", report.mesh.vertices.size()},
                                {"faces", report.mesh.triangles.size()},
                                {"repairs", report.mesh.repairs},
                                {"volume", number(report.properties.volume)},
                                {"mass", report.mass ? number(*report.mass) : nullptr},
                                {"passed_over", report.passed_over},
                                {"pairs", pairs}};
  return out;
}

int run(const Options& options) {
  bool all = true;
  nlohmann::ordered_json reports = nlohmann::ordered_json::array();
  for (const std::string& file : options.files) {
    if (!std::filesystem::is_regular_file(file)) {
      throw BadInput(file + ": no such file: expected a mesh (STL or OBJ)");
    }
    const MeshReport report = examine(file, metres_of(options.unit));
    all = all && report.refusal.empty();
    if (options.json) {
      reports.push_back(to_json(report));
    } else {
      std::fputs(describe(report).c_str(), stdout);
    }
  }
  if (options.json) {
    const nlohmann::ordered_json out = {{"meshes", reports}};
    std::printf("%s\n", out.dump(2).c_str());
  }
  return all ? kDone : kNegative;
}

}  // namespace

Command add_mesh(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "mesh", "whether jaws can hold the body of an STL or OBJ file, and where");
  command.add_option("files", options->files, "STL or OBJ files")->required();
  command.add_option("--unit", options->unit, "of the numbers in the files")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
  command.add_flag("--json", options->json, "one JSON object on standard output");
  command.footer("Example:\n  prehensile mesh part.stl --unit mm");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
