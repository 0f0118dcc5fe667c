#include "reference.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace scarp::test {
namespace {

Sym<double, 6> tensor(const nlohmann::json& list, std::size_t first = 0) {
  std::array<double, 6> t{};
  for (std::size_t i = 0; i < 6; ++i) t[i] = list.at(first + i).get<double>();
  return to_mandel<6>(t);
}

ReferencePoint replay_point(const nlohmann::json& row) {
  ReferencePoint p{tensor(row, 0), {}, row.at(14).get<double>()};
  p.state = {tensor(row, 6),  tensor(row, 15),          tensor(row, 21),
             tensor(row, 27), row.at(12).get<double>(), row.at(13).get<double>()};
  return p;
}

}  // namespace

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(SCARP_REFERENCE))
    if (file.path().extension() == ".json") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Reference read_reference(const std::string& name) {
  std::ifstream file(std::filesystem::path(SCARP_REFERENCE) / (name + ".json"));
  const auto data = nlohmann::json::parse(file);
  Reference r;
  r.name = name;
  r.constants = data.at("params").get<std::map<std::string, double>>();
  r.constants["p_c_floor"] = 0;
  const auto& start = data.at("initial");
  r.initial = {tensor(start.at("sigma")), tensor(start.at("beta")),      tensor(start.at("a")),
               Sym<double, 6>::zero(),    start.at("p_c").get<double>(), start.at("R_b").get<double>()};
  r.R = start.at("R").get<double>();
  for (const auto& stage : data.at("program")) {
    r.program.push_back({stage.at("label").get<std::string>(), stage.at("n").get<int>(),
                         stage.at("constraints").get<std::array<std::array<double, 13>, 6>>()});
  }
  r.curve = data.at("curve").get<std::vector<std::array<double, 12>>>();
  for (const auto& row : data.at("replay")) r.replay.push_back(replay_point(row));
  return r;
}

}  // namespace scarp::test
