// What a step did and where it leaves the body. Chunks of elements and nodes keep books of their own, which are added
// up exactly.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "scarp/base/exact_sum.hpp"
#include "scarp/base/vec.hpp"
#include "scarp/exec/stress_update.hpp"
#include "scarp/mesh/locate.hpp"
#include "scarp/step/energies.hpp"

namespace scarp {

/// The parts of a step whose times are taken when asked for.
enum class Phase { points_to_nodes, nodes, velocities, strain_and_move, stress, order, averages };
inline constexpr int phases = 7;
inline constexpr std::array<const char*, phases> phase_names{
    "points to nodes (1)",  "nodes (2, 3, 5)",     "velocities (4, 5)",    "strain, motion, element (6, 8-11)",
    "stress and state (7)", "order of the points", "averages over lengths"};

template <int Dim>
struct StepTotals : Energies {
  double unbalanced_force = 0, weight = 0;  ///< Σ |F_grav − F_int| over free components and Σ |F_grav|, at nodes
  double kinetic_energy_before = 0;         ///< of the points at the start
  double kinetic_energy = 0, mass = 0, max_velocity = 0;  ///< of the points at the end
  Vec<Dim> momentum{};
  double removed_energy = 0, removed_mass = 0;  ///< kinetic energy and mass of points that left the mesh
  std::int64_t removed = 0;
  std::int64_t massless_nodes = 0;                  ///< active nodes that no point has a share in
  std::int64_t changed_element = 0, left_mesh = 0;  ///< points that did
  std::int64_t chunks_without_volume = 0;           ///< with a point whose volume is not positive any more
  exec::StressTotals stress;
  SearchCounts search;
  std::array<double, phases> seconds{};  ///< of each Phase, threads added up; only where asked for

  /// f(number) for each that is a sum over the body.
  template <class Self, class F>
  static void each_sum(Self& totals, F&& f) {
    for (const auto& term : energy_terms) f(totals.*term.sum);
    for (auto* sum :
         {&totals.unbalanced_force, &totals.weight, &totals.kinetic_energy_before, &totals.kinetic_energy, &totals.mass,
          &totals.removed_energy, &totals.removed_mass, &totals.stress.work, &totals.stress.damping})
      f(*sum);
    for (auto& component : totals.momentum) f(component);
  }
  static constexpr std::size_t sums = energy_terms.size() + 9 + Dim;

  /// f({key, unit, meaning}, member) for those that tell how the body is after the step (run/archive.hpp).
  template <class Entry, class Self, class F>
  static void each_saved(Self& t, F&& f) {
    f(Entry{"kinetic_energy", "kJ", "of the points"}, t.kinetic_energy);
    f(Entry{"mass", "Mg", "of the points"}, t.mass);
    f(Entry{"momentum", "Mg m/s", "of the points"}, t.momentum);
    f(Entry{"max_velocity", "m/s", "of the fastest point"}, t.max_velocity);
    f(Entry{"unbalanced_force", "kN", "sum over the nodes of the size of gravity less internal force"},
      t.unbalanced_force);
    f(Entry{"weight", "kN", "sum over the nodes of the size of gravity forces"}, t.weight);
    f(Entry{"substeps", "", "of all stress updates of the step"}, t.stress.substeps);
    f(Entry{"most_substeps", "", "of one stress update of the step"}, t.stress.most_substeps);
    f(Entry{"separated", "", "points that separated in the step"}, t.stress.separated);
    f(Entry{"on_floor", "", "points on the floor of p_c in the step"}, t.stress.on_floor);
    f(Entry{"no_stiffness", "", "points without stiffness in the step"}, t.stress.no_stiffness);
  }

  /// Adds counts, extremes and times, no sums.
  void add_counts(const StepTotals& other);
};

/// Books of many chunks: a part at a time goes to the sums, which are exact, so that they do not depend on the order of
/// the parts, nor on who kept the books of which. Counts, extremes and times gather in the part itself.
template <int Dim>
class alignas(64) BodyTotals {
 public:
  /// Where the next part is booked; its sums are zero.
  StepTotals<Dim>& part() { return part_; }
  const StepTotals<Dim>& part() const { return part_; }
  /// Adds the sums of the part, and makes them zero.
  void close_part() {
    auto* exact = sums_.data();
    StepTotals<Dim>::each_sum(part_, [&](double& sum) {
      if (sum != 0) {
        exact->add(sum);
        sum = 0;
      }
      ++exact;
    });
  }

  BodyTotals& operator+=(const BodyTotals& other);
  /// Of all processes.
  StepTotals<Dim> total() const;

 private:
  StepTotals<Dim> part_;
  std::array<ExactSum, StepTotals<Dim>::sums> sums_;
};

/// Books the time that it lives to a phase, if `on`.
template <int Dim>
class Stopwatch {
  using Clock = std::chrono::steady_clock;

 public:
  Stopwatch(bool on, StepTotals<Dim>& totals, Phase phase)
      : seconds_(on ? &totals.seconds[static_cast<int>(phase)] : nullptr),
        start_(on ? Clock::now() : Clock::time_point{}) {}
  ~Stopwatch() {
    if (seconds_) *seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double* seconds_;
  Clock::time_point start_;
};

}  // namespace scarp
