#include "scarp/run/lengths.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "scarp/base/error.hpp"

namespace scarp::run {
namespace {

/// The size of the largest element that holds points of a block [m].
template <int Dim>
double largest_element(const Body<Dim>& body, const Block<Dim>& block) {
  if (body.mesh->grid) return *std::max_element(body.mesh->grid->spacing.begin(), body.mesh->grid->spacing.end());
  double variance = 0;
  for (const int e : std::set<int>(block.points.element.begin(), block.points.element.end()))
    variance = std::max(variance, step::shape_variance(*body.mesh, e));
  return std::sqrt(6 * variance);
}

}  // namespace

template <int Dim>
void refuse_short_lengths(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& material = input.materials[input.regions[r].material];
    if (!(material.length > 0)) continue;
    const double h = largest_element(body, body.blocks()[r]);
    if (material.length >= least_elements * h * (1 - 1e-9)) continue;
    throw InputError(
        fmt::format("the length over which the material \"{}\" softens is at least {:g} elements long in region \"{}\"",
                    material.name, least_elements, input.regions[r].name),
        fmt::format("length = {:g}, with elements of {:.4g} m", material.length, h),
        fmt::format("write length = {:.4g} or more (better {:.4g}), or refine the mesh to elements of {:.4g} m or less",
                    least_elements * h, enough_elements * h, material.length / least_elements),
        material.length_position);
  }
}

template <int Dim>
std::vector<std::string> short_lengths(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  std::vector<std::string> warnings;
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& material = input.materials[input.regions[r].material];
    if (!(material.length > 0)) continue;
    const double h = largest_element(body, body.blocks()[r]);
    if (material.length >= enough_elements * h * (1 - 1e-9)) continue;
    warnings.push_back(fmt::format(
        "the length {:g} of the material \"{}\" spans {:.2g} elements of {:.4g} m in region \"{}\": failure may come "
        "late; {:g} elements are enough",
        material.length, material.name, material.length / h, h, input.regions[r].name, enough_elements));
  }
  return warnings;
}

template void refuse_short_lengths<2>(const input::CaseOf<2>&, const Body<2>&);
template void refuse_short_lengths<3>(const input::CaseOf<3>&, const Body<3>&);
template std::vector<std::string> short_lengths<2>(const input::CaseOf<2>&, const Body<2>&);
template std::vector<std::string> short_lengths<3>(const input::CaseOf<3>&, const Body<3>&);

}  // namespace scarp::run
