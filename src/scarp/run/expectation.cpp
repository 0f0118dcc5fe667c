#include "scarp/run/expectation.hpp"

#include <fmt/format.h>
#include <chrono>
#include <cmath>

#include "scarp/base/error.hpp"
#include "scarp/base/memory.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/run/fields.hpp"
#include "scarp/run/memory_need.hpp"
#include "scarp/run/scheme.hpp"
#include "scarp/step/step.hpp"

namespace scarp::run {
namespace {

constexpr double long_enough = 0.3;  ///< of steps that are tried out [s]
constexpr int most_tried = 200;

/// "40 s", "12 min", "3.5 h", "9 days".
std::string as_time(double seconds) {
  if (seconds < 100) return fmt::format("{:.2g} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 360000) return fmt::format("{:.3g} h", seconds / 3600);
  return fmt::format("{:.3g} days", seconds / 86400);
}

/// Wall time of a step. The first one, which makes what later ones use again, counts only where it is long.
template <int Dim>
double seconds_of_step(const input::CaseOf<Dim>& input, Body<Dim>& body, double dt) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const auto settings = settings_of(input, input.stages.front());
  auto start = Clock::now();
  advance(body, dt, settings);
  if (const double first = since(start); first > long_enough) return first;
  start = Clock::now();
  int steps = 0;
  do {
    advance(body, dt, settings);
    ++steps;
  } while (steps < most_tried && since(start) < long_enough);
  return since(start) / steps;
}

}  // namespace

template <int Dim>
double frame_count(const input::CaseOf<Dim>& input) {
  double count = 1;
  for (const auto& stage : input.stages) {
    const double within = input.output.every > 0 ? std::ceil(stage.duration / input.output.every * (1 - 1e-12)) : 1;
    count += std::max(1.0, within) + (stage.remove ? 1 : 0);
  }
  return count;
}

template <int Dim>
FramesExpected frames_expected(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  FramesExpected frames;
  frames.count = frame_count(input);
  const auto frame = frame_of(body);
  double numbers = frame.positions.components;
  for (const auto& field : frame.fields) numbers += field.components;
  frames.bytes = frames.count * static_cast<double>(sizeof(double)) * numbers * body.point_count();
  return frames;
}

template <int Dim>
std::string expectation(const input::CaseOf<Dim>& input, Body<Dim>& body, double dt) {
  const auto need = memory_need(input);
  const auto frames = frames_expected(input, body);
  std::string text =
      fmt::format("  memory: about {} (grid {}, points {}, the copy that is a checkpoint {}), where {} are free\n",
                  as_bytes(need.grid + need.points + need.checkpoint), as_bytes(need.grid), as_bytes(need.points),
                  as_bytes(need.checkpoint), as_bytes(free_memory().memory));
  text += fmt::format("  output: about {:.10g} frames of at most {}, {} in all\n", frames.count,
                      as_bytes(frames.bytes / frames.count), as_bytes(frames.bytes));
  double steps = 0;
  for (const auto& stage : input.stages) steps += std::ceil(stage.duration / dt);
  if (!std::isfinite(steps)) return text;
  try {
    const int threads = exec::set_threads(0);
    const double seconds = seconds_of_step(input, body, dt);
    text += fmt::format("  wall time: about {} ({:.3g} steps of {:.2g} s, as the first ones take with {} threads)\n",
                        as_time(steps * seconds), steps, seconds, threads);
  } catch (const RunError& error) {
    text += fmt::format("  wall time: not known, for the first steps fail: {}\n", error.what());
  }
  return text;
}

template double frame_count<2>(const input::CaseOf<2>&);
template double frame_count<3>(const input::CaseOf<3>&);
template FramesExpected frames_expected<2>(const input::CaseOf<2>&, const Body<2>&);
template FramesExpected frames_expected<3>(const input::CaseOf<3>&, const Body<3>&);
template std::string expectation<2>(const input::CaseOf<2>&, Body<2>&, double);
template std::string expectation<3>(const input::CaseOf<3>&, Body<3>&, double);

}  // namespace scarp::run
