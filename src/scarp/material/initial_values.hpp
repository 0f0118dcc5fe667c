// Reading the keys of a region's or a test's initial state, for the models that have some.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/tensor/sym.hpp"

namespace scarp::initial {

/// The number under `key`; none where the key is absent, and a problem where it holds something else.
std::optional<double> number(const Values& keys, const std::string& key, std::vector<Problem>& problems);

/// Six tensor components xx, yy, zz, xy, yz, zx (or four, of plane strain) in Mandel components, or a problem.
template <int N>
std::optional<Sym<double, N>> tensor(const std::string& key, const std::vector<double>& list,
                                     std::vector<Problem>& problems);

}  // namespace scarp::initial
