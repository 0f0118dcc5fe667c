#include "scarp/material/initial_values.hpp"

#include <fmt/format.h>

namespace scarp::initial {

std::optional<double> number(const Values& keys, const std::string& key, std::vector<Problem>& problems) {
  const auto found = keys.find(key);
  if (found == keys.end()) return {};
  if (const auto* value = std::get_if<double>(&found->second)) return *value;
  problems.push_back({key, fmt::format("the initial value {} is a number", key), "another type", "write a number"});
  return {};
}

template <int N>
std::optional<Sym<double, N>> tensor(const std::string& key, const std::vector<double>& list,
                                     std::vector<Problem>& problems) {
  const bool six = list.size() == 6, out_of_plane = N == 4 && six && (list[4] != 0 || list[5] != 0);
  if ((!six && list.size() != 4) || (N == 6 && !six) || out_of_plane) {
    problems.push_back({key, fmt::format("{} takes the 6 components xx, yy, zz, xy, yz, zx", key),
                        out_of_plane ? "yz or zx not zero in plane strain" : fmt::format("{} numbers", list.size()),
                        "write the tensor components (not multiplied by 2); yz and zx are 0 in plane strain"});
    return {};
  }
  std::array<double, N> t{};
  for (std::size_t i = 0; i < N; ++i) t[i] = list[i];
  return to_mandel<N>(t);
}

template std::optional<Sym<double, 4>> tensor<4>(const std::string&, const std::vector<double>&, std::vector<Problem>&);
template std::optional<Sym<double, 6>> tensor<6>(const std::string&, const std::vector<double>&, std::vector<Problem>&);

}  // namespace scarp::initial
