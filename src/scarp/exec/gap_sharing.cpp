#include "scarp/exec/gap_sharing.hpp"

#include <algorithm>
#include <cmath>

#include "scarp/material/plastic_state.hpp"

namespace scarp::exec {
namespace {

/// The column of the gap among those of a block's state; −1 where the law has none.
template <int N>
int gap_column(const AnyModel& any) {
  return std::visit(
      []<class Model>(const Model&) {
        typename Model::template State<double, N> s;
        int column = -1;
        if constexpr (HasGap<decltype(s)>) {
          int c = -N;
          for_each_component(
              [&](double& x) {
                if (&x == &s.gap) column = c;
                ++c;
              },
              s);
        }
        return column;
      },
      any);
}

}  // namespace

template <int Dim>
GapSharing<Dim>::GapSharing(const Block<Dim>& block, Column& volume, PointIncrements<Dim>& increments, int directions,
                            double dt)
    : block_(block),
      volume_(volume),
      increments_(increments),
      directions_(directions),
      dt_(dt),
      column_(gap_column<sym_size<Dim>>(block.model)) {}

template <int Dim>
double GapSharing<Dim>::mean(const Tensors& sigma, int p) const {
  double sum = 0;
  for (int j = 0; j < directions_; ++j) sum += sigma[j][p];
  return sum / directions_;
}

template <int Dim>
double GapSharing<Dim>::felt(const Tensors& sigma, const Tensors& sigma_ahead, int p) const {
  return mean(sigma_ahead[0].empty() ? sigma : sigma_ahead, p);
}

template <int Dim>
double GapSharing<Dim>::modulus(int p) const {
  double M = 0;
  with_state(block_, p, [&](const auto& model, const auto& state) { M = model.p_wave_modulus(state); });
  return M;
}

template <int Dim>
double GapSharing<Dim>::dilation(int at) const {
  double sum = 0;
  for (int j = 0; j < directions_; ++j) sum += increments_.deps[j][at];
  return sum;
}

template <int Dim>
void GapSharing<Dim>::add(int p, int at, double strain) {
  volume_[p] *= std::exp(strain);
  increments_.per_mass[at] *= std::exp(strain);
  increments_.volume[at] *= std::exp(0.5 * strain);
  for (int j = 0; j < directions_; ++j) increments_.deps[j][at] += strain / directions_;
}

template <int Dim>
void GapSharing<Dim>::in_element(PointRange range, double size, int at) {
  const int* end = range.order + range.count;
  if (std::none_of(range.order, end, [&](int p) { return gap(p) > 0; })) return;
  const auto& points = block_.points;
  double volume = 0, stress = 0, carrying = 0, M = 0, per_mass = 0;
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    const double Omega = volume_[p];
    volume += Omega;
    stress += Omega * mean(points.sigma, p);
    per_mass += Omega * increments_.per_mass[at + k];
    if (gap(p) > 0) continue;
    carrying += Omega;
    M += Omega * modulus(p);
  }
  const double of_element = std::pow(size, Dim);
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    const double opened = volume_[p] * (1 - volume_when_closed(gap(p)));
    if (opened > of_element * (directions_ > Dim ? points.x[0][p] : 1))  // of a ring: by its radius
      add(p, at + k, -std::max(0.0, dilation(at + k)));
  }
  if (!(M > 0)) return;
  M /= carrying;
  const double theta = 0.5 * std::min(1.0, dt_ * std::sqrt(M * per_mass / volume));
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    const double strain = theta * (stress / volume - mean(points.sigma, p)) / M;
    taken_.push_back({p, at + k, strain, felt(points.sigma, points.sigma_ahead, p)});
    add(p, at + k, strain);
  }
}

template <int Dim>
double GapSharing<Dim>::work(const UpdatedColumns<Dim>& after) const {
  double work = 0;
  for (const auto& t : taken_)
    work += increments_.volume[t.at] * 0.5 * (t.felt + felt(after.sigma, after.sigma_ahead, t.point)) * t.strain;
  return work;
}

template class GapSharing<2>;
template class GapSharing<3>;

}  // namespace scarp::exec
