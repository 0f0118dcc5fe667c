#include "scarp/base/hash.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "scarp/base/error.hpp"

// The functions come with the header, so that whoever uses the library needs no other.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace scarp {
namespace {

std::string in_digits(const XXH128_hash_t& hash) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  std::string digits;
  for (const unsigned char byte : bytes.digest) {
    digits += "0123456789abcdef"[byte >> 4];
    digits += "0123456789abcdef"[byte & 15];
  }
  return digits;
}

}  // namespace

struct Hash::State {
  XXH3_state_t xxh;
};

Hash::Hash() : state_(std::make_unique<State>()) {
  XXH3_128bits_reset(&state_->xxh);
}
Hash::~Hash() = default;

void Hash::add(const void* data, std::size_t bytes) {
  if (bytes > 0) XXH3_128bits_update(&state_->xxh, data, bytes);
}

std::string Hash::digits() const {
  return in_digits(XXH3_128bits_digest(&state_->xxh));
}

std::string hash_of(const void* data, std::size_t bytes) {
  return in_digits(XXH3_128bits(data, bytes));
}

std::string hash_of_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  const auto fail = [&] {
    return InputError("the file cannot be read", path + " (" + std::strerror(errno) + ")",
                      "check its name, and that you may read it");
  };
  if (!file) throw fail();
  Hash hash;
  std::array<char, 1 << 16> piece;
  std::size_t count = 0;
  while ((count = std::fread(piece.data(), 1, piece.size(), file.get())) > 0) hash.add(piece.data(), count);
  if (std::ferror(file.get())) throw fail();
  return hash.digits();
}

}  // namespace scarp
