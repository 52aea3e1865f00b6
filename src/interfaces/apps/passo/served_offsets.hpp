// ServedOffsets: the work offsets and the tool table that `passo serve --data` saves between runs: the files work.var
// and tool.tbl in its folder, in LinuxCNC's formats.
#pragma once

#include <string>

#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class ServedOffsets {
 public:
  explicit ServedOffsets(const std::string& folder);

  // Returns false, with a message, if a file exists and cannot be read.
  [[nodiscard]] bool read();
  // Returns why a file cannot be written; empty on success. Failed writes are repeated with the next call.
  std::string keep(const SavedParameters& parameters, const ToolTable& tools);

  const SavedParameters& parameters() const { return parameters_; }
  const ToolTable& tools() const { return tools_; }

 private:
  std::string parameter_file_;
  std::string tool_file_;
  std::string tool_lines_;  // the tool table with its comments
  SavedParameters parameters_;
  ToolTable tools_;
};

}  // namespace passo
