// Sums of many numbers that are rounded once: the same bits in whatever order, and by however many, they are added.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace scarp {

/// The exact sum of numbers (double), kept as an integer times 2^-1074, the smallest number there is: 68 integers of 64
/// bits hold 32 bits of it each, and the carries that have not been passed on. Room for 2^29 additions between two
/// carries, which it makes by itself, and for 2^60 in all. Infinities and what is no number stay what they would be in
/// a plain sum.
///
/// (The idea: U. Kulisch, W. Miranker, Computer Arithmetic in Theory and Practice, 1981.)
class ExactSum {
 public:
  static constexpr int limbs = 68;

  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t magnitude = bits << 1 >> 1, exponent = magnitude >> 52;
    if (magnitude == 0) return;
    if (exponent == 0x7ff) [[unlikely]] {
      not_finite_ += x;
      return;
    }
    // Mantissa times 2^shift of the unit; numbers below the smallest normal one have no leading 1.
    const std::uint64_t fraction = magnitude & 0xfffffffffffffu;
    const std::uint64_t mantissa = exponent > 0 ? fraction | 1ull << 52 : fraction,
                        shift = exponent > 0 ? exponent - 1 : 0;
    const std::uint64_t off = shift % 32, low = (mantissa & mask) << off, high = (mantissa >> 32) << off;
    const std::int64_t sign = static_cast<std::int64_t>(bits) >> 63;  // 0 or -1
    std::int64_t* limb = limb_.data() + shift / 32;
    limb[0] += (static_cast<std::int64_t>(low & mask) ^ sign) - sign;
    limb[1] += (static_cast<std::int64_t>((low >> 32) + (high & mask)) ^ sign) - sign;
    limb[2] += (static_cast<std::int64_t>(high >> 32) ^ sign) - sign;
    if (++since_carry_ == most_additions) [[unlikely]]
      carry();
  }

  ExactSum& operator+=(const ExactSum& other);

  /// Nearest to the sum, even of two that are as near; infinite beyond the largest number.
  double value() const;

  void clear() { *this = {}; }

 private:
  static constexpr std::uint64_t mask = 0xffffffffu;
  static constexpr std::int64_t most_additions = std::int64_t{1} << 29;

  /// Leaves 32 bits, not negative, in all but the last, which has the sign.
  void carry();

  std::array<std::int64_t, limbs> limb_{};
  std::int64_t since_carry_ = 0;
  double not_finite_ = 0;
};

}  // namespace scarp
