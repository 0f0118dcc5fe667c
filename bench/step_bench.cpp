// Times whole steps of one case. Prepares it, prints what there is, and then answers each line on standard input with
// one line of JSON, so that bench/steps.py can measure other things in between. Lines: "run"; "profile" for the times
// of the phases as well; anything else is a path, to which a frame is written, or a checkpoint where it ends in .h5.
//
//     step_bench CASE POINTS THREADS
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "scarp/exec/parallel.hpp"
#include "whole_steps.hpp"

namespace {

/// Memory in use by this program [bytes], after what it has freed is given back.
double resident() {
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident_pages = 0;
  file >> pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// The most memory that this program has had in use [bytes].
double peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

nlohmann::ordered_json to_json(const scarp::bench::Repetition& r, double bytes) {
  nlohmann::ordered_json json{{"seconds", r.seconds},   {"cpu_seconds", r.cpu_seconds},
                              {"steps", r.steps},       {"point_steps", r.point_steps},
                              {"substeps", r.substeps}, {"changed_element", r.changed_element},
                              {"bytes", bytes}};
  for (int i = 0; i < scarp::phases; ++i) json["phases"][scarp::phase_names[i]] = r.phase_seconds[i];
  return json;
}

void serve(const std::string& name, int points, int threads) {
  scarp::exec::set_threads(threads);
  const double before = resident();
  const auto prepared = scarp::bench::prepare(name, points);
  std::cout << nlohmann::ordered_json{{"case", name},
                                      {"points", prepared.points},
                                      {"elements", prepared.elements},
                                      {"start_seconds", prepared.start.seconds},
                                      {"start_cpu_seconds", prepared.start.cpu_seconds},
                                      {"start_peak_bytes", peak() - before}}
            << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    if (line.ends_with(".h5")) {
      const auto times = prepared.write_checkpoint(line);
      std::cout << nlohmann::ordered_json{{"copy_seconds", times.copy.seconds},
                                          {"disk_seconds", times.disk.seconds},
                                          {"bytes", times.bytes},
                                          {"state_bytes", times.state_bytes}}
                << std::endl;
      continue;
    }
    if (line != "run" && line != "profile") {
      const auto times = prepared.write_frame(line);
      std::cout << nlohmann::ordered_json{{"seconds", times.seconds}, {"cpu_seconds", times.cpu_seconds}} << std::endl;
      continue;
    }
    const auto repetition = prepared.repeat(line == "profile");
    std::cout << to_json(repetition, resident() - before) << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  scarp::exec::wait_politely(argv);  // as the program does
  if (argc != 4) {
    std::cerr << "usage: step_bench CASE POINTS THREADS\n";
    return 2;
  }
  try {
    serve(argv[1], std::atoi(argv[2]), std::atoi(argv[3]));
  } catch (const std::exception& error) {
    std::cerr << "step_bench: " << error.what() << '\n';
    return 1;
  }
}
