// A SIMD batch of doubles: the scalar that laws run on in the material point method.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "scarp/tensor/scalar.hpp"

namespace scarp {

/// As many doubles as a vector register of the target processor holds.
using Batch = xsimd::batch<double>;
using xsimd::all;
using xsimd::any;

inline constexpr std::size_t batch_lanes = Batch::size;

}  // namespace scarp
