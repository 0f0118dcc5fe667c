// K0 from the model: the stress ratio that one-dimensional (oedometric) compression and unloading leave.
#pragma once

#include <vector>

#include "scarp/material/models.hpp"

namespace scarp::lab {

/// Horizontal over vertical effective stress of soil that was laid down without bonds, compressed one-dimensionally on
/// its normal line and unloaded to a vertical stress OCR times smaller. Computed with the model itself; a linear
/// elastic soil has ν/(1 − ν) at any OCR.
class K0Curve {
 public:
  /// `vertical` is the vertical effective stress after unloading to `largest_OCR` [stress], positive, with
  /// largest_OCR ≥ 1. Throws RunError where the model does not get there, because it fails on the way.
  K0Curve(const AnyModel& model, double vertical, double largest_OCR);

  /// K0 at 1 ≤ OCR ≤ largest_OCR, linear in ln OCR between computed points.
  double operator()(double OCR) const;

 private:
  struct Point {
    double log_OCR, K0;
  };
  std::vector<Point> points_;  ///< OCR ascending
};

}  // namespace scarp::lab
