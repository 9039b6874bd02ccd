/// The CSV that a benchmark writes: a file, or standard output.
#pragma once

#include <cstdio>

namespace prehensile::benchmarks {

class CsvFile {
 public:
  /// `file` null: standard output. Says on standard error if it cannot be opened.
  explicit CsvFile(const char* file)
      : file_(file), out_(file ? std::fopen(file, "w") : stdout) {
    if (!out_) say_not_written();
  }
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  ~CsvFile() {
    if (out_ && out_ != stdout) std::fclose(out_);
  }

  /// Null if it cannot be written to.
  std::FILE* get() const { return out_; }

  /// Ends the writing; false, with a message, if anything did not reach the file.
  bool close() {
    bool written = std::ferror(out_) == 0 && std::fflush(out_) == 0;
    if (out_ != stdout) written = std::fclose(out_) == 0 && written;
    out_ = nullptr;
    if (!written) say_not_written();
    return written;
  }

 private:
  void say_not_written() const {
    std::fprintf(stderr, "error: cannot write %s\n", file_ ? file_ : "standard output");
  }

  const char* file_;
  std::FILE* out_;
};

}  // namespace prehensile::benchmarks
