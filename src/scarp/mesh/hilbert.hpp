// The Hilbert curve: an order of the cells of a square or cube in which neighbours on the curve are neighbours in
// space.
#pragma once

#include <array>
#include <cstdint>

namespace scarp {

/// Most levels that places of 64 bits have room for.
template <int Dim>
inline constexpr int most_hilbert_levels = Dim == 2 ? 31 : 21;

/// Place of a cell, of 2^levels cells a side, on the curve (D. Hilbert, Math. Ann. 38 (1891) 459): at each level the
/// quadrants follow as (0,0), (0,1), (1,1), (1,0), the first and last of them turned.
std::uint64_t hilbert_place(std::array<std::uint32_t, 2> cell, int levels);

/// The same in space, where the eight parts of a cube follow in the order of a Gray code, so that each shares a face
/// with the next; each part is mirrored and has axes exchanged so that its curve begins where the last one ended
/// (J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707 (2004) 381).
std::uint64_t hilbert_place(std::array<std::uint32_t, 3> cell, int levels);

}  // namespace scarp
