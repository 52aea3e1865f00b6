// ServedOffsets: the offsets of the work systems and the tool table that `passo serve --data` keeps between programs:
// the files work.var and tool.tbl in its folder, in LinuxCNC's forms.
#pragma once

#include <string>

#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class ServedOffsets {
 public:
  explicit ServedOffsets(const std::string& folder);

  // False, with a message: a file is there and cannot be read.
  [[nodiscard]] bool read();
  // Returns why a file cannot be written; empty: all is written. What is not is written with the next call.
  std::string keep(const SavedParameters& parameters, const ToolTable& tools);

  const SavedParameters& parameters() const { return parameters_; }
  const ToolTable& tools() const { return tools_; }

 private:
  std::string parameter_file_;
  std::string tool_file_;
  std::string tool_lines_;  // of the tool table, with its remarks
  SavedParameters parameters_;
  ToolTable tools_;
};

}  // namespace passo
