#include "scarp/base/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <array>
#include <cstdio>
#include <ctime>
#include <mutex>
#include <utility>

namespace scarp::logging {
namespace {

spdlog::logger& logger() {
  // Never destroyed: the program may go on from within exit() (material/umat_guard.hpp).
  static spdlog::logger* const instance = [] {
    auto* made = new spdlog::logger("scarp", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("scarp: %v");
    made->flush_on(spdlog::level::info);
    return made;
  }();
  return *instance;
}

std::mutex of_the_list;
std::vector<std::string> list;

std::mutex of_the_copy;
std::FILE* copy = nullptr;

void add_to_copy(const std::string& text) {
  const std::scoped_lock lock(of_the_copy);
  if (!copy) return;
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%F %T", &parts);
  std::fprintf(copy, "%s %s\n", date.data(), text.c_str());
  std::fflush(copy);
}

}  // namespace

void info(const std::string& text) {
  logger().info(text);
  add_to_copy(text);
}
void warn(const std::string& text) {
  logger().warn("warning: {}", text);
  add_to_copy("warning: " + text);
  const std::scoped_lock lock(of_the_list);
  list.push_back(text);
}
void line(const std::string& text) {
  std::fprintf(stderr, "scarp: %s\n", text.c_str());
  add_to_copy(text);
}

void note(const std::string& text) {
  add_to_copy(text);
}

std::vector<std::string> warnings() {
  const std::scoped_lock lock(of_the_list);
  return list;
}
void set_warnings(std::vector<std::string> warnings) {
  const std::scoped_lock lock(of_the_list);
  list = std::move(warnings);
}
void forget_warnings() {
  set_warnings({});
}

Copy::Copy(const std::string& path) {
  const std::scoped_lock lock(of_the_copy);
  copy = std::fopen(path.c_str(), "a");
}
Copy::~Copy() {
  const std::scoped_lock lock(of_the_copy);
  if (copy) std::fclose(copy);
  copy = nullptr;
}

}  // namespace scarp::logging
