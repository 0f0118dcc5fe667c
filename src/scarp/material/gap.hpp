// Points without tensile strength that have parted from the body open: a gap, which has to close before they carry load
// again. Forgotten, the opening would stay as volume of the soil: each cycle of opening and closing would swell it.
//
//   σ = 0 where gap > 0;   gap ≥ 0, the volumetric strain opened, expansion positive (strain is compression positive)
#pragma once

#include "scarp/material/description.hpp"
#include "scarp/tensor/scalar.hpp"

namespace scarp {

/// The gap among a law's state variables.
inline FieldInfo gap_field() {
  return {"gap", "ε_gap", "-",
          "volumetric strain opened at no stress, expansion positive: closes before the point carries load again",
          FieldKind::scalar};
}

/// What becomes of a gap in a straight increment of strain that alone would change it by `growth`.
template <class T>
struct Closing {
  Mask<T> open;   ///< at the start
  Mask<T> stays;  ///< open to the end, or closed just there: none of the increment loads the point
  T share;        ///< of the increment until contact: 1 where it stays, 0 where it was closed
  T gap;          ///< then

  Closing(const T& before, const T& growth)
      : open(before > T(0.0)),
        stays(open && (before + growth >= T(0.0))),
        share(select(open, select(stays, T(1.0), before / select(open && !stays, -growth, T(1.0))), T(0.0))),
        gap(select(stays, before + growth, T(0.0))) {}
};

}  // namespace scarp
