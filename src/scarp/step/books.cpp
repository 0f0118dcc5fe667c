#include "scarp/step/books.hpp"

#include <algorithm>
#include <span>

#include "scarp/comm/alone.hpp"

namespace scarp {

template <int Dim>
void StepBooks<Dim>::add_counts(const StepBooks& other) {
  using B = StepBooks;
  for (std::int64_t B::*count : {&B::removed, &B::massless_nodes, &B::changed_element, &B::left_mesh})
    this->*count += other.*count;
  for (int i = 0; i < phases; ++i) seconds[i] += other.seconds[i];
  max_velocity = std::max(max_velocity, other.max_velocity);
  stress.add_counts(other.stress);
  search += other.search;
}

template <int Dim>
BodyBooks<Dim>& BodyBooks<Dim>::operator+=(const BodyBooks& other) {
  part_.add_counts(other.part_);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  return *this;
}

namespace {

/// The counts and the least and largest numbers of all processes.
template <int Dim>
void share(StepBooks<Dim>& books, std::span<ExactSum> sums) {
  auto& stress = books.stress;
  auto& search = books.search;
  const std::array counted{&books.removed,           &books.massless_nodes, &books.changed_element,
                           &books.left_mesh,         &stress.substeps,      &stress.failures,
                           &stress.corrected,        &stress.separated,     &stress.on_floor,
                           &stress.no_stiffness,     &search.own,           &search.surrounding,
                           &search.walked,           &search.searched_all,  &search.lost,
                           &search.elements_examined};
  std::array<std::int64_t, counted.size()> counts;
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = *counted[i];
  std::array most{books.max_velocity, static_cast<double>(stress.most_substeps),
                  static_cast<double>(search.most_examined)};
  const comm::Tally tally{.sums = sums, .least = {&stress.critical_dt, 1}, .most = most, .counts = counts};
  comm::start(tally);
  comm::finish(tally);
  for (std::size_t i = 0; i < counts.size(); ++i) *counted[i] = counts[i];
  books.max_velocity = most[0];
  stress.most_substeps = static_cast<int>(most[1]);
  search.most_examined = static_cast<std::int64_t>(most[2]);
}

}  // namespace

template <int Dim>
StepBooks<Dim> BodyBooks<Dim>::total() const {
  StepBooks<Dim> books = part_;
  auto sums = sums_;
  share(books, sums);
  auto exact = sums.begin();
  StepBooks<Dim>::each_sum(books, [&](double& sum) { sum = (exact++)->value(); });
  return books;
}

template struct StepBooks<2>;
template struct StepBooks<3>;
template class BodyBooks<2>;
template class BodyBooks<3>;

}  // namespace scarp
