#include "scarp/base/exact_sum.hpp"

#include <cmath>

namespace scarp {

void ExactSum::carry() {
  for (std::size_t i = 0; i + 1 < limb_.size(); ++i) {
    limb_[i + 1] += limb_[i] >> 32;
    limb_[i] &= static_cast<std::int64_t>(mask);
  }
  since_carry_ = 1;
}

ExactSum& ExactSum::operator+=(const ExactSum& other) {
  for (std::size_t i = 0; i < limb_.size(); ++i) limb_[i] += other.limb_[i];
  not_finite_ += other.not_finite_;
  since_carry_ += other.since_carry_;
  if (since_carry_ >= most_additions) carry();
  return *this;
}

double ExactSum::value() const {
  if (not_finite_ != 0) return not_finite_;  // so is what is no number
  ExactSum sum = *this;
  sum.carry();
  const bool negative = sum.limb_.back() < 0;
  if (negative) {
    for (auto& limb : sum.limb_) limb = -limb;
    sum.carry();
  }
  int last = limbs - 1;
  while (last >= 0 && sum.limb_[last] == 0) --last;
  if (last < 0) return 0;

  // The 64 bits from the first one on, and whether there are any behind them.
  const auto limb = [&](int i) { return i >= 0 ? static_cast<std::uint64_t>(sum.limb_[i]) : std::uint64_t{0}; };
  const int width =
      static_cast<int>(std::bit_width(limb(last)));  // at most 32: the sum of 2^60 numbers has room below the last
  std::uint64_t leading = limb(last) << (64 - width) | limb(last - 1) << (32 - width) | limb(last - 2) >> width;
  bool more = (limb(last - 2) & ((1ull << width) - 1)) != 0;
  for (int i = last - 3; i >= 0 && !more; --i) more = sum.limb_[i] != 0;

  const std::uint64_t rest = leading & 0x7ff, half = 0x400;
  std::uint64_t mantissa = leading >> 11;
  if (rest > half || (rest == half && (more || mantissa % 2 == 1))) ++mantissa;
  const double value = std::ldexp(static_cast<double>(mantissa), 32 * last + width - 53 - 1074);
  return negative ? -value : value;
}

}  // namespace scarp
