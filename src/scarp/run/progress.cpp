#include "scarp/run/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <cstdio>

#include "scarp/base/log.hpp"

namespace scarp::run {
namespace {

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// What fits on one line of the terminal: a longer line would wrap, and only its last part would be renewed.
std::string fitted_to_terminal(std::string line) {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || line.size() < size.ws_col) return line;
  std::size_t length = size.ws_col - 1u;
  // Not within a letter of several bytes.
  while (length > 0 && (static_cast<unsigned char>(line[length]) & 0xC0) == 0x80) --length;
  line.resize(length);
  return line;
}

}  // namespace

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), shown_(start_), noted_(start_) {}

Progress::~Progress() {
  clear();
}

void Progress::stage(const std::string& name, int index, int count, double latest_end) {
  clear();
  latest_end_ = latest_end;
  stage_ = fmt::format("stage {}/{} {}", index + 1, count, name);
  quiet_ || terminal_ ? logging::note(stage_) : logging::line(stage_);
}

void Progress::stage_ended(const std::string& text) {
  clear();
  quiet_ ? logging::note(stage_ + ": " + text) : logging::line(stage_ + ": " + text);
}

void Progress::show(double time, std::int64_t point_steps, double unbalanced, double velocity) {
  const auto now = Clock::now();
  const bool to_user = !quiet_ && seconds(now - shown_) >= (terminal_ ? 0.25 : 10.0),
             to_log = seconds(now - noted_) >= 60;
  if (!to_user && !to_log) return;
  const double elapsed = seconds(now - start_), share = latest_end_ > 0 ? time / latest_end_ : 1.0;
  const double left = share > 0 ? elapsed * (1 / share - 1) : 0.0;
  const auto line = fmt::format(
      "{}: t = {:.3f} s, {:.0f} %, at most {} left, {:.2f} M point-steps/s, unbalanced {:.1e}, v {:.2e} m/s", stage_,
      time, 100 * share, duration_text(left), 1e-6 * static_cast<double>(point_steps) / elapsed, unbalanced, velocity);
  if (to_log) {
    noted_ = now;
    logging::note(line);
  }
  if (!to_user) return;
  shown_ = now;
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", fitted_to_terminal(line));
    open_ = true;
  } else {
    fmt::print(stderr, "scarp: {}\n", line);
  }
  std::fflush(stderr);
}

void Progress::clear() {
  if (!open_) return;
  fmt::print(stderr, "\n");
  open_ = false;
}

std::string duration_text(double s) {
  const auto whole = static_cast<long long>(s + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace scarp::run
