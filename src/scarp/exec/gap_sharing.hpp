// Points of one element share their openings. A point without tensile strength that has opened (material/gap.hpp) and
// whose neighbours in the element carry the load would never close: where all points have the volume strain of their
// element, those that closed first keep it from closing further, and a deposit at rest stays in part without stress and
// larger than it was. What an element resolves is its volume, not how its points divide that among themselves; there
// pressures even out:
//     δ_p = θ (s̄ − s_p) / M,   s̄ = Σ Ω_p s_p / Σ Ω_p,   so that Σ Ω_p δ_p = 0,
// is the volume strain that a point takes from the others in a step, s_p its mean stress in the directions that volume
// strain has, M the modulus of compression waves (mean over points that carry), θ = ½ min(1, c dt / h): as fast as
// waves run through an element. It lasts while a point of the element is open. Pressures that even out cost energy,
// −Σ Ω_p s_p δ_p > 0, which the work of stress counts as spent in the soil.
//
// What is further apart than an element the mesh does not see: a point that has opened by the volume of its element
// opens no further.
#pragma once

#include <vector>

#include "scarp/exec/stress_update.hpp"

namespace scarp::exec {

/// The sharing among points of one block, for a chunk of elements; results do not depend on the chunks.
template <int Dim>
class GapSharing {
 public:
  /// `volume`: Ω_p at the end of the step, the block's own or a trial's. `directions` of volume strain: the first 2 or
  /// 3 normal components. `dt` in s.
  GapSharing(const Block<Dim>& block, Column& volume, PointIncrements<Dim>& increments, int directions, double dt);

  /// Has the law openings to share?
  bool active() const { return column_ >= 0; }

  /// Adds δ_p to the strain increments (from place `at` on) and volumes of the points of an element of the least height
  /// `size` [m], where one of them is open.
  void in_element(PointRange range, double size, int at);

  /// After the stress update, with what it has written: Σ Ω σ : δ, which the work of stress has counted and nodes have
  /// not done.
  double work(const UpdatedColumns<Dim>& after) const;

 private:
  using Tensors = std::array<Column, sym_size<Dim>>;

  /// A point that took volume strain from others.
  struct Taken {
    int point;
    int at;         ///< where its strains are
    double strain;  ///< δ_p, expansion positive
    double felt;    ///< mean stress that nodes felt at the start of the step
  };

  double gap(int p) const { return block_.state[static_cast<std::size_t>(column_)][p]; }
  double mean(const Tensors& sigma, int p) const;
  /// What nodes feel: the mean of σ*, where there is one.
  double felt(const Tensors& sigma, const Tensors& sigma_ahead, int p) const;
  double modulus(int p) const;
  double dilation(int at) const;
  void add(int p, int at, double strain);

  const Block<Dim>& block_;
  Column& volume_;
  PointIncrements<Dim>& increments_;
  int directions_;
  double dt_;
  int column_;  ///< of the gap in the state; −1: the law has none
  std::vector<Taken> taken_;
};

}  // namespace scarp::exec
