/// The command line of a benchmark: options that take a value, and --quick.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string>
#include <variant>

namespace prehensile::benchmarks {

/// An option by its name, the variable that its value goes to, and for numbers the range:
/// whole, from `least` to a billion.
struct Option {
  const char* name;
  std::variant<int*, std::uint64_t*, const char**, std::string*> into;
  long long least = 0;
};

inline bool set_option(const Option& option, const char* value) {
  if (auto* const* text = std::get_if<const char**>(&option.into)) {
    **text = value;
    return true;
  }
  if (auto* const* text = std::get_if<std::string*>(&option.into)) {
    **text = value;
    return true;
  }
  constexpr long long kMost = 1'000'000'000;
  char* end = nullptr;
  const long long number = std::strtoll(value, &end, 10);
  if (end == value || *end != '\0' || number < option.least || number > kMost) {
    return false;
  }
  if (auto* const* whole = std::get_if<int*>(&option.into)) {
    **whole = static_cast<int>(number);
  } else if (auto* const* seed = std::get_if<std::uint64_t*>(&option.into)) {
    **seed = static_cast<std::uint64_t>(number);
  }
  return true;
}

/// Sets what the arguments say, in their order; --quick calls `make_quick`. False for an
/// unknown option, a missing value, and a number that is none or out of range.
template <typename MakeQuick>
bool take_options(int count, char** arguments, std::initializer_list<Option> options,
                  const MakeQuick& make_quick) {
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--quick") == 0) {
      make_quick();
      continue;
    }
    bool known = false;
    for (const Option& option : options) {
      if (std::strcmp(arguments[i], option.name) != 0) continue;
      known = i + 1 < count && set_option(option, arguments[i + 1]);
      break;
    }
    if (!known) return false;
    ++i;
  }
  return true;
}

}  // namespace prehensile::benchmarks
