#include "scarp/exec/assembly.hpp"

#include <algorithm>

namespace scarp::exec {

template <int Dim>
void Assembly::rebuild(const Mesh<Dim>& mesh, const ActiveElements& active) {
  for (const int n : node_) position_[n] = -1;
  position_.resize(mesh.nodes.size(), -1);
  // In the order in which the elements touch them, so that sweeps over nodes and elements go through memory alike.
  node_.clear();
  row_ = 0;
  for (const int e : active.element) {
    const auto local = mesh.element_nodes(e);
    row_ = std::max(row_, static_cast<int>(local.size()));
    for (const int n : local) {
      if (position_[n] >= 0) continue;
      position_[n] = size();
      node_.push_back(n);
    }
  }

  begin_.assign(node_.size() + 2, 0);
  for (const int e : active.element) {
    for (const int n : mesh.element_nodes(e)) ++begin_[position_[n] + 2];
  }
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  place_.resize(begin_.back());
  for (int slot = 0; slot < active.size(); ++slot) {
    int place = slot * row_;
    for (const int n : mesh.element_nodes(active.element[slot])) place_[begin_[position_[n] + 1]++] = place++;
  }
  places_ = static_cast<std::size_t>(active.size()) * row_;
}

void Assembly::reserve(std::size_t elements, std::size_t row) {
  node_.reserve(elements * row);
  begin_.reserve(elements * row + 2);
  place_.reserve(elements * row);
}

template void Assembly::rebuild<2>(const Mesh<2>&, const ActiveElements&);
template void Assembly::rebuild<3>(const Mesh<3>&, const ActiveElements&);

}  // namespace scarp::exec
