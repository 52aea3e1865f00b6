// JsonMembers: reads the members of an object, and records the first error. Private to api/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

class JsonMembers {
 public:
  explicit JsonMembers(nlohmann::ordered_json object);

  std::optional<double> number(const std::string& key);
  std::optional<bool> flag(const std::string& key);
  // Reads the name of an axis of the machine.
  std::optional<Axis> axis(const std::string& key, const MachineDescription& machine);
  // Reads coordinates for some of the machine's axes; the others are taken from `start`.
  Point place(const std::string& key, const MachineDescription& machine, const Point& start);
  void fail(const std::string& key, const std::string& expected);
  // Returns true if everything was valid and there were no unknown members. Must be called last.
  bool end();
  bool good() const { return reason_.empty(); }
  // Returns the first error.
  const std::string& reason() const { return reason_; }

 private:
  const nlohmann::ordered_json* find(const std::string& key);

  nlohmann::ordered_json object_;
  std::string reason_;
  std::vector<std::string> asked_;
};

}  // namespace passo
