#include "scarp/run/history.hpp"

#include <algorithm>

namespace scarp::run {
namespace {

/// Has this case use for a term of the energies?
template <int Dim>
bool is_used(const EnergyTerm& term, const input::CaseOf<Dim>& input) {
  const auto any = [](const auto& items, auto&& has) { return std::any_of(items.begin(), items.end(), has); };
  switch (term.use) {
    case EnergyTerm::Use::release:
      return any(input.stages, [](const auto& stage) { return stage.release > 0; });
    case EnergyTerm::Use::absorbing:
      return any(input.boundaries, [](const auto& boundary) { return boundary.absorbing.has_value(); });
    case EnergyTerm::Use::interaction:
      return false;  // no case has two fields yet
    default:
      return true;
  }
}

}  // namespace

template <int Dim>
std::vector<HistoryColumn<Dim>> history_columns(const input::CaseOf<Dim>& input) {
  using At = const Moment<Dim>&;
  std::vector<HistoryColumn<Dim>> columns;
  const auto add = [&](const char* key, const char* unit, const char* meaning, auto value) {
    columns.push_back({key, unit, meaning, value});
  };
  const auto add_energies = [&](bool in_balance) {
    for (const auto& term : energy_terms) {
      if ((term.sign != 0) == in_balance && is_used<Dim>(term, input))
        add(term.key, "kJ", term.meaning, [sum = term.sum](At at) { return at.ledger.*sum; });
    }
  };
  const auto number = [](auto n) { return static_cast<double>(n); };
  add("time", "s", "", [](At at) { return at.ledger.time; });
  add("dt", "s", "last time step", [](At at) { return at.ledger.dt; });
  add("stage", "", "number of the stage, from 0", [number](At at) { return number(at.stage); });
  add("points", "", "number of points now", [number](At at) { return number(at.points); });
  add("mass", "Mg", "of the points now", [](At at) { return at.ledger.last.mass; });
  for (int j = 0; j < Dim; ++j) {
    const char* key[] = {"momentum_x", "momentum_y", "momentum_z"};
    add(key[j], "Mg m/s", "of the points now", [j](At at) { return at.ledger.last.momentum[j]; });
  }
  add("kinetic_energy", "kJ", "of the points now", [](At at) { return at.ledger.last.kinetic_energy; });
  add_energies(true);
  add("energy_removed", "kJ", "kinetic energy of removed points, and of `zero_velocity`",
      [](At at) { return at.ledger.removed_kinetic_energy; });
  add("energy_error", "kJ", "kinetic energy that nobody accounts for", [](At at) { return at.ledger.energy_error(); });
  add_energies(false);
  add("max_velocity", "m/s", "of the fastest point", [](At at) { return at.ledger.last.max_velocity; });
  add("unbalanced_ratio", "–", "unbalanced over gravity forces ([theory.md](theory.md#at-rest)), last step",
      [](At at) { return at.ledger.unbalanced_ratio(); });
  add("substeps_mean", "–", "accepted substeps per point, last step",
      [number](At at) { return at.points > 0 ? number(at.ledger.last.stress.substeps) / at.points : 0.0; });
  add("substeps_max", "–", "most substeps of a point, last step",
      [number](At at) { return number(at.ledger.last.stress.most_substeps); });
  add("failures", "", "failed stress updates since the start of the run",
      [number](At at) { return number(at.ledger.failures); });
  add("corrected", "", "stresses pulled back since the start of the run",
      [number](At at) { return number(at.ledger.corrected); });
  add("separated", "", "points separated in the last step",
      [number](At at) { return number(at.ledger.last.stress.separated); });
  add("on_floor", "", "points on the floor of $p_c$ in the last step",
      [number](At at) { return number(at.ledger.last.stress.on_floor); });
  add("no_stiffness", "", "points without stiffness in the last step; they do not limit the time step",
      [number](At at) { return number(at.ledger.last.stress.no_stiffness); });
  add("removed_points", "", "points cut away or gone from the mesh since the start of the run",
      [number](At at) { return number(at.ledger.removed_points); });
  return columns;
}

template std::vector<HistoryColumn<2>> history_columns<2>(const input::CaseOf<2>&);
template std::vector<HistoryColumn<3>> history_columns<3>(const input::CaseOf<3>&);

}  // namespace scarp::run
