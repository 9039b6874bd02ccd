/// The page: one file of HTML with everything in it, made of a template, the bundled
/// scripts and the data. It loads nothing and runs nothing from the data.
#pragma once

#include <string>
#include <vector>

namespace prehensile::viewer {

/// One or two films, each the JSON of to_json (film_json.h), side by side.
std::string page(const std::string& title, const std::vector<std::string>& films);

/// A page without anything to play: what could not be shown, and why.
std::string page_of_words(const std::string& title, const std::string& words);

/// JSON that may stand inside a script element: no "<", ">", "&" and no line separators
/// are left outside escapes, so nothing in it can end the element.
std::string json_for_script(const std::string& json);

/// Text as character data of HTML.
std::string html_text(const std::string& words);

}  // namespace prehensile::viewer
