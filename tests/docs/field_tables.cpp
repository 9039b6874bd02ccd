#include "tests/docs/field_tables.h"

#include <cmath>
#include <set>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kBegin = "<!-- fields of ";
constexpr std::string_view kEnd = "<!-- end of fields -->";

/// As short as it can be read back to five digits: 0.001, 1e-06, 57.296.
std::string short_number(double value) {
  std::ostringstream out;
  out.precision(5);
  out << value;
  return out.str();
}

std::string as_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return short_number(value);
  if (!value.is_array()) return value.dump();
  std::string text = "[";
  for (const Json& member : value) {
    text += (text.size() > 1 ? ", " : "") + as_text(member);
  }
  return text + ']';
}

std::string code(const std::string& text) { return '`' + text + '`'; }

/// "0 to 4", "at least 1", or nothing.
std::string range_of(const Json& schema) {
  const bool low = schema.contains("minimum");
  const bool high = schema.contains("maximum");
  if (low && high) {
    return as_text(schema["minimum"]) + " to " + as_text(schema["maximum"]);
  }
  return low ? "at least " + as_text(schema["minimum"]) : "";
}

std::string with_range(const std::string& what, const Json& schema) {
  const std::string range = range_of(schema);
  return range.empty() ? what : what + ", " + range;
}

bool is_map(const Json& schema) { return schema.contains("properties"); }

std::string count_of(const Json& list) {
  const auto least = list.at("minItems").get<long>();
  const auto most = list.at("maxItems").get<long>();
  if (least == most) return std::to_string(least);
  if (least == 0) return "up to " + std::to_string(most);
  return std::to_string(least) + (most == least + 1 ? " or " : " to ") +
         std::to_string(most);
}

std::string value_of(const Json& schema);

std::string list_of(const Json& schema) {
  const Json& member = schema.at("items");
  const std::string count = count_of(schema);
  if (is_map(member)) return count + " maps, see below";
  const std::string type = member.at("type");
  if (type == "string") return count + " words";
  if (type == "array") {
    return count + " pairs of numbers" +
           (range_of(member.at("items")).empty() ? ""
                                                 : ", " + range_of(member.at("items")));
  }
  return with_range(count + " numbers", member);
}

std::string value_of(const Json& schema) {
  if (schema.contains("const")) return code(as_text(schema["const"]));
  if (schema.contains("enum")) {
    std::string words;
    for (const Json& word : schema["enum"]) {
      words += (words.empty() ? "" : ", ") + code(as_text(word));
    }
    return words;
  }
  if (schema.contains("oneOf")) {
    std::string ways;
    for (const Json& way : schema["oneOf"]) {
      ways += (ways.empty() ? "" : "; or ") + value_of(way);
    }
    return ways;
  }
  if (is_map(schema))
    return schema["properties"].empty() ? "map, `{}`" : "map, see below";
  const Json& type = schema.at("type");
  if (type.is_array()) return with_range("number or null", schema);
  if (type == "array") return list_of(schema);
  if (type == "integer") return with_range("whole number", schema);
  if (type == "number") return with_range("number", schema);
  return type == "string" ? "text" : type.get<std::string>();
}

/// Descriptions end with their unit: "Radius. [m]".
struct Documented {
  std::string text, unit;
};

Documented taken_apart(const std::string& description) {
  const std::size_t bracket = description.rfind(" [");
  if (bracket == std::string::npos || !description.ends_with(']'))
    return {description, ""};
  return {description.substr(0, bracket),
          description.substr(bracket + 2, description.size() - bracket - 3)};
}

bool is_required(const Json& map, const std::string& key) {
  for (const Json& name : map.value("required", Json::array())) {
    if (name == key) return true;
  }
  return false;
}

/// An angle in radians stands in the row of the same angle in degrees.
bool has_degrees(const Json& fields, const std::string& key) {
  return fields.contains(key + "_deg");
}

std::string row_of(const Json& map, const std::string& key) {
  const Json& field = map["properties"][key];
  const Documented documented = taken_apart(field.at("description"));
  std::string name = code(key);
  if (key.ends_with("_deg") &&
      map["properties"].contains(key.substr(0, key.size() - 4))) {
    name += ", or " + code(key.substr(0, key.size() - 4)) + " in radians";
  }
  std::string value = value_of(field);
  if (!documented.unit.empty()) value += ' ' + documented.unit;
  std::string initial;
  if (is_required(map, key)) initial = "required";
  if (field.contains("default")) {
    const std::string text = as_text(field["default"]);
    initial = text.empty() ? "empty" : code(text);
  }
  return "| " + name + " | " + value + " | " + initial + " | " + documented.text + " |\n";
}

void write_table(const Json& map, const std::string& path, std::string& out) {
  if (!path.empty()) out += '\n' + code(path) + ":\n\n";
  out += "| field | value | default | meaning |\n|---|---|---|---|\n";
  for (const auto& [key, field] : map["properties"].items()) {
    if (!has_degrees(map["properties"], key)) out += row_of(map, key);
  }
  for (const auto& [key, field] : map["properties"].items()) {
    const std::string below = path.empty() ? key : path + '.' + key;
    if (is_map(field) && !field["properties"].empty()) write_table(field, below, out);
    if (field.contains("items") && is_map(field["items"])) {
      write_table(field["items"], below + "[]", out);
    }
  }
}

}  // namespace

std::string field_tables(const std::string& schema) {
  std::string out;
  write_table(Json::parse(schema), "", out);
  return out;
}

std::string with_fresh_tables(const std::string& page) {
  std::string fresh;
  std::size_t from = 0;
  while (true) {
    const std::size_t begin = page.find(kBegin, from);
    if (begin == std::string::npos) return fresh + page.substr(from);
    const std::size_t name = begin + kBegin.size();
    const std::size_t body = page.find(" -->", name);
    const std::size_t end = page.find(kEnd, name);
    if (body == std::string::npos || end == std::string::npos) {
      throw std::runtime_error("a table of fields without end");
    }
    const std::string file = page.substr(name, body - name);
    fresh += page.substr(from, body + 4 - from) + "\n\n" +
             field_tables(read_text(std::string(PREHENSILE_SOURCE_DIR) + '/' + file)) +
             '\n';
    from = end;
  }
}

}  // namespace prehensile::testing
