// Several doubles in one SIMD batch and out again, for tests that compare both.
#pragma once

#include <array>
#include <vector>

#include "scarp/material/state.hpp"
#include "scarp/tensor/batch.hpp"
#include "scarp/tensor/sym.hpp"

namespace scarp::test {

inline Batch pack(const std::array<double, batch_lanes>& values) {
  return Batch::load_unaligned(values.data());
}

inline double lane(const Batch& b, std::size_t i) {
  std::array<double, batch_lanes> values;
  b.store_unaligned(values.data());
  return values[i];
}
inline double lane(double x, std::size_t) {
  return x;
}

template <int N>
Sym<Batch, N> pack(const std::array<Sym<double, N>, batch_lanes>& tensors) {
  Sym<Batch, N> r;
  for (int c = 0; c < N; ++c) {
    std::array<double, batch_lanes> values;
    for (std::size_t i = 0; i < batch_lanes; ++i) values[i] = tensors[i][c];
    r[c] = pack(values);
  }
  return r;
}

/// States of several doubles, one in each lane.
template <class Model, int N>
auto packed(const std::array<typename Model::template State<double, N>, batch_lanes>& s) {
  typename Model::template State<Batch, N> many;
  std::array<std::vector<double>, batch_lanes> columns;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    for_each_component([&](const double& x) { columns[i].push_back(x); }, s[i]);
  }
  std::size_t c = 0;
  for_each_component(
      [&](Batch& x) {
        std::array<double, batch_lanes> values;
        for (std::size_t i = 0; i < batch_lanes; ++i) values[i] = columns[i][c];
        x = pack(values);
        ++c;
      },
      many);
  return many;
}

template <class T, int N>
Sym<double, N> lane(const Sym<T, N>& a, std::size_t i) {
  Sym<double, N> r;
  for (int c = 0; c < N; ++c) r[c] = lane(a[c], i);
  return r;
}

}  // namespace scarp::test
