#include "scarp/run/run.hpp"

#include <fmt/format.h>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <functional>
#include <numeric>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/run/advice.hpp"
#include "scarp/run/boundary_nodes.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/lengths.hpp"
#include "scarp/run/rest_watch.hpp"
#include "scarp/run/results.hpp"
#include "scarp/run/scheme.hpp"
#include "scarp/run/stage.hpp"

namespace scarp::run {
namespace {

std::atomic<bool> asked_to_stop{false};

/// Turns SIGINT and SIGTERM into a request to stop for as long as it lives.
class SignalGuard {
 public:
  SignalGuard() {
    asked_to_stop = false;
    old_int_ = std::signal(SIGINT, [](int) { asked_to_stop = true; });
    old_term_ = std::signal(SIGTERM, [](int) { asked_to_stop = true; });
  }
  ~SignalGuard() {
    std::signal(SIGINT, old_int_);
    std::signal(SIGTERM, old_term_);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  void (*old_int_)(int);
  void (*old_term_)(int);
};

template <int Dim>
Ledger<Dim> open_ledger(const Body<Dim>& body) {
  Ledger<Dim> ledger;
  record_motion(body, ledger.last);
  ledger.initial_mass = ledger.last.mass;
  ledger.initial_kinetic_energy = ledger.last.kinetic_energy;
  return ledger;
}

/// Energies, over that of the weight, which are of no account: a fall by a thousandth of the height.
constexpr double of_no_account = 1e-3;

void say_whether_energy_closes(const EnergyCheck& energy) {
  if (energy.largest_ratio() > EnergyCheck::worth_a_warning) logging::warn(energy_warning(energy));
}

/// How the time of the steps was spent, threads added up.
template <int Dim>
void print_profile(const Ledger<Dim>& ledger) {
  const double total = std::accumulate(ledger.seconds.begin(), ledger.seconds.end(), 0.0);
  if (!(total > 0)) return;
  fmt::print("phase of the step                      share   ns per point and step\n");
  for (int i = 0; i < phases; ++i) {
    if (ledger.seconds[i] == 0) continue;  // no part of these steps
    fmt::print("{:36} {:6.1f} %  {:8.1f}\n", phase_names[i], 100 * ledger.seconds[i] / total,
               1e9 * ledger.seconds[i] / static_cast<double>(ledger.point_steps));
  }
}

/// When the run ends if this stage, which starts at `time`, and those after it take all their durations [s].
template <int Dim>
double latest_end(const input::CaseOf<Dim>& input, int stage, double time) {
  for (std::size_t i = stage; i < input.stages.size(); ++i) time += input.stages[i].duration;
  return time;
}

template <int Dim>
Outcome run_in(const input::CaseOf<Dim>& input, const Options& options) {
  const int threads = exec::set_threads(options.threads);
  Body<Dim> body = build_body(input);
  warn_of_ignored_flip(input);
  warn_of_sparse_points(input, body);
  for (const auto& warning : short_lengths(input, body)) logging::warn(warning);
  Ledger<Dim> ledger = open_ledger(body);
  Results<Dim> results(input, options.out, body);

  const SignalGuard guard;
  const std::function<bool()> interrupted = [] { return asked_to_stop.load(); };
  const auto start = std::chrono::steady_clock::now();
  RunRecord record{"running", "", 0, threads, 0, 0, {}};
  EnergyCheck energy(ledger, of_no_account * weight_energy(body));
  auto write_summary = [&](const std::string& status, const std::string& message) {
    record.status = status;
    record.message = message;
    record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    record.energy_error = energy.relative(ledger);
    record.largest_energy_error = energy.largest_ratio();
    results.summary(body, ledger, record);
  };
  results.frame(body, 0);
  write_summary("running", "");
  try {
    Progress progress(options.quiet);
    Context<Dim> context{input, body, ledger, results, progress, energy, interrupted, options.profile};
    bool cut = false;
    for (int i = 0; i < static_cast<int>(input.stages.size()) && !interrupted(); ++i) {
      progress.stage(input.stages[i].name, i, static_cast<int>(input.stages.size()), latest_end(input, i, ledger.time));
      if (input.stages[i].remove && !cut) {
        cut = true;
        energy.start(ledger);
      }
      run_stage(context, i, record.stages.emplace_back());
      results.history(i, body.point_count(), ledger);
      results.frame(body, ledger.time);
    }
  } catch (const RunError& error) {
    results.frame(body, ledger.time);
    say_whether_energy_closes(energy);
    write_summary("failed", error.what());
    throw;
  }
  if (options.profile) print_profile(ledger);
  say_whether_energy_closes(energy);
  write_summary(interrupted() ? "interrupted" : "done", "");
  return interrupted() ? Outcome::interrupted : Outcome::done;
}

template <int Dim>
std::string check_in(const input::CaseOf<Dim>& input) {
  Body<Dim> body = build_body(input);
  warn_of_ignored_flip(input);
  warn_of_sparse_points(input, body);
  std::string text = fmt::format("{}: {}\n", input.path, input.title);
  text += fmt::format("  mesh: {} elements, {} nodes, {}\n", body.mesh->element_count(), body.mesh->node_count(),
                      body.mesh->grid ? "a structured grid" : "unstructured");
  text += fmt::format("  points: {}\n", points_per_element(body));
  for (const auto& block : body.blocks()) {
    double mass = 0, volume = 0;
    for (int i = 0; i < block.size(); ++i) {
      mass += block.points.mass[i];
      volume += block.points.volume[i];
    }
    const bool area = Dim == 2 && !input.axisymmetric;
    const char* share = input.axisymmetric ? " per radian" : area ? " per m" : "";
    text += fmt::format("    region \"{}\": {} points, {} {:.6g} {}{}, mass {:.6g}{}\n", block.name, block.size(),
                        area ? "area" : "volume", volume, area ? "m2" : "m3", area ? "" : share, mass, share);
  }
  for (const auto& line : describe_boundaries(*body.mesh, input.boundaries)) text += fmt::format("  {}\n", line);
  for (const auto& warning : short_lengths(input, body)) text += fmt::format("  warning: {}\n", warning);
  const double critical = critical_time_step(body, scheme_of(input.method));
  const double dt = input.method.safety * critical;
  text += fmt::format("  time step: {:.3g} s at the start (critical {:.3g} s, safety {:g})\n", dt, critical,
                      input.method.safety);
  for (const auto& stage : input.stages) {
    text += fmt::format("  stage \"{}\": {:g} s, about {:.0f} steps\n", stage.name, stage.duration,
                        std::ceil(stage.duration / dt));
  }
  return text;
}

}  // namespace

Outcome run_case(const input::AnyCase& input, const Options& options) {
  return std::visit([&](const auto& its) { return run_in(its, options); }, input);
}

std::string check_case(const input::AnyCase& input) {
  return std::visit([](const auto& its) { return check_in(its); }, input);
}

}  // namespace scarp::run
