#include "mjcf/elements.h"

#include <cstdio>

namespace prehensile::mjcf {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.12g", value);
  return buffer;
}

std::string text(const std::vector<double>& values) {
  std::string all;
  for (const double value : values) {
    if (!all.empty()) all += ' ';
    all += text(value);
  }
  return all;
}

XMLElement* child(XMLElement* parent, const char* kind) {
  XMLElement* element = parent->GetDocument()->NewElement(kind);
  parent->InsertEndChild(element);
  return element;
}

void set(XMLElement* element, const char* name, const std::string& value) {
  element->SetAttribute(name, value.c_str());
}

void set(XMLElement* element, const char* name, double value) {
  set(element, name, text(value));
}

void set(XMLElement* element, const char* name, const Vec3& value) {
  set(element, name, text({value.x(), value.y(), value.z()}));
}

void set(XMLElement* element, const char* name, const Eigen::Quaterniond& value) {
  set(element, name, text(wxyz(value)));
}

std::vector<double> wxyz(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Quaterniond about_z(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
}

XMLElement* add_body(XMLElement* parent, const std::string& name, const Vec3& at) {
  XMLElement* body = child(parent, "body");
  set(body, "name", name);
  set(body, "pos", at);
  return body;
}

void add_light_inertia(XMLElement* body) {
  constexpr double kLight = 1e-6;  // [kg]
  XMLElement* inertial = child(body, "inertial");
  set(inertial, "pos", Vec3(Vec3::Zero()));
  set(inertial, "mass", kLight);
  set(inertial, "diaginertia", Vec3(Vec3::Constant(1e-3 * kLight)));
}

XMLElement* add_geom(XMLElement* body, const std::string& name, const char* type) {
  XMLElement* geom = child(body, "geom");
  set(geom, "name", name);
  set(geom, "type", std::string(type));
  return geom;
}

XMLElement* add_box(XMLElement* body, const std::string& name, const Vec3& centre,
                    const Vec3& half) {
  XMLElement* box = add_geom(body, name, "box");
  set(box, "pos", centre);
  set(box, "size", half);
  return box;
}

XMLElement* add_look(XMLElement* body, const char* type, const char* rgba) {
  XMLElement* geom = child(body, "geom");
  set(geom, "class", std::string("look"));
  set(geom, "type", std::string(type));
  set(geom, "rgba", std::string(rgba));
  return geom;
}

}  // namespace prehensile::mjcf
