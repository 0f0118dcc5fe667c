#include "scarp/step/totals.hpp"

#include <algorithm>
#include <span>

#include "scarp/comm/alone.hpp"

namespace scarp {

template <int Dim>
void StepTotals<Dim>::add_counts(const StepTotals& other) {
  using B = StepTotals;
  for (std::int64_t B::*count :
       {&B::removed, &B::massless_nodes, &B::changed_element, &B::left_mesh, &B::chunks_without_volume})
    this->*count += other.*count;
  for (int i = 0; i < phases; ++i) seconds[i] += other.seconds[i];
  max_velocity = std::max(max_velocity, other.max_velocity);
  stress.add_counts(other.stress);
  search += other.search;
}

template <int Dim>
BodyTotals<Dim>& BodyTotals<Dim>::operator+=(const BodyTotals& other) {
  part_.add_counts(other.part_);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  return *this;
}

namespace {

/// The counts and the least and largest numbers of all processes.
template <int Dim>
void share(StepTotals<Dim>& totals, std::span<ExactSum> sums) {
  auto& stress = totals.stress;
  auto& search = totals.search;
  const std::array counted{&totals.removed,
                           &totals.massless_nodes,
                           &totals.changed_element,
                           &totals.left_mesh,
                           &totals.chunks_without_volume,
                           &stress.substeps,
                           &stress.failures,
                           &stress.corrected,
                           &stress.separated,
                           &stress.on_floor,
                           &stress.no_stiffness,
                           &search.own,
                           &search.surrounding,
                           &search.walked,
                           &search.searched_all,
                           &search.lost,
                           &search.elements_examined};
  std::array<std::int64_t, counted.size()> counts;
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = *counted[i];
  std::array most{totals.max_velocity, static_cast<double>(stress.most_substeps),
                  static_cast<double>(search.most_examined)};
  const comm::Tally tally{.sums = sums, .least = {&stress.critical_dt, 1}, .most = most, .counts = counts};
  comm::start(tally);
  comm::finish(tally);
  for (std::size_t i = 0; i < counts.size(); ++i) *counted[i] = counts[i];
  totals.max_velocity = most[0];
  stress.most_substeps = static_cast<int>(most[1]);
  search.most_examined = static_cast<std::int64_t>(most[2]);
}

}  // namespace

template <int Dim>
StepTotals<Dim> BodyTotals<Dim>::total() const {
  StepTotals<Dim> totals = part_;
  auto sums = sums_;
  share(totals, sums);
  auto exact = sums.begin();
  StepTotals<Dim>::each_sum(totals, [&](double& sum) { sum = (exact++)->value(); });
  return totals;
}

template struct StepTotals<2>;
template struct StepTotals<3>;
template class BodyTotals<2>;
template class BodyTotals<3>;

}  // namespace scarp
