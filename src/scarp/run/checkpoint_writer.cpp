#include "scarp/run/checkpoint_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "scarp/io/file.hpp"
#include "scarp/run/checkpoint.hpp"

namespace scarp::run {

CheckpointWriter::CheckpointWriter(std::string folder, const input::CheckpointInput& input)
    : folder_(std::move(folder)), input_(input) {}

CheckpointWriter::~CheckpointWriter() {
  if (writer_.joinable()) writer_.join();
}

void CheckpointWriter::start(std::int64_t steps, double time) {
  last_ = SteadyClock::now();
  next_step_ = steps + input_.steps;
  next_time_ = time + input_.time;
}

bool CheckpointWriter::due(std::int64_t steps, double time) {
  const bool by_steps = input_.steps > 0 && steps >= next_step_;
  const bool by_time = input_.time > 0 && time >= next_time_ * (1 - 1e-12);
  const bool by_clock =
      input_.every > 0 && std::chrono::duration<double>(SteadyClock::now() - last_).count() >= input_.every;
  if (by_clock) last_ = SteadyClock::now();
  if (by_steps) next_step_ = steps + input_.steps;
  while (by_time && next_time_ <= time) next_time_ += std::max(input_.time, time - next_time_);
  return by_steps || by_time || by_clock;
}

void CheckpointWriter::write(const std::string& name, io::Bytes bytes, std::function<void()> before) {
  finish();
  writer_ = std::thread([this, name, held = std::move(bytes), before = std::move(before)] {
    try {
      before();
      bring_to_disk(name, held);
      remove_old();
    } catch (...) {
      failure_ = std::current_exception();
    }
  });
}

void CheckpointWriter::finish() {
  if (writer_.joinable()) writer_.join();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void CheckpointWriter::bring_to_disk(const std::string& name, const io::Bytes& bytes) const {
  io::WholeFile file(folder_ + "/" + name);
  file.write(bytes.data.get(), bytes.size);
  file.write(seal_of(bytes.data.get(), bytes.size));
  file.finish();
  io::sync_folder(folder_);  // with the names of the frames that it counts on
}

void CheckpointWriter::remove_old() const {
  int kept = 0;
  for (const auto& its : checkpoints_in(folder_)) {
    if (its.stage >= 0) continue;  // the ends of stages stay
    if (++kept > input_.keep) std::remove((folder_ + "/" + its.name).c_str());
  }
}

}  // namespace scarp::run
