// Softening over an internal length (docs/length.md): every few steps the accumulated plastic strain κ of all points
// whose soil has a length is averaged over it, and κ̂ of each point is told how fast to grow until the next time:
//
//   κ′ = min(κ, κ_c),   κ̄′ = G(Σ N κ′ Ω) / G(Σ N Ω) at the corners of elements, by N again to points,
//   κ̂ → max(κ̂, (1 − m) κ′ + m κ̄′ + ⟨κ − κ_c⟩),   m = 2.
//
// G: step/smoothing.hpp; κ_c and what κ̂ does: material/nonlocal.hpp. A uniform κ stays as it is, so that a test on one
// point is the law's. m = 1 would leave plastic strain as free to gather in one row of elements as without a length.
#pragma once

#include <variant>
#include <vector>

#include "scarp/base/column.hpp"
#include "scarp/step/smoothing.hpp"

namespace scarp {

template <int Dim>
struct Body;

/// What the averages over lengths keep from step to step.
template <int Dim>
struct Averages {
  int every = 5;  ///< steps from one average to the next
  int steps = 0;  ///< since the last one

  struct OfLength {
    double length;
    std::variant<step::GridSmoothing<Dim>, step::MeshSmoothing<Dim>> smoothing;
  };
  std::vector<OfLength> lengths;                ///< each that a block has
  Column of_elements, sums, smoothed, scratch;  ///< Σ N κ′ Ω and Σ N Ω: at the corners of each element, at all corners
};

namespace step {

/// Has any soil a length?
template <int Dim>
bool softens_over_length(const Body<Dim>& body);

/// What is done after a step of dt [s] then.
template <int Dim>
void average_softening(Body<Dim>& body, double dt);

}  // namespace step
}  // namespace scarp
