#include "scarp/base/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp {
namespace {

using Cuts = std::vector<std::array<double, 2>>;

/// f(low, high) for each stretch that is in both.
template <class F>
void for_each_common(const Cuts& a, const Cuts& b, F&& f) {
  for (const auto& p : a) {
    for (const auto& q : b) {
      const double low = std::max(p[0], q[0]), high = std::min(p[1], q[1]);
      if (low < high) f(low, high);
    }
  }
}

/// Parts that are shared, as they are found.
template <int Dim>
class Sum {
 public:
  /// A part about x with its extent along the vertical.
  void add(const Vec<Dim>& x, double volume, double low, double high) {
    shared_.volume += volume;
    if (volume > largest_) {
      largest_ = volume;
      shared_.at = x;
    }
    for (int k = 0; k < Dim; ++k) {
      low_[k] = std::min(low_[k], k + 1 == Dim ? low : x[k]);
      high_[k] = std::max(high_[k], k + 1 == Dim ? high : x[k]);
    }
  }

  /// `pitch`: the width that a part stands for across the vertical.
  std::optional<Shared<Dim>> result(const Vec<Dim>& pitch) {
    if (!(shared_.volume > 0)) return {};
    Vec<Dim> extent;
    for (int k = 0; k < Dim; ++k) extent[k] = high_[k] - low_[k] + pitch[k];
    std::sort(extent.begin(), extent.end());
    double across = 1;
    for (int k = 1; k < Dim; ++k) across *= extent[k];
    shared_.depth = across > 0 ? shared_.volume / across : 0;
    return shared_;
  }

 private:
  static Vec<Dim> filled(double value) {
    Vec<Dim> x;
    x.fill(value);
    return x;
  }

  Shared<Dim> shared_;
  double largest_ = 0;
  Vec<Dim> low_ = filled(std::numeric_limits<double>::infinity()),
           high_ = filled(-std::numeric_limits<double>::infinity());
};

/// Where edges of the two cross, and their corners: between these x both consist of stripes.
std::vector<double> turns(const Polygon& a, const Polygon& b) {
  std::vector<double> at;
  for (const auto* polygon : {&a, &b}) {
    for (const auto& corner : *polygon) at.push_back(corner[0]);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec<2>&p = a[i], &q = a[(i + 1) % a.size()];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec<2>&r = b[j], &s = b[(j + 1) % b.size()];
      const double ux = q[0] - p[0], uy = q[1] - p[1], vx = s[0] - r[0], vy = s[1] - r[1];
      const double det = ux * vy - uy * vx;
      if (det == 0) continue;
      const double t = ((r[0] - p[0]) * vy - (r[1] - p[1]) * vx) / det;
      if (t > 0 && t < 1) at.push_back(p[0] + t * ux);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

std::optional<Shared<2>> shared_by(const Polygon& a, const Polygon& b) {
  const Box first = bounds(a), second = bounds(b);
  const double from = std::max(first.low[0], second.low[0]), to = std::min(first.high[0], second.high[0]);
  Sum<2> sum;
  const auto at = turns(a, b);
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double left = std::max(at[i - 1], from), right = std::min(at[i], to);
    if (!(left < right)) continue;
    const double x = 0.5 * (left + right);
    for_each_common(vertical_cuts(a, x), vertical_cuts(b, x), [&](double low, double high) {
      const Vec<2> middle{x, 0.5 * (low + high)};
      sum.add(middle, (right - left) * (high - low), low, high);
      // Its ends along x; what they add to the area is nothing.
      sum.add({left, middle[1]}, 0, low, high);
      sum.add({right, middle[1]}, 0, low, high);
    });
  }
  return sum.result({0, 0});
}

std::optional<Shared<3>> shared_by(const Solid& a, const Solid& b) {
  constexpr int lines = 100;
  const BoxOf<3> first = bounds(a), second = bounds(b);
  Vec<3> low, pitch{};
  for (int k = 0; k < 3; ++k) {
    low[k] = std::max(first.low[k], second.low[k]);
    const double length = std::min(first.high[k], second.high[k]) - low[k];
    if (!(length > 0)) return {};
    if (k < 2) pitch[k] = length / lines;
  }
  Sum<3> sum;
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const Vec<3> x{low[0] + (i + 0.5) * pitch[0], low[1] + (j + 0.5) * pitch[1], low[2]};
      for_each_common(cuts_through(a, x), cuts_through(b, x), [&](double from, double to) {
        sum.add({x[0], x[1], 0.5 * (from + to)}, pitch[0] * pitch[1] * (to - from), from, to);
      });
    }
  }
  return sum.result(pitch);
}

}  // namespace scarp
