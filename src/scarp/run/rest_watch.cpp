#include "scarp/run/rest_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/base/exact_sum.hpp"
#include "scarp/comm/alone.hpp"

namespace scarp::run {
namespace {

/// f(block, i) for every point.
template <int Dim, class F>
void for_each_point(const Body<Dim>& body, F&& f) {
  for (const auto& block : body.blocks()) {
    for (int i = 0; i < block.size(); ++i) f(block.points, i);
  }
}

}  // namespace

template <int Dim>
double height(const Body<Dim>& body) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for_each_point(body, [&](const auto& points, int i) {
    low = std::min(low, points.x[Dim - 1][i]);
    high = std::max(high, points.x[Dim - 1][i]);
  });
  return std::max(0.0, comm::most_of_all(high) - comm::least_of_all(low));
}

template <int Dim>
double weight_energy(const Body<Dim>& body) {
  ExactSum mass;
  double g2 = 0;
  for_each_point(body, [&](const auto& points, int i) { mass.add(points.mass[i]); });
  for (const double g : body.gravity) g2 += g * g;
  return comm::sum_of_all(mass) * std::sqrt(g2) * height(body);
}

template <int Dim>
RestWatch<Dim>::RestWatch(const input::RestInput& rest, const Body<Dim>& body)
    : rest_(rest), energy_(weight_energy(body)), height_(height(body)), rate_(std::numeric_limits<double>::infinity()) {
  double g2 = 0;
  for (const double g : body.gravity) g2 += g * g;
  // A tenth of the time of a fall: short, but long to a point that vibrates in its place.
  window_ = g2 > 0 ? std::max(rest.hold, 0.1 * std::sqrt(height_ / std::sqrt(g2))) : rest.hold;
}

template <int Dim>
bool RestWatch<Dim>::at_rest(const Ledger<Dim>& ledger, const Body<Dim>& body) {
  if (!(ledger.unbalanced_ratio() <= rest_.unbalanced && kinetic(ledger) <= rest_.kinetic)) {
    watching_ = false;
    return false;
  }
  if (!watching_) {
    watching_ = true;
    calm_for_ = moved_for_ = 0;
    remember(body);
  } else {
    moved_for_ += ledger.dt;
  }
  calm_for_ += ledger.dt;
  if (calm_for_ < window_) return false;
  const double v = moved_for_ > 0 ? largest_path(body) / moved_for_ : ledger.last.max_velocity;
  rate_ = height_ > 0 ? v / height_ : 0;
  if (rate_ <= rest_.rate) return true;
  calm_for_ = moved_for_ = 0;  // it creeps: look at the next window
  remember(body);
  return false;
}

template <int Dim>
void RestWatch<Dim>::remember(const Body<Dim>& body) {
  for_each_point(body, [&](const auto& points, int i) {
    const auto id = static_cast<std::size_t>(points.id[i]);
    if (id >= place_.size()) place_.resize(id + 1);
    place_[id] = position_of(points, i);
  });
}

template <int Dim>
double RestWatch<Dim>::largest_path(const Body<Dim>& body) const {
  double largest2 = 0;
  for_each_point(body, [&](const auto& points, int i) {
    const auto& before = place_[static_cast<std::size_t>(points.id[i])];
    double path2 = 0;
    for (int j = 0; j < Dim; ++j) path2 += (points.x[j][i] - before[j]) * (points.x[j][i] - before[j]);
    largest2 = std::max(largest2, path2);
  });
  return std::sqrt(comm::most_of_all(largest2));
}

template class RestWatch<2>;
template class RestWatch<3>;
template double height<2>(const Body<2>&);
template double height<3>(const Body<3>&);
template double weight_energy<2>(const Body<2>&);
template double weight_energy<3>(const Body<3>&);

}  // namespace scarp::run
