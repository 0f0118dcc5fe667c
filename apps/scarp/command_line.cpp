// The command line of scarp: parses arguments and calls run/. Exit status: 0 done, 2 bad input, 3 the computation
// failed, 130 interrupted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "commands.hpp"
#include "scarp/base/error.hpp"
#include "scarp/base/version.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/material/umat_guard.hpp"
#include "scarp/run/run.hpp"

namespace {

constexpr int bad_input = 2, failed = 3, interrupted = 130;

struct Arguments {
  std::string case_file, model;
  std::vector<std::string> overrides;
  std::string curve, picture, folder;
  scarp::run::Options options;
};

int run(const Arguments& arguments) {
  const auto input = scarp::input::read_any_case(arguments.case_file, arguments.overrides);
  auto options = arguments.options;
  if (options.out.empty()) options.out = std::filesystem::path(arguments.case_file).stem().string() + ".out";
  const auto outcome = scarp::run::run_case(input, options);
  if (!options.quiet) fmt::print("results in {}\n", options.out);
  return outcome == scarp::run::Outcome::interrupted ? interrupted : 0;
}

int resume(const Arguments& arguments) {
  auto options = arguments.options;
  options.out = arguments.folder;
  while (options.out.size() > 1 && options.out.ends_with('/')) options.out.pop_back();
  const auto outcome = scarp::run::resume_case(options);
  if (!options.quiet) fmt::print("results in {}\n", options.out);
  return outcome == scarp::run::Outcome::interrupted ? interrupted : 0;
}

int check(const Arguments& arguments) {
  fmt::print("{}", scarp::run::check_case(scarp::input::read_any_case(arguments.case_file, arguments.overrides)));
  return 0;
}

int lab(const Arguments& arguments) {
  const auto input = scarp::input::read_lab_test(arguments.case_file, arguments.overrides);
  return scarp::app::run_lab(input, arguments.curve, arguments.picture);
}

int parse_and_call(int argc, char** argv) {
  CLI::App app{"scarp: large-deformation failure of soil by the material point method"};
  app.set_version_flag("--version", fmt::format("scarp {} ({})", scarp::version, scarp::instruction_set()));
  app.require_subcommand(1);
  Arguments arguments;

  auto* run_command = app.add_subcommand("run", "Run a case");
  run_command->add_option("CASE", arguments.case_file, "case file (TOML)")->required();
  run_command->add_option("--out", arguments.options.out, "folder of the results (CASE without .toml, with .out)");
  run_command->add_flag("--overwrite", arguments.options.overwrite,
                        "replace the results of an earlier run in the folder");
  auto* resume_command = app.add_subcommand("resume", "Go on with a run that was stopped, from its latest checkpoint");
  resume_command->add_option("DIR", arguments.folder, "folder of its results")->required();
  resume_command->add_flag("--edited", arguments.options.edited, "take checkpoints that other programs have changed");
  for (auto* command : {run_command, resume_command}) {
    command->add_option("--threads", arguments.options.threads, "number of threads (all that the system gives)")
        ->check(CLI::Range(1, 1024));
    command->add_flag("--profile", arguments.options.profile, "print at the end how the time of the steps was spent");
    command->add_flag("--quiet", arguments.options.quiet, "no progress");
  }
  auto* check_command = app.add_subcommand("check", "Read a case, build mesh and points, and describe them");
  check_command->add_option("CASE", arguments.case_file, "case file (TOML)")->required();
  auto* lab_command = app.add_subcommand("lab", "Run a laboratory test on one stress point");
  lab_command->add_option("TEST", arguments.case_file, "test file (TOML)")->required();
  lab_command->add_option("--out", arguments.curve, "file of the curve, CSV (standard output, unless --plot is given)");
  lab_command->add_option("--plot", arguments.picture, "picture of the curve, such as curve.png");
  for (auto* command : {run_command, check_command, lab_command}) {
    command
        ->add_option("--set", arguments.overrides, "key=value: change one value of the case, e.g. stage.cut.duration=4")
        ->allow_extra_args(false);
  }
  auto* models_command = app.add_subcommand("models", "List the constitutive models, or explain one");
  models_command->add_option("NAME", arguments.model, "name of a model");
  auto* plot_command = app.add_subcommand("plot", "Draw the results of a run (`scarp plot --help` lists the options)");
  plot_command->prefix_command();
  plot_command->set_help_flag();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  for (int i = 0; i < argc; ++i) arguments.options.command += (i > 0 ? " " : "") + std::string(argv[i]);
  if (run_command->parsed()) return run(arguments);
  if (resume_command->parsed()) return resume(arguments);
  if (check_command->parsed()) return check(arguments);
  if (lab_command->parsed()) return lab(arguments);
  if (models_command->parsed()) {
    scarp::app::print_models(arguments.model);
    return 0;
  }
  return scarp::app::run_script("plot.py", plot_command->remaining());
}

/// The exit status, with the error on standard error.
int guarded_main(int argc, char** argv) {
  try {
    return parse_and_call(argc, argv);
  } catch (const scarp::InputError& error) {
    fmt::print(stderr, "scarp: {}\n", error.what());
    return bad_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "scarp: there is not enough memory for this case\n"
               "  remedy: take fewer points or a smaller mesh, end other programs, or raise the limit (ulimit -v)\n");
    return failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "scarp: {}\n", error.what());
    return failed;
  }
}

}  // namespace

int scarp_main(int argc, char** argv) {
  scarp::exec::wait_politely(argv);
  std::signal(SIGXFSZ,
              SIG_IGN);  // a limit on the size of files (ulimit -f) is then an error of writing, with its place
  int status = guarded_main(argc, argv);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    fmt::print(
        stderr,
        "scarp: the standard output cannot be written, and is not whole\n  remedy: check that the disk has room\n");
    if (status == 0) status = failed;
  }
  if (scarp::umat::was_ended()) scarp::umat::end_program(status);
  return status;
}
