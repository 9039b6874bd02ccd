/// Unpacking of gzip data. Internal to the io layer.
#pragma once

#include <cstddef>
#include <string>

namespace prehensile::internal {

/// What a gzip stream holds; throws BadInput if it is damaged, ends early or unpacks to
/// more than `limit` bytes. `label` names the file.
std::string unpack_gzip(const std::string& packed, std::size_t limit,
                        const std::string& label);

}  // namespace prehensile::internal
