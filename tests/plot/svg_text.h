/// Judges SVG text: a small reader of XML, strict about what the charts use.
#pragma once

#include <string>
#include <vector>

namespace prehensile::plot::testing {

/// The first thing that is wrong with the text as XML: unclosed or crossed tags, bare
/// markup, unquoted or repeated attributes, or a number that is none ("nan", "inf");
/// empty if it is well formed.
inline std::string fault_of_svg(const std::string& text) {
  std::vector<std::string> open;
  std::size_t i = 0;
  const auto near = [&](const char* what) {
    std::string out = what;
    out += " near: ";
    return out + text.substr(i, 60);
  };
  if (text.starts_with("<?xml")) i = text.find("?>") + 2;
  bool had_root = false;
  while (i < text.size()) {
    if (text[i] != '<') {
      const std::size_t end = std::min(text.find('<', i), text.size());
      const std::string words = text.substr(i, end - i);
      for (std::size_t k = words.find('&'); k != std::string::npos;
           k = words.find('&', k + 1)) {
        const std::string entity = words.substr(k, words.find(';', k) - k + 1);
        if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" &&
            entity != "&quot;") {
          return near("bare ampersand");
        }
      }
      if (words.find('>') != std::string::npos) return near("bare >");
      if (open.empty() && words.find_first_not_of(" \n") != std::string::npos) {
        return near("text outside the root");
      }
      i = end;
      continue;
    }
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos) return near("unclosed tag");
    std::string tag = text.substr(i + 1, end - i - 1);
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) return near("crossed tags");
      open.pop_back();
      i = end + 1;
      continue;
    }
    const bool closed = tag.ends_with('/');
    if (closed) tag.pop_back();
    const std::size_t name_end = std::min(tag.find(' '), tag.size());
    const std::string name = tag.substr(0, name_end);
    std::vector<std::string> seen;
    std::size_t k = name_end;
    while (k < tag.size()) {
      if (tag[k] == ' ') {
        ++k;
        continue;
      }
      const std::size_t equals = tag.find("=\"", k);
      if (equals == std::string::npos) return near("attribute without value");
      const std::size_t close = tag.find('"', equals + 2);
      if (close == std::string::npos) return near("open quote");
      const std::string key = tag.substr(k, equals - k);
      const std::string value = tag.substr(equals + 2, close - equals - 2);
      for (const std::string& other : seen) {
        if (other == key) return near("repeated attribute");
      }
      if (value.find('<') != std::string::npos) return near("bare < in an attribute");
      const bool numeric = key != "id" && key != "font-family" && key != "font-weight" &&
                           key != "text-anchor" && key != "patternUnits";
      if (numeric && (value.find("nan") != std::string::npos ||
                      value.find("inf") != std::string::npos)) {
        return near("not a number");
      }
      seen.push_back(key);
      k = close + 1;
    }
    if (open.empty() && had_root) return near("second root");
    had_root = true;
    if (!closed) open.push_back(name);
    i = end + 1;
  }
  if (!open.empty()) return "never closed: " + open.back();
  return had_root ? "" : "no root";
}

/// How often a piece occurs.
inline int count_of(const std::string& text, const std::string& piece) {
  int count = 0;
  for (std::size_t i = text.find(piece); i != std::string::npos;
       i = text.find(piece, i + piece.size())) {
    ++count;
  }
  return count;
}

}  // namespace prehensile::plot::testing
