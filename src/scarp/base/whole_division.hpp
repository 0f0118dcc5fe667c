// Division of whole numbers by one that stays the same.
#pragma once

#include <bit>
#include <cstdint>

namespace scarp {

/// n / d for 0 ≤ n < 2^31 and one d ≥ 1, exactly, as a product and a shift: a few cycles where a division takes some
/// twenty. With l = ⌈log2 d⌉ and m = ⌈2^(31+l) / d⌉ ≤ 2^32, m n / 2^(31+l) exceeds n/d by less than 1/d (T. Granlund
/// and P. Montgomery, PLDI 1994, theorem 4.2).
class WholeDivision {
 public:
  WholeDivision() : WholeDivision(1) {}
  explicit WholeDivision(int d)
      : shift_(31 + std::bit_width(static_cast<std::uint32_t>(d) - 1)),
        factor_(((std::uint64_t{1} << shift_) + static_cast<std::uint64_t>(d) - 1) / static_cast<std::uint64_t>(d)) {}

  int operator()(int n) const { return static_cast<int>(static_cast<std::uint64_t>(n) * factor_ >> shift_); }

 private:
  int shift_;
  std::uint64_t factor_;
};

}  // namespace scarp
