/// Tables of the fields of a file format for people, made from its JSON Schema.
#pragma once

#include <string>

namespace prehensile::testing {

/// One Markdown table for the fields at the top, and one for those of each map or list
/// below. `schema`: text of a JSON Schema as io/field_schema.h writes it.
std::string field_tables(const std::string& schema);

/// The page with what stands between `<!-- fields of FILE -->` and `<!-- end of fields
/// -->` made again from that schema.
std::string with_fresh_tables(const std::string& page);

}  // namespace prehensile::testing
