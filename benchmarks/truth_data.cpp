#include "benchmarks/truth_data.h"

#include <cmath>
#include <fstream>
#include <libfccp/csv.h>
#include <map>
#include <numbers>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace prehensile::benchmarks {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The plate of the pin and line experiments: a right triangle about its centre of mass.
const std::vector<Vec2> kTriangle = {{-0.05, -0.05}, {0.1, -0.05}, {-0.05, 0.1}};
constexpr int kPointsOfBarePlate = 48;
constexpr double kHalfFingerDistance = 0.025;  // [m]

Plate on_pins(const std::vector<Vec2>& pins) {
  Plate plate{kTriangle, pins, {}};
  plate.shares.assign(pins.size(), 1.0 / static_cast<double>(pins.size()));
  return plate;
}

/// Pins of equal load, named by their places along the legs [mm from the right angle].
Plate plate_of_set(const std::string& set, const std::string& file) {
  if (set.find("patch") != std::string::npos) {
    return uniform_plate(kTriangle, kPointsOfBarePlate);
  }
  if (set.find("10_130_10") != std::string::npos) {
    return on_pins({{-0.04, -0.04}, {0.08, -0.04}, {-0.04, 0.08}});
  }
  if (set.find("30_90_30") != std::string::npos) {
    return on_pins({{-0.02, -0.02}, {0.04, -0.02}, {-0.02, 0.04}});
  }
  throw std::runtime_error(file + ": set " + set +
                           ": expected pins at 10_130_10 or 30_90_30, or patch");
}

json read_json(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  try {
    return json::parse(in);
  } catch (const json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::vector<Vec2> points_of(const json& list) {
  std::vector<Vec2> points;
  for (const json& point : list) {
    points.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
    if (!points.back().allFinite()) throw std::runtime_error("a point is not finite");
  }
  return points;
}

/// Index of the plate with this name, made on first use.
template <class Make>
int plate_index(TipPushes& data, std::map<std::string, int>& known,
                const std::string& name, const Make& make) {
  const auto [entry, is_new] =
      known.try_emplace(name, static_cast<int>(data.plates.size()));
  if (is_new) data.plates.push_back(make());
  return entry->second;
}

}  // namespace

TipPushes read_pin_pushes(const fs::path& folder) {
  const json paths = read_json(folder / "paths.json");
  const std::string file = (folder / "trials.csv").string();
  io::CSVReader<8> csv(file);
  csv.read_header(io::ignore_extra_column, "set", "push", "x0_m", "y0_m", "th0_rad",
                  "x1_m", "y1_m", "th1_rad");
  TipPushes data;
  std::map<std::string, int> plates;
  std::string set, number;
  PlanarPose start, end;
  while (
      csv.read_row(set, number, start.x, start.y, start.theta, end.x, end.y, end.theta)) {
    TipPush push;
    push.recording = set;
    push.plate = plate_index(data, plates, set, [&] { return plate_of_set(set, file); });
    push.X_WO_start = start;
    push.X_WO_end = end;
    for (const Vec2& p : points_of(paths.at(set + '/' + number))) {
      push.path.push_back({p, p});
    }
    data.pushes.push_back(std::move(push));
  }
  return data;
}

TipPushes read_mcube_pushes(const fs::path& folder, int points) {
  const json shapes = read_json(folder / "shapes.json");
  io::CSVReader<18> csv((folder / "pushes.csv").string());
  csv.read_header(io::ignore_extra_column, "surface", "shape", "x0", "y0", "th0", "x1",
                  "y1", "th1", "tx0", "ty0", "tx1", "ty1", "fitell_x1", "fitell_y1",
                  "fitell_th1", "fitp4_x1", "fitp4_y1", "fitp4_th1");
  TipPushes data;
  std::map<std::string, int> plates;
  std::string surface, shape;
  PlanarPose start, end, ellipsoid, quartic;
  Vec2 from, to;
  while (csv.read_row(surface, shape, start.x, start.y, start.theta, end.x, end.y,
                      end.theta, from.x(), from.y(), to.x(), to.y(), ellipsoid.x,
                      ellipsoid.y, ellipsoid.theta, quartic.x, quartic.y,
                      quartic.theta)) {
    const int plate = plate_index(data, plates, shape, [&] {
      return uniform_plate(points_of(shapes.at(shape).at("vertices_m")), points);
    });
    data.pushes.push_back({surface + ' ' + shape,
                           plate,
                           start,
                           end,
                           {{from, from}, {to, to}},
                           {ellipsoid, quartic}});
  }
  return data;
}

LinePushes read_line_pushes(const fs::path& folder) {
  io::CSVReader<15> csv((folder / "trials.csv").string());
  csv.read_header(io::ignore_extra_column, "run", "kind", "px_m", "py_m", "nx", "ny",
                  "cor_x_m", "cor_y_m", "angle_deg_or_mm", "cmd_dx_m", "cmd_dy_m",
                  "cmd_dth_rad", "meas_dx_m", "meas_dy_m", "meas_dth_rad");
  LinePushes data;
  data.plate = on_pins({{-0.02, -0.02}, {0.04, -0.02}, {-0.02, 0.04}});
  std::string run, kind;
  Vec2 p, n, c;
  double amount = 0.0;
  PlanarPose commanded, measured;
  while (csv.read_row(run, kind, p.x(), p.y(), n.x(), n.y(), c.x(), c.y(), amount,
                      commanded.x, commanded.y, commanded.theta, measured.x, measured.y,
                      measured.theta)) {
    LinePush push;
    push.recording = run;
    const Vec2 t = perp(n.normalized());
    push.fingers = {p - kHalfFingerDistance * t, p + kHalfFingerDistance * t};
    if (kind == "rot") {
      push.turn = amount * std::numbers::pi / 180.0;
      push.centre = c;
      push.V_OP << -push.turn * perp(c), push.turn;
    } else {
      push.V_OP << 1e-3 * amount * c.normalized(), 0.0;
    }
    push.commanded = commanded;
    push.measured = measured;
    data.pushes.push_back(push);
  }
  return data;
}

}  // namespace prehensile::benchmarks
