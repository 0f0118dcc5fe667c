#include "scarp/exec/arrange.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "scarp/exec/parallel.hpp"

namespace scarp::exec {
namespace {

/// to[i] = column[order[i]]
template <class Array>
void permute(const std::vector<int>& order, const Array& column, Array& to) {
  to.resize(column.size());
  for_each(static_cast<int>(order.size()), [&](int i) { to[i] = column[order[i]]; });
}

}  // namespace

template <int Dim>
void arrange_in_order(std::vector<Block<Dim>>& blocks) {
  for (auto& block : blocks) {
    if (std::is_sorted(block.order.begin(), block.order.end())) continue;
    for_each_column(block, [&block]<class Array>(Array& column) {
      auto& arranged = std::get<Array>(block.spare);
      permute(block.order, column, arranged);
      column.swap(arranged);
    });
    std::iota(block.order.begin(), block.order.end(), 0);
  }
}

template <int Dim>
void arrange_in_new_memory(std::vector<Block<Dim>>& blocks) {
  for (auto& block : blocks) {
    for_each_column(block, [&block]<class Array>(Array& column) {
      Array arranged;
      permute(block.order, column, arranged);
      column = std::move(arranged);
    });
    std::iota(block.order.begin(), block.order.end(), 0);
  }
}

template void arrange_in_order<2>(std::vector<Block<2>>&);
template void arrange_in_order<3>(std::vector<Block<3>>&);
template void arrange_in_new_memory<2>(std::vector<Block<2>>&);
template void arrange_in_new_memory<3>(std::vector<Block<3>>&);

}  // namespace scarp::exec
