// Writes checkpoints while the run goes on: the state is copied, and a thread of its own brings the copy to the disk.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <string>
#include <thread>

#include "scarp/input/case.hpp"
#include "scarp/io/hdf5.hpp"

namespace scarp::run {

/// When checkpoints are due, and their way to the disk.
class CheckpointWriter {
 public:
  CheckpointWriter(std::string folder, const input::CheckpointInput& input);
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// Counts from this step and time on.
  void start(std::int64_t steps, double time);
  /// Is any ever due?
  bool on() const { return input_.every > 0 || input_.steps > 0 || input_.time > 0; }
  /// Is one due after this step, at this time [s]? Says so once.
  bool due(std::int64_t steps, double time);

  /// Takes the bytes of a file of this name to the disk: `before` is called first, there. Of the checkpoints that were
  /// due the latest are kept, as many as the case says. Throws the error of the one before, such as of a full disk.
  void write(const std::string& name, io::Bytes bytes, std::function<void()> before);
  /// Returns when all is on the disk. Throws the error where it is not.
  void finish();

 private:
  void bring_to_disk(const std::string& name, const io::Bytes& bytes) const;
  void remove_old() const;

  using SteadyClock = std::chrono::steady_clock;
  std::string folder_;
  input::CheckpointInput input_;
  SteadyClock::time_point last_ = SteadyClock::now();
  std::int64_t next_step_ = 0;
  double next_time_ = 0;
  std::thread writer_;
  std::exception_ptr failure_;
};

}  // namespace scarp::run
