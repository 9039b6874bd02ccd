/// Short words for MJCF elements. Internal to mjcf.
#pragma once

#include <string>
#include <tinyxml2.h>
#include <vector>

#include <Eigen/Geometry>

#include "scene/frames.h"

namespace prehensile::mjcf {

using tinyxml2::XMLElement;

std::string text(double value);
std::string text(const std::vector<double>& values);

XMLElement* child(XMLElement* parent, const char* kind);

void set(XMLElement* element, const char* name, const std::string& value);
void set(XMLElement* element, const char* name, double value);
void set(XMLElement* element, const char* name, const Vec3& value);
/// As MuJoCo has it: w, x, y, z.
void set(XMLElement* element, const char* name, const Eigen::Quaterniond& value);

/// The values of a quaternion in that order.
std::vector<double> wxyz(const Eigen::Quaterniond& q);

Eigen::Quaterniond about_z(double angle);

XMLElement* add_body(XMLElement* parent, const std::string& name, const Vec3& at);

/// Of a body whose weight must not matter: the inertia is that of its joints.
void add_light_inertia(XMLElement* body);

/// A geom with a name: what contact pairs refer to.
XMLElement* add_geom(XMLElement* body, const std::string& name, const char* type);

/// A box between two corners.
XMLElement* add_box(XMLElement* body, const std::string& name, const Vec3& centre,
                    const Vec3& half);

/// A geom that is only looked at.
XMLElement* add_look(XMLElement* body, const char* type, const char* rgba);

}  // namespace prehensile::mjcf
