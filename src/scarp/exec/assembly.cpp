#include "scarp/exec/assembly.hpp"

#include <algorithm>

namespace scarp::exec {

template <int Dim>
void Assembly::rebuild(const Mesh<Dim>& mesh, const ActiveElements& active) {
  for (const int n : node_) latest_[n] = {};
  latest_.resize(mesh.node_count());
  row_ = 0;
  for (const int e : active.element) row_ = std::max(row_, static_cast<int>(mesh.element_nodes(e).size()));
  // Nodes in the order in which the elements touch them, so that sweeps over nodes and elements go through memory
  // alike.
  node_.clear();
  of_accumulator_.clear();
  ends_.clear();
  local_.resize(static_cast<std::size_t>(active.size()) * row_);
  nodes_.resize(local_.size());
  int accumulators = 0;
  for (int slot = 0; slot < active.size(); ++slot) {
    if (slot == 0 || active.chunk[slot] != active.chunk[slot - 1]) ends_.push_back({slot, accumulators, size(), 0});
    int* local = local_.data() + static_cast<std::size_t>(slot) * row_;
    int* nodes = nodes_.data() + static_cast<std::size_t>(slot) * row_;
    for (const int n : mesh.element_nodes(active.element[slot])) {
      auto& latest = latest_[n];
      if (latest.position == 0) {
        node_.push_back(n);
        latest.position = size();
      }
      if (latest.accumulator <= ends_.back().accumulator) {  // the chunk has none for this node yet
        latest.accumulator = ++accumulators;
        of_accumulator_.push_back(latest.position - 1);
      }
      *local++ = latest.accumulator - 1;
      *nodes++ = latest.position - 1;
    }
  }
  ends_.push_back({active.size(), accumulators, size(), 0});

  begin_.assign(node_.size() + 2, 0);
  for (const int k : of_accumulator_) ++begin_[k + 2];
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  accumulator_.resize(of_accumulator_.size());
  for (int accumulator = 0; accumulator < accumulators; ++accumulator)
    accumulator_[begin_[of_accumulator_[accumulator] + 1]++] = accumulator;
  list_others();
}

void Assembly::list_others() {
  first_.resize(node_.size());
  others_.clear();
  for (int c = 0; c < chunks(); ++c) {
    ends_[c].other = static_cast<int>(others_.size());
    for (int k = ends_[c].node; k < ends_[c + 1].node; ++k) {
      first_[k] = accumulator_[begin_[k]];
      for (int l = begin_[k] + 1; l < begin_[k + 1]; ++l) others_.push_back({first_[k], accumulator_[l]});
    }
  }
  ends_.back().other = static_cast<int>(others_.size());
}

void Assembly::reserve(std::size_t elements, std::size_t row) {
  const std::size_t rows = elements * row;
  for (auto* list : {&local_, &nodes_, &node_, &accumulator_, &of_accumulator_}) list->reserve(rows);
  begin_.reserve(rows + 2);
  first_.reserve(rows);
  others_.reserve(rows);
  ends_.reserve(elements + 1);
}

template void Assembly::rebuild<2>(const Mesh<2>&, const ActiveElements&);
template void Assembly::rebuild<3>(const Mesh<3>&, const ActiveElements&);

}  // namespace scarp::exec
