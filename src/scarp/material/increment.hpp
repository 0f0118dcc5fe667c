// What advances a state: a strain increment over a time.
#pragma once

#include "scarp/tensor/sym.hpp"

namespace scarp {

/// Compression positive, as in the laws; dt [s] matters only to laws that depend on time.
template <class T, int N>
struct Increment {
  Sym<T, N> deps;
  T dt;
};

template <class T, int N>
inline Increment<T, N> operator*(const T& share, const Increment<T, N>& i) {
  return {share * i.deps, share * i.dt};
}

/// A strain increment alone is one over no time.
template <class T, int N>
inline Increment<T, N> as_increment(const Sym<T, N>& deps) {
  return {deps, T(0.0)};
}
template <class T, int N>
inline Increment<T, N> as_increment(const Increment<T, N>& i) {
  return i;
}

/// Does the law depend on time? It shows in rate(), or a law with an update of its own says so.
template <class Model>
concept TimeDependent = requires(const Model& m, const typename Model::template State<double, 6>& s,
                                 const Increment<double, 6>& i) {
  m.rate(s, i.deps, i.dt);
}
|| requires {
  requires Model::depends_on_time;
};

/// Does the law bring an integration of its own?
template <class Model>
concept HasUpdate = requires(const Model& m, const typename Model::template State<double, 6>& s,
                             const Increment<double, 6>& i) {
  m.update(s, i, 1e-4);
};

template <class Model, class State, class T, int N>
inline auto rate_of(const Model& model, const State& s, const Increment<T, N>& i) {
  if constexpr (TimeDependent<Model>) {
    return model.rate(s, i.deps, i.dt);
  } else {
    return model.rate(s, i.deps);
  }
}

template <class Model, class State, class T, int N>
inline auto updated(const Model& model, const State& s, const Increment<T, N>& i,
                    double tolerance) requires HasUpdate<Model> {
  return model.update(s, i, tolerance);
}

/// Nothing happens to the law: no strain, and no time where it depends on that.
template <class Model, int N>
inline bool is_idle(const Model&, const Increment<double, N>& i) {
  return dot(i.deps, i.deps) == 0.0 && (!TimeDependent<Model> || i.dt == 0.0);
}

}  // namespace scarp
