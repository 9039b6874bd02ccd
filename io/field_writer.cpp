#include "io/field_writer.h"

#include <cmath>

#include "scene/constants.h"

namespace prehensile::internal {
namespace {

/// The degrees whose product with kRadPerDeg is exactly this number, if there
/// are any.
std::optional<double> exact_degrees(double radians) {
  const double near = radians / kRadPerDeg;
  for (const double degrees :
       {std::round(near * 1e9) / 1e9, near, std::nextafter(near, -kInfinity),
        std::nextafter(near, kInfinity)}) {
    if (degrees * kRadPerDeg == radians) return degrees;
  }
  return std::nullopt;
}

}  // namespace

void FieldWriter::measured(const char* key, double from, const Bounds&, const char*) {
  map_.add(key, std::isfinite(from) ? Value::plain(number_text(from)) : Value{});
}

void FieldWriter::angle(const std::string& key, double from, const Bounds&, const char*) {
  if (const std::optional<double> degrees = exact_degrees(from)) {
    map_.add(key + "_deg", Value::plain(number_text(*degrees)));
  } else {
    map_.add(key, Value::plain(number_text(from)));
  }
}

void FieldWriter::names(const char* key, const std::vector<std::string>& from, Length,
                        const char*) {
  Value list = Value::list();
  for (const std::string& name : from) list.items.push_back(Value::quoted(name));
  map_.add(key, std::move(list));
}

void FieldWriter::points(const char* key, const std::vector<Vec2>& from, Length,
                         const Bounds&, const char*) {
  Value list = Value::list();
  for (const Vec2& point : from) list.items.push_back(numbers(point));
  map_.add(key, std::move(list));
}

}  // namespace prehensile::internal
