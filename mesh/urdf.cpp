#include "mesh/urdf.h"

#include <fstream>
#include <string>
#include <tinyxml2.h>

#include "mesh/triangle_mesh.h"

namespace prehensile {
namespace {

constexpr std::uintmax_t kLargest = 1'000'000;  // bytes

}  // namespace

std::optional<double> mass_beside(const std::filesystem::path& mesh) {
  std::filesystem::path file = mesh;
  file.replace_extension(".urdf");
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kLargest) throw BadMesh(file.string() + ": too large");
  std::ifstream stream(file, std::ios::binary);
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  // Exporters write version="0.0", which is no XML declaration; nothing depends on it.
  if (text.starts_with("<?xml")) text.erase(0, text.find("?>") + 2);

  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw BadMesh(file.string() + ": not XML: expected a robot description");
  }
  std::optional<double> mass;
  const tinyxml2::XMLElement* robot = document.FirstChildElement("robot");
  if (!robot) return std::nullopt;
  for (const auto* link = robot->FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    const auto* inertial = link->FirstChildElement("inertial");
    const auto* element = inertial ? inertial->FirstChildElement("mass") : nullptr;
    double value = 0.0;
    if (!element || element->QueryDoubleAttribute("value", &value) != 0) continue;
    if (mass) return std::nullopt;
    mass = value;
  }
  if (mass && !(*mass > 0.0 && *mass < 1e4)) return std::nullopt;
  return mass;
}

}  // namespace prehensile
