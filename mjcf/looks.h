/// What is only looked at: object, pads and pushers as shapes that touch nothing.
/// Internal to mjcf.
#pragma once

#include "mechanics/model.h"
#include "mjcf/elements.h"

namespace prehensile::mjcf {

void show_object(XMLElement* body, XMLElement* asset, const Model& model);

/// Both pads, in H.
void show_pads(XMLElement* hand, XMLElement* asset, const Model& model);

/// A prism as a mesh asset, for geoms that touch or are looked at. `outline` is
/// counter-clockwise in the plane of u and v, and runs from `low` to `high` along w = u x
/// v [m].
void add_prism_asset(XMLElement* asset, const std::string& name,
                     const std::vector<Vec2>& outline, double low, double high,
                     const Vec3& u = Vec3::UnitX(), const Vec3& v = Vec3::UnitY());

/// How far the object reaches from the origin of O in the pad plane [m].
double reach_of(const Model& model);

}  // namespace prehensile::mjcf
