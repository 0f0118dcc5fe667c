// Fingerprints of files and arrays: XXH3 of 128 bits, which `xxh128sum` prints too. They tell damage and changes, not
// malice.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace scarp {

/// Of pieces one after the other, as 32 hexadecimal digits.
class Hash {
 public:
  Hash();
  ~Hash();
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;

  void add(const void* data, std::size_t bytes);
  std::string digits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string hash_of(const void* data, std::size_t bytes);

/// Of the bytes of a file. Throws InputError where it cannot be read.
std::string hash_of_file(const std::string& path);

}  // namespace scarp
