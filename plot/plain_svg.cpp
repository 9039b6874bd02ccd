#include "plot/plain_svg.h"

#include <algorithm>
#include <array>
#include <vector>

namespace prehensile::plot {
namespace {

constexpr std::array<std::string_view, 9> kElements = {
    "svg", "g", "rect", "line", "path", "text", "title", "clipPath", "pattern"};
constexpr std::array<std::string_view, 29> kAttributes = {"xmlns",
                                                          "width",
                                                          "height",
                                                          "viewBox",
                                                          "font-family",
                                                          "font-size",
                                                          "font-weight",
                                                          "text-anchor",
                                                          "x",
                                                          "y",
                                                          "x1",
                                                          "y1",
                                                          "x2",
                                                          "y2",
                                                          "d",
                                                          "fill",
                                                          "fill-opacity",
                                                          "stroke",
                                                          "stroke-width",
                                                          "stroke-dasharray",
                                                          "stroke-opacity",
                                                          "stroke-linejoin",
                                                          "stroke-linecap",
                                                          "transform",
                                                          "clip-path",
                                                          "id",
                                                          "shape-rendering",
                                                          "patternUnits",
                                                          "opacity"};
constexpr std::array<std::string_view, 4> kEntities = {"amp", "lt", "gt", "quot"};
constexpr std::string_view kNamespace = "http://www.w3.org/2000/svg";

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& known, std::string_view word) {
  return std::find(known.begin(), known.end(), word) != known.end();
}

bool is_id(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           c == '_' || c == '-';
  });
}

/// Reads a chart from the front.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  std::string fault() {
    take("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    while (fault_.empty() && !rest_.empty()) {
      if (take("</")) {
        close();
      } else if (take("<")) {
        open();
      } else {
        words(rest_.substr(0, rest_.find('<')));
      }
    }
    if (fault_.empty() && (!open_.empty() || !had_root_)) say("an end too early", "");
    return fault_;
  }

 private:
  bool take(std::string_view piece) {
    if (!rest_.starts_with(piece)) return false;
    rest_.remove_prefix(piece.size());
    return true;
  }

  /// Everything up to the piece, which is passed over.
  std::string_view take_until(std::string_view piece) {
    const std::size_t at = rest_.find(piece);
    if (at == std::string_view::npos) {
      say("an end too early", "");
      return {};
    }
    const std::string_view found = rest_.substr(0, at);
    rest_.remove_prefix(at + piece.size());
    return found;
  }

  void say(const std::string& what, std::string_view where) {
    if (!fault_.empty()) return;
    fault_ = where.empty() ? what : what + ": " + std::string(where.substr(0, 60));
  }

  void close() {
    const std::string_view name = take_until(">");
    if (open_.empty() || open_.back() != name) return say("crossed elements", name);
    open_.pop_back();
  }

  void open() {
    const std::size_t end = rest_.find_first_of(" />\n");
    const std::string_view name = rest_.substr(0, end);
    if (!is_one_of(kElements, name)) return say("an element that charts lack", name);
    const bool is_root = open_.empty();
    if (is_root == had_root_ || is_root != (name == "svg")) return say("a root", name);
    had_root_ = true;
    rest_.remove_prefix(name.size());
    while (fault_.empty() && take(" ")) attribute();
    if (take("/>")) return;
    if (!take(">")) return say("an unclosed element", name);
    open_.push_back(name);
  }

  void attribute() {
    const std::string_view name = take_until("=\"");
    const std::string_view value = take_until("\"");
    if (!is_one_of(kAttributes, name)) return say("an attribute that charts lack", name);
    if (name == "xmlns" && value != kNamespace) return say("a namespace", value);
    if (name == "id" && !is_id(value)) return say("an id", value);
    if (value.find_first_of("<>&\\") != std::string_view::npos) {
      return say("markup in a value", value);
    }
    // Only to a part of the same chart.
    if (name == "xmlns") return;
    const bool is_reference = value.starts_with("url(#") && value.ends_with(")") &&
                              is_id(value.substr(5, value.size() - 6));
    // "rotate(" and its like are all that else opens a bracket.
    const bool opens = value.find('(') != std::string_view::npos && name != "transform";
    if (!is_reference &&
        (opens || value.find_first_of(":;@") != std::string_view::npos)) {
      return say("a value that charts lack", value);
    }
  }

  void words(std::string_view text) {
    const bool is_blank = text.find_first_not_of(" \n") == std::string_view::npos;
    if (!is_blank &&
        (open_.empty() || (open_.back() != "text" && open_.back() != "title"))) {
      return say("words outside of texts", text);
    }
    if (text.find('>') != std::string_view::npos) return say("a bare >", text);
    for (std::size_t at = text.find('&'); at != std::string_view::npos;
         at = text.find('&', at + 1)) {
      const std::string_view name = text.substr(at + 1, text.find(';', at) - at - 1);
      if (!is_one_of(kEntities, name)) return say("a bare ampersand", text.substr(at));
    }
    rest_.remove_prefix(text.size());
  }

  std::string_view rest_;
  std::vector<std::string_view> open_;
  bool had_root_ = false;
  std::string fault_;
};

}  // namespace

std::string fault_of_chart(std::string_view svg) { return Reader(svg).fault(); }

}  // namespace prehensile::plot
