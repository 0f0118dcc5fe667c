// UMATs of our own (tests/data/umat) as models, and what goes wrong with them.
#pragma once

#include <stdexcept>

#include "material/samples.hpp"
#include "scarp/base/error.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {

inline std::string library(const std::string& name) {
  return SCARP_UMATS "/" + name + ".so";
}

inline Record variable(const std::string& name, const std::string& kind = "scalar") {
  return {{{"name", name}, {"kind", kind}}};
}

inline Umat umat(const std::string& name, const std::vector<double>& constants, const std::vector<Record>& state = {},
                 const Values& more = {}) {
  Values settings{{"library", library(name)}, {"constants", constants}, {"state", state}};
  for (const auto& [key, value] : more) settings[key] = value;
  return std::get<Umat>(made("umat", {}, settings));
}

template <int N>
Umat::State<double, N> start(const Umat& model, const Sym<double, N>& sigma, const Values& keys = {}) {
  std::vector<Problem> problems;
  const auto s = model.initial_state<N>(sigma, sigma[1], keys, problems);
  if (!problems.empty()) throw std::invalid_argument(problems[0].what + "; " + problems[0].value);
  return s;
}

template <int N>
Sym<double, N> some_stress() {
  Sym<double, N> sigma = Sym<double, N>::zero();
  for (int i = 0; i < 4; ++i) sigma[i] = std::array<double, 4>{62, 100, 66, 9}[static_cast<std::size_t>(i)];
  return sigma;
}

/// The error of an increment of strain.
inline std::string error_of(const Umat& model, Umat::State<double, 4> s) {
  try {
    attempt<ModifiedEuler>(model, s, Sym<double, 4>{{0, 1e-3, 0, 0}}, 1e-4);
  } catch (const RunError& error) {
    return error.what();
  }
  return "no error";
}
inline std::string error_of(const Umat& model) {
  return error_of(model, start<4>(model, some_stress<4>()));
}

/// The first problem with an initial state.
inline Problem problem_of(const Umat& model, const Values& keys = {}) {
  std::vector<Problem> problems;
  model.initial_state<4>(some_stress<4>(), 100, keys, problems);
  return problems.empty() ? Problem{} : problems.front();
}

}  // namespace scarp::test
