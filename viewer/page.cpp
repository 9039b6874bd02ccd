#include "viewer/page.h"

#include <stdexcept>

#include "viewer/assets.h"

namespace prehensile::viewer {
namespace {

/// Puts `text` in the place of the one `mark` of the template.
void fill(std::string& page, const std::string& mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::runtime_error("viewer: no place for " + mark);
  page.replace(at, mark.size(), text);
}

}  // namespace

std::string json_for_script(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '<') {
      out += "\\u003c";
    } else if (c == '>') {
      out += "\\u003e";
    } else if (c == '&') {
      out += "\\u0026";
    } else if (json.compare(i, 3, "\xe2\x80\xa8") == 0) {
      out += "\\u2028";
      i += 2;
    } else if (json.compare(i, 3, "\xe2\x80\xa9") == 0) {
      out += "\\u2029";
      i += 2;
    } else {
      out += c;
    }
  }
  return out;
}

std::string html_text(const std::string& words) {
  std::string out;
  for (const char c : words) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string page_of_words(const std::string& title, const std::string& words) {
  std::string out = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<title><!--title--></title>
<style>
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 44rem; margin: 4rem auto; padding: 0 1rem; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; border-left: 4px solid #c9453b; padding: .5rem 1rem; }
</style>
</head>
<body>
<h1><!--title--></h1>
<pre><!--words--></pre>
</body>
</html>
)";
  for (int i = 0; i < 2; ++i) fill(out, "<!--title-->", html_text(title));
  fill(out, "<!--words-->", html_text(words));
  return out;
}

std::string page(const std::string& title, const std::vector<std::string>& films) {
  std::string data = "[";
  for (const std::string& film : films) {
    if (data.size() > 1) data += ',';
    data += film;
  }
  data += "]";
  // The data goes in last: what it holds is never looked at for marks.
  std::string out(kTemplate);
  fill(out, "<!--style-->", std::string(kStyle));
  fill(out, "<!--licence-->", html_text(std::string(kLicence)));
  fill(out, "<!--script-->", std::string(kScript));
  fill(out, "<!--title-->", html_text(title));
  const std::size_t at = out.find("<!--data-->");
  if (at == std::string::npos) throw std::runtime_error("viewer: no place for the data");
  out.replace(at, 11, json_for_script(data));
  return out;
}

}  // namespace prehensile::viewer
