#include "io/field_schema.h"

namespace prehensile::internal {

void FieldSchema::add(const std::string& key, const Json& schema, Need need,
                      const std::string& doc) {
  Json described = {{"description", doc}};
  described.update(schema);
  properties_[key] = described;
  if (need == kRequired) required_.push_back(key);
}

void FieldSchema::angle(const std::string& key, double initial, const Bounds& bounds,
                        const char* doc) {
  add_angle(key, bounds, doc, initial);
}

void FieldSchema::add_angle(const std::string& key, const Bounds& bounds, const char* doc,
                            std::optional<double> initial) {
  const std::string key_deg = key + "_deg";
  const Bounds degrees{bounds.low / kRadPerDeg, bounds.high / kRadPerDeg, "degrees"};
  Json in_degrees = number_schema(degrees);
  if (initial) in_degrees["default"] = std::round(*initial / kRadPerDeg * 1e9) / 1e9;
  add(key_deg, in_degrees, kOptional, with_unit(doc, degrees));
  add(key, number_schema(bounds), kOptional,
      with_unit("The same instead of " + key_deg + '.', bounds));
  rules_.push_back({{"not", {{"required", {key, key_deg}}}}});
}

FieldSchema::Json FieldSchema::take() const {
  Json schema = {
      {"type", "object"}, {"additionalProperties", false}, {"properties", properties_}};
  if (!required_.empty()) schema["required"] = required_;
  if (!rules_.empty()) schema["allOf"] = rules_;
  return schema;
}

FieldSchema::Json FieldSchema::number_schema(const Bounds& bounds) {
  Json schema = {{"type", "number"}};
  if (std::isfinite(bounds.low)) schema["minimum"] = bounds.low;
  if (std::isfinite(bounds.high)) schema["maximum"] = bounds.high;
  return schema;
}

FieldSchema::Json FieldSchema::numbers_schema(std::size_t count, const Bounds& bounds) {
  return list_schema(number_schema(bounds), {count, count});
}

FieldSchema::Json FieldSchema::two_or_three_schema(const Bounds& bounds) {
  return list_schema(number_schema(bounds), {2, 3});
}

FieldSchema::Json FieldSchema::list_schema(const Json& member, Length length) {
  return {{"type", "array"},
          {"items", member},
          {"minItems", length.least},
          {"maxItems", length.most}};
}

FieldSchema::Json FieldSchema::with_default(Json schema, const Json& initial, Need need) {
  if (need == kOptional) schema["default"] = initial;
  return schema;
}

std::string FieldSchema::with_unit(const std::string& doc, const Bounds& bounds) {
  return *bounds.unit ? doc + " [" + bounds.unit + ']' : doc;
}

}  // namespace prehensile::internal
