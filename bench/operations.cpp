// Counts the floating-point operations of one stress update at a loading point, by running the laws on a number that
// counts: rotation of stress and state, one substep with error control, the wave speed's modulus. +, −, ×, ÷ and roots
// count one, logarithms too; comparisons and selections nothing. Prints JSON, for bench/limits.py.
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "scarp/material/integrate/embedded.hpp"
#include "scarp/material/models.hpp"
#include "scarp/tensor/rotation.hpp"
#include "soil.hpp"

namespace scarp::bench {
namespace {

int operations = 0;

struct Counted {
  double v = 0;
  Counted() = default;
  explicit Counted(double value) : v(value) {}
};

Counted counted(double value) {
  ++operations;
  return Counted(value);
}

Counted operator+(const Counted& a, const Counted& b) {
  return counted(a.v + b.v);
}
Counted operator-(const Counted& a, const Counted& b) {
  return counted(a.v - b.v);
}
Counted operator-(const Counted& a) {
  return Counted(-a.v);
}
Counted operator*(const Counted& a, const Counted& b) {
  return counted(a.v * b.v);
}
Counted operator/(const Counted& a, const Counted& b) {
  return counted(a.v / b.v);
}
bool operator<(const Counted& a, const Counted& b) {
  return a.v < b.v;
}
bool operator>(const Counted& a, const Counted& b) {
  return a.v > b.v;
}
bool operator<=(const Counted& a, const Counted& b) {
  return a.v <= b.v;
}
bool operator>=(const Counted& a, const Counted& b) {
  return a.v >= b.v;
}
bool operator==(const Counted& a, const Counted& b) {
  return a.v == b.v;
}
bool operator!=(const Counted& a, const Counted& b) {
  return a.v != b.v;
}
Counted sqrt(const Counted& a) {
  return counted(std::sqrt(a.v));
}
Counted log(const Counted& a) {
  return counted(std::log(a.v));
}
Counted exp(const Counted& a) {
  return counted(std::exp(a.v));
}
Counted abs(const Counted& a) {
  return Counted(std::abs(a.v));
}
Counted max(const Counted& a, const Counted& b) {
  return a.v > b.v ? a : b;
}
Counted min(const Counted& a, const Counted& b) {
  return a.v < b.v ? a : b;
}
Counted select(bool condition, const Counted& yes, const Counted& no) {
  return condition ? yes : no;
}

/// Operations of one update in N components.
template <int N, class Model>
int count_update(const Model& model) {
  Sym<double, N> sigma = isotropic<double, N>(50.0);
  sigma[N == 4 ? 1 : 2] = 100;
  Values initial;
  if constexpr (std::is_same_v<Model, Subloading>)
    initial = {{"R_b", 2.0}, {"OCR", 1.2}, {"a", 0.5}, {"beta", std::string("K0")}};
  std::vector<Problem> problems;
  const auto start = model.template initial_state<N>(sigma, 100, initial, problems);
  typename Model::template State<Counted, N> s;
  for_each_component([](Counted& x, const double& y) { x = Counted(y); }, s, start);
  Sym<Counted, N> deps;
  for (int j = 0; j < N; ++j) deps[j] = Counted(j == (N == 4 ? 1 : 2) ? 1e-6 : 0.0);
  Spin<Counted, N> spin;
  for (auto& w : spin.w) w = Counted(1e-6);
  operations = 0;
  rotate(model, s, Rotation<Counted, N>(spin));
  const auto trial = attempt<ModifiedEuler>(model, s, Increment<Counted, N>{deps, Counted(1e-4)}, 1e-4);
  if (!trial.flags.sound || !(trial.error.v < 1e-4)) throw std::logic_error("the update needs several substeps");
  (void)model.p_wave_modulus(trial.state);
  return operations;
}

}  // namespace
}  // namespace scarp::bench

int main() {
  using namespace scarp;
  const LinearElastic elastic({1e4, 0.25});
  const Subloading soil = bench::soil();
  std::cout << nlohmann::ordered_json{{"linear-elastic",
                                       {{"2", bench::count_update<4>(elastic)},
                                        {"3", bench::count_update<6>(elastic)}}},
                                      {"subloading",
                                       {{"2", bench::count_update<4>(soil)}, {"3", bench::count_update<6>(soil)}}}}
            << std::endl;
}
