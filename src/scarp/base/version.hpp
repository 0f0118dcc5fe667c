// The version of the program, which CMakeLists.txt reads from here, and the processors that it was compiled for.
#pragma once

namespace scarp {

inline constexpr const char* version = "0.1.0";

/// The level of x86-64 (of its System V ABI) that this code needs, as far as it makes a difference here.
constexpr const char* instruction_set() {
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && \
    defined(__AVX512VL__)
  return "x86-64-v4, AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
  return "x86-64-v3, AVX2";
#else
  return "x86-64";
#endif
}

}  // namespace scarp
