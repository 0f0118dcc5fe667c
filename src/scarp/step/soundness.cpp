#include "scarp/step/soundness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "scarp/base/error.hpp"
#include "scarp/comm/alone.hpp"

namespace scarp::step {
namespace {

/// f(key, column) for each array of numbers of a block.
template <int Dim, class F>
void for_each_number(const Block<Dim>& block, F&& f) {
  Points<Dim>::each(block.points, [&](const PointArray& info, const auto& member) {
    scarp::detail::for_each_in(member, [&]<class Array>(const Array& column) {
      if constexpr (std::is_same_v<Array, Column>) {
        if (!column.empty()) f(info.key, column);
      }
    });
  });
  for (const auto& column : block.state) f("state", column);
}

bool is_finite(const Column& column) {
  // Of the bits, which compare alike: a loop that a compiler takes many numbers at a time in.
  constexpr std::uint64_t infinite = 0x7ff0000000000000u << 1;
  std::uint64_t largest = 0;
  for (const double x : column) largest = std::max(largest, std::bit_cast<std::uint64_t>(x) << 1);
  return largest < infinite;
}

/// The arrays in which a point is not finite.
template <int Dim>
std::vector<std::string> not_finite_at(const Block<Dim>& block, int i) {
  std::vector<std::string> keys;
  for_each_number(block, [&](const char* key, const Column& column) {
    if (!std::isfinite(column[i]) && (keys.empty() || keys.back() != key)) keys.emplace_back(key);
  });
  return keys;
}

/// Where it is, and how fast.
template <int Dim>
std::string place_of(const Points<Dim>& points, int i) {
  Vec<Dim> x, v;
  for (int j = 0; j < Dim; ++j) {
    x[j] = points.x[j][i];
    v[j] = points.v[j][i];
  }
  return fmt::format("at ({:.6g}), with velocity ({:.4g})", fmt::join(x, ", "), fmt::join(v, ", "));
}

/// Throws for the first point of a field, by region and id, of which offends(block, i) is true; explain(block, i) is
/// the error.
template <int Dim, class Offends, class Explain>
void refuse(const VelocityField<Dim>& field, Offends&& offends, Explain&& explain) {
  std::optional<comm::Failure> first;
  for (int b = 0; b < static_cast<int>(field.blocks.size()) && !first; ++b) {
    const auto& block = field.blocks[b];
    int worst = -1;
    for (int i = 0; i < block.size(); ++i) {
      if (offends(block, i) && (worst < 0 || block.points.id[i] < block.points.id[worst])) worst = i;
    }
    if (worst >= 0) first = comm::Failure{b, block.points.id[worst], explain(block, worst)};
  }
  comm::agree(first);
}

template <int Dim>
RunError error_of_not_finite(const Block<Dim>& block, int i) {
  return RunError(
      fmt::format("point {} of region \"{}\" has values that are not finite", block.points.id[i], block.name),
      fmt::format("{}; {}", fmt::join(not_finite_at(block, i), ", "), place_of(block.points, i)),
      "look at the last frames; take a smaller safety in [method], and look at the parameters of the soil "
      "(scarp lab) and at what moves or loads it there");
}

template <int Dim>
void refuse_not_finite(const VelocityField<Dim>& field) {
  bool finite = true;
  for (const auto& block : field.blocks)
    for_each_number(block, [&](const char*, const Column& column) { finite = finite && is_finite(column); });
  if (comm::sum_of_all(std::int64_t{!finite}) == 0) return;
  refuse(
      field, [finite](const auto& block, int i) { return !finite && !not_finite_at(block, i).empty(); },
      error_of_not_finite<Dim>);
}

/// Of points whose stress update has just failed.
template <int Dim>
void refuse_failed_not_finite(const VelocityField<Dim>& field) {
  refuse(
      field,
      [](const auto& block, int i) {
        return (block.points.flags[i] & flag_failed) != 0 && !not_finite_at(block, i).empty();
      },
      error_of_not_finite<Dim>);
}

/// Is the volume of point i out of its bounds? A body made by hand may be without volumes at the start.
template <int Dim>
bool is_stretched(const Points<Dim>& points, int i) {
  const double now = points.volume[i], start = points.initial_volume[i];
  return !(now > 0) || (start > 0 && !(now >= least_stretch * start && now <= most_stretch * start));
}

template <int Dim>
void refuse_stretched(const VelocityField<Dim>& field) {
  refuse(
      field, [](const auto& block, int i) { return is_stretched(block.points, i); },
      [](const auto& block, int i) {
        const double now = block.points.volume[i], start = block.points.initial_volume[i];
        return RunError(
            fmt::format("the volume of point {} of region \"{}\" is {}", block.points.id[i], block.name,
                        now > 0 ? fmt::format("{:.4g} times that at the start", now / start) : "not positive"),
            fmt::format("{:.6g}, {:.6g} at the start (bounds: {:g} and {:g} times that); {}", now, start, least_stretch,
                        most_stretch, place_of(block.points, i)),
            "take a smaller safety in [method], more points in an element, or shape = \"gimp\"");
      });
}

template <int Dim>
void refuse_too_fast(const Body<Dim>& body, const VelocityField<Dim>& field, double dt) {
  const auto elements = [&](const Points<Dim>& points, int i) {
    return std::sqrt(speed2_of(points, i)) * dt / body.mesh->size_of(points.element[i]);
  };
  refuse(
      field, [&](const auto& block, int i) { return elements(block.points, i) > 1; },
      [&](const auto& block, int i) {
        return RunError(
            fmt::format("point {} of region \"{}\" crosses more than an element in a step", block.points.id[i],
                        block.name),
            fmt::format("{:.4g} elements in dt = {:.4g} s; {}", elements(block.points, i), dt,
                        place_of(block.points, i)),
            "look at the last frames; take a smaller safety in [method], and look at what moves or loads it there");
      });
}

/// May a point cross more than an element? The critical time step counts |v|/h of points that have stiffness, so that
/// few steps need more than a look at it.
template <int Dim>
bool may_cross(const Body<Dim>& body, double dt, const StepTotals<Dim>& totals) {
  if (dt <= totals.stress.critical_dt && totals.stress.no_stiffness == 0) return false;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& field : body.fields) {
    for (const double size : field.buffers.size) least = std::min(least, size);
  }
  return totals.max_velocity * dt > comm::least_of_all(least);
}

}  // namespace

template <int Dim>
void refuse_nonsense(Body<Dim>& body, double dt, const StepTotals<Dim>& totals) {
  bool finite = true;
  StepTotals<Dim>::each_sum(totals, [&](double sum) { finite = finite && std::isfinite(sum); });
  const bool crossing = may_cross(body, dt, totals);
  for (auto& field : body.fields) {
    int& age = field.buffers.steps_since_look;
    const bool all = !finite || ++age >= look_every;
    if (all) {
      age = 0;
      refuse_not_finite(field);
    } else if (totals.stress.failures > 0) {
      refuse_failed_not_finite(field);
    }
    if (all || totals.chunks_without_volume > 0) refuse_stretched(field);
    if (crossing) refuse_too_fast(body, field, dt);
  }
  if (!finite) {
    throw RunError("a sum over the body is not finite", "the values of its points are",
                   "look at the last frames, and at the units of what is given");
  }
}

template <int Dim>
void refuse_nowhere(const VelocityField<Dim>& field) {
  refuse(
      field, [](const auto& block, int i) { return block.points.element[i] < 0 && !not_finite_at(block, i).empty(); },
      error_of_not_finite<Dim>);
}

template void refuse_nonsense<2>(Body<2>&, double, const StepTotals<2>&);
template void refuse_nonsense<3>(Body<3>&, double, const StepTotals<3>&);
template void refuse_nowhere<2>(const VelocityField<2>&);
template void refuse_nowhere<3>(const VelocityField<3>&);

}  // namespace scarp::step
