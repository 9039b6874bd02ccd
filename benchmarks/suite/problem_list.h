/// The problems of a suite, family by family. A problem is made anew whenever it is asked
/// for, the same each time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suite/suite_file.h"

namespace prehensile::suite {

/// Whether a path that exists lies in a folder, links followed.
bool is_below(const std::filesystem::path& folder, const std::filesystem::path& file);

class ProblemList {
 public:
  /// Finds the files that the suite names; throws BadInput where a pattern matches none,
  /// or one that leads out of the folder. `quick`: few problems of each family.
  ProblemList(const SuiteFile& file, bool quick);

  int families() const { return static_cast<int>(families_.size()); }
  const std::string& name(int family) const { return families_[family].name; }
  /// Problems of a family, numbered from 0.
  int count(int family) const { return families_[family].count; }
  int count() const;

  /// Problems that a known sequence of pushes solves.
  bool is_constructed(int family) const { return families_[family].is_constructed; }

  /// The scene of a problem, its goal included. Throws BadInput for files that are no
  /// scenes, and std::runtime_error where the ranges of a family hold no problem.
  Scene scene(int family, int index) const;

  /// "family/17", numbered from 1: for people, and for --only.
  std::string problem_name(int family, int index) const;

 private:
  struct Entry {
    std::string name;
    ProblemSource source;
    std::vector<std::filesystem::path> files;
    int count = 0;
    bool is_constructed = false;
  };
  std::vector<Entry> families_;
};

}  // namespace prehensile::suite
