// The soil of the benchmarks.
#pragma once

#include <stdexcept>

#include "scarp/material/models.hpp"

namespace scarp::bench {

/// The full subloading model with every feature at work [kPa].
inline Subloading soil() {
  const auto made = make_model("subloading", {{"kappa", 0.01},
                                              {"lambda", 0.1},
                                              {"nu", 0.25},
                                              {"p_e", 2},
                                              {"M", 1.0},
                                              {"M_c", 1.2},
                                              {"k", 0.714},
                                              {"alpha", 0.9},
                                              {"xi", 0.01},
                                              {"c_R", 20},
                                              {"c_beta", 5},
                                              {"c_b", 5},
                                              {"c_a", 5},
                                              {"R_bf", 1},
                                              {"p_atm", 100}});
  if (!made.model) throw std::logic_error(made.problems.at(0).what);
  return std::get<Subloading>(*made.model);
}

}  // namespace scarp::bench
