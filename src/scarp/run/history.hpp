// The columns of history.csv, declared once: key, unit, meaning and value.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/run/ledger.hpp"

namespace scarp::run {

/// What a row is of.
template <int Dim>
struct Moment {
  const Ledger<Dim>& ledger;
  int stage, points;
};

template <int Dim>
struct HistoryColumn {
  std::string key, unit, meaning;
  std::function<double(const Moment<Dim>&)> value;
};

/// Those that a case has use for, in their order.
template <int Dim>
std::vector<HistoryColumn<Dim>> history_columns(const input::CaseOf<Dim>& input);

}  // namespace scarp::run
