/// Files in and out: what is read is limited before it is read, what is written
/// is there in full or not at all.
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/document.h"
#include "io/plan_file.h"

namespace prehensile {
namespace {

namespace fs = std::filesystem;

std::string reason() { return std::strerror(errno); }

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw BadInput(file.string() + ": " + what);
}

/// Closes on every way out.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  return S_ISREG(mode) ? "a file" : "a device, pipe or socket";
}

std::string read_at_most(const Descriptor& in, const fs::path& file, std::size_t limit) {
  std::string text(limit + 1, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got = ::read(in.number(), text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(file, "cannot be read: " + reason());
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  text.resize(size);
  return text;
}

/// The file that a name stands for: a link is followed, so that the file it names is
/// replaced and not the link; and only a file may be replaced, because renaming over a
/// device would destroy it.
fs::path target_of(const fs::path& file) {
  std::error_code ignored;
  fs::path target =
      fs::is_symlink(file, ignored) ? fs::weakly_canonical(file, ignored) : file;
  struct stat status {};
  if (::stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    refuse(file, std::string(kind_of(status.st_mode)) +
                     ": expected a new file or one to replace");
  }
  return target;
}

bool write_all(int number, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t put = ::write(number, text.data() + done, text.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    done += static_cast<std::size_t>(put);
  }
  return ::fsync(number) == 0;
}

/// Permissions of a file that the user makes without saying which.
mode_t usual_permissions() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

}  // namespace

std::string internal::read_text(const fs::path& file, std::size_t limit) {
  // Without O_NONBLOCK a pipe that nobody writes to would hold us for ever.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.number() < 0) refuse(file, "cannot be opened: " + reason());
  struct stat status {};
  if (::fstat(in.number(), &status) != 0) refuse(file, "cannot be read: " + reason());
  if (!S_ISREG(status.st_mode)) {
    refuse(file, std::string(kind_of(status.st_mode)) + ": expected a file");
  }
  const std::string expected =
      " bytes: expected a file of at most " + std::to_string(limit) + " bytes";
  if (status.st_size > static_cast<off_t>(limit)) {
    refuse(file, std::to_string(status.st_size) + expected);
  }
  std::string text = read_at_most(in, file, limit);
  if (text.size() > limit) refuse(file, "more than " + std::to_string(limit) + expected);
  return text;
}

void check_writable(const fs::path& file) {
  const fs::path folder = target_of(file).parent_path();
  const std::string name = folder.empty() ? "." : folder.string();
  struct stat status {};
  if (::stat(name.c_str(), &status) != 0 || ::access(name.c_str(), W_OK | X_OK) != 0) {
    refuse(file, "cannot be written: " + name + ": " + reason());
  }
  if (!S_ISDIR(status.st_mode)) {
    refuse(file, "cannot be written: " + name + ": " + kind_of(status.st_mode) +
                     ": expected a directory");
  }
}

void write_atomically(const fs::path& file, const std::string& text) {
  const fs::path target = target_of(file);
  std::string temporary = target.string() + ".XXXXXX";
  const Descriptor out(::mkstemp(temporary.data()));
  if (out.number() < 0) refuse(file, "cannot be written: " + reason());
  const bool done = write_all(out.number(), text) &&
                    ::fchmod(out.number(), usual_permissions()) == 0 &&
                    ::rename(temporary.c_str(), target.c_str()) == 0;
  if (done) return;
  const std::string why = reason();
  ::unlink(temporary.c_str());
  refuse(file, "cannot be written: " + why);
}

}  // namespace prehensile
