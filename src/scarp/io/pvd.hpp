// ParaView's collection of frames with their times (.pvd).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace scarp::io {

/// Keeps a collection file up to date: after each frame it is rewritten whole, so that an interrupted run leaves a
/// valid one.
class PvdWriter {
 public:
  explicit PvdWriter(std::string path) : path_(std::move(path)) {}

  /// Adds a frame; `file` is relative to the collection.
  void add(double time, const std::string& file) { frames_.emplace_back(time, file); }
  /// Writes the collection. Throws RunError where that fails.
  void write() const;

 private:
  std::string path_;
  std::vector<std::pair<double, std::string>> frames_;
};

}  // namespace scarp::io
