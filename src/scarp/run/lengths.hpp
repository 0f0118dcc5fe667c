// Internal lengths against the mesh that has to carry them (docs/length.md).
#pragma once

#include <string>
#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// A length spans at least so many elements: fewer do not carry its averages.
inline constexpr double least_elements = 2;
/// With fewer than these a failure is that of the length, but comes late.
inline constexpr double enough_elements = 3;

/// Throws InputError with the place of `length` where a material's is shorter than least_elements of the largest
/// element that holds points of it at the start. An element is as large as the square or cube whose corners' functions
/// spread as much (step::shape_variance): about its height.
template <int Dim>
void refuse_short_lengths(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// One text for each region whose length is allowed, but shorter than enough_elements.
template <int Dim>
std::vector<std::string> short_lengths(const input::CaseOf<Dim>& input, const Body<Dim>& body);

}  // namespace scarp::run
