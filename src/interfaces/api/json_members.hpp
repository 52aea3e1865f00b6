// JsonMembers: reads the members of an object, and notes what is wrong. Private to api/.
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
  // Numbers for some of the machine's axes, the others as in `start`.
  Point place(const std::string& key, const MachineDescription& machine, const Point& start);
  void fail(const std::string& key, const std::string& expected);
  // True: all was right, and there was nothing else. Call last.
  bool end();
  bool good() const { return reason_.empty(); }
  // What was wrong first.
  const std::string& reason() const { return reason_; }

 private:
  const nlohmann::ordered_json* find(const std::string& key);

  nlohmann::ordered_json object_;
  std::string reason_;
  std::vector<std::string> asked_;
};

}  // namespace passo
