/// JSON as a tree of values with line numbers.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "io/tree_builder.h"

namespace prehensile::internal {
namespace {

using nlohmann::ordered_json;

/// Walks the text and tells others how far the parser has read.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Cursor(const char* at, const char** latest) : at_(at), latest_(latest) {}
  reference operator*() const { return *at_; }
  Cursor& operator++() {
    *latest_ = at_++;
    return *this;
  }
  friend bool operator==(const Cursor& a, const Cursor& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  const char** latest_;
};

class Handler {
 public:
  Handler(const std::string& text, Faults& faults)
      : builder_(faults), faults_(faults), counted_(text.data()), latest_(text.data()) {}

  bool null() { return scalar(Value{}); }
  bool boolean(bool value) { return scalar(Value::plain(value ? "true" : "false")); }
  bool number_integer(std::int64_t value) {
    return scalar(Value::plain(std::to_string(value)));
  }
  bool number_unsigned(std::uint64_t value) {
    return scalar(Value::plain(std::to_string(value)));
  }
  bool number_float(double, const std::string& text) {
    return scalar(Value::plain(text));
  }
  bool string(std::string& value) { return scalar(Value::quoted(value)); }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return open(Value::map()); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(Value::list()); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    builder_.key(name, place());
    return true;
  }
  template <typename Error>
  bool parse_error(std::size_t, const std::string&, const Error& error) {
    // "[json.exception...] parse error at line 1, column 2: <what>", or without the place
    std::string what = error.what();
    const std::size_t colon = what.find(": ");
    if (colon != std::string::npos) what.erase(0, colon + 2);
    if (what.starts_with('[')) what.erase(0, what.find("] ") + 2);
    const std::size_t read = what.find("; last read");
    if (read != std::string::npos) what.resize(read);
    faults_.fail(place(), builder_.path(),
                 "not JSON: " + shown(what) + ": expected complete JSON");
  }

  const char** latest() { return &latest_; }
  Value take() { return builder_.take(); }

 private:
  /// Line of the token that was read last. Only a number is followed by one
  /// character of look-ahead, which may be the end of its line and is not
  /// counted yet.
  Place place() {
    line_ += static_cast<int>(std::count(counted_, latest_, '\n'));
    counted_ = latest_;
    return {line_, -1};
  }
  bool scalar(Value value) {
    builder_.scalar(std::move(value), place());
    return true;
  }
  bool open(Value value) {
    builder_.open(std::move(value), place());
    return true;
  }
  bool close() {
    builder_.close();
    return true;
  }

  TreeBuilder builder_;
  Faults& faults_;
  const char* counted_;
  const char* latest_;
  int line_ = 1;
};

ordered_json to_tree(const Value& value) {
  switch (value.kind) {
    case Value::Kind::kNull:
      return nullptr;
    case Value::Kind::kPlain: {
      if (ordered_json::accept(value.text)) return ordered_json::parse(value.text);
      double number = 0.0;  // YAML spells some that JSON does not, like .5
      return to_number(value.text, number) ? ordered_json(number)
                                           : ordered_json(value.text);
    }
    case Value::Kind::kText:
      return value.text;
    case Value::Kind::kList: {
      ordered_json list = ordered_json::array();
      for (const Value& item : value.items) list.push_back(to_tree(item));
      return list;
    }
    case Value::Kind::kMap: {
      ordered_json map = ordered_json::object();
      for (const Entry& entry : value.entries) map[entry.key] = to_tree(entry.value);
      return map;
    }
  }
  return {};
}

}  // namespace

Value parse_json(const std::string& text, Faults& faults) {
  check_characters(text, faults);
  Handler handler(text, faults);
  const char* const end = text.data() + text.size();
  ordered_json::sax_parse(Cursor(text.data(), handler.latest()),
                          Cursor(end, handler.latest()), &handler);
  return handler.take();
}

std::string to_json(const Value& value) { return to_tree(value).dump(2) + '\n'; }

}  // namespace prehensile::internal
