#include "io/gzip.h"

#include <algorithm>
#include <limits>
#define ZLIB_CONST  // input is not written to
#include <zlib.h>

#include "io/scene_file.h"

namespace prehensile::internal {
namespace {

constexpr int kGzipWindow = 15 + 16;  // the largest window, gzip wrapper only
constexpr std::size_t kChunk = 1 << 16;

class Unpacker {
 public:
  explicit Unpacker(const std::string& packed) {
    stream_.next_in = reinterpret_cast<const Bytef*>(packed.data());
    stream_.avail_in = static_cast<uInt>(packed.size());
    ready_ = ::inflateInit2(&stream_, kGzipWindow) == Z_OK;
  }
  ~Unpacker() {
    if (ready_) ::inflateEnd(&stream_);
  }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// Appends up to one chunk; returns the library's verdict.
  int append_to(std::string& text) {
    if (!ready_) return Z_MEM_ERROR;
    const std::size_t size = text.size();
    text.resize(size + kChunk);
    stream_.next_out = reinterpret_cast<Bytef*>(text.data() + size);
    stream_.avail_out = kChunk;
    const int verdict = ::inflate(&stream_, Z_NO_FLUSH);
    text.resize(size + kChunk - stream_.avail_out);
    return verdict;
  }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

}  // namespace

std::string unpack_gzip(const std::string& packed, std::size_t limit,
                        const std::string& label) {
  if (packed.size() > std::numeric_limits<uInt>::max()) {
    throw BadInput(label + ": too large to unpack");
  }
  Unpacker unpacker(packed);
  std::string text;
  for (;;) {
    const int verdict = unpacker.append_to(text);
    if (text.size() > limit) {
      throw BadInput(label + ": unpacks to more than " + std::to_string(limit) +
                     " bytes");
    }
    if (verdict == Z_STREAM_END) return text;
    if (verdict != Z_OK) throw BadInput(label + ": not a whole gzip file");
  }
}

}  // namespace prehensile::internal
