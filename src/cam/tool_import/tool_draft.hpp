// ToolDraft: the keys of one tool, as an import finds them, and the tool that ToolLibrary makes of them. Private to
// tool_import/.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/tooling/tool_library_text.hpp"

namespace passo {

class ToolDraft {
 public:
  // `key`: of [tool.N], a literal.
  void set(std::string_view key, double value) { entries_.push_back({key, toml_value(value)}); }
  void set(std::string_view key, bool value) { entries_.push_back({key, toml_value(value)}); }
  void set_text(std::string_view key, std::string_view text) { entries_.push_back({key, toml_value(text)}); }
  void set_shape(CuttingShape shape) { set_text("shape", name_of(shape)); }
  // Returns false if the material has a chip load already.
  bool add_chip_load(WorkMaterial material, Mm load) { return chip_loads_.emplace(material, load).second; }

  // Sets a name that fits into a comment of a program: without parentheses, at most 60 bytes. Returns false if the name
  // had to be changed.
  bool set_name(std::string_view name);

  // Returns why the tool is not valid, as a sentence without a full stop.
  Result<CuttingTool, std::string> finish(std::int32_t number) const;

 private:
  std::vector<ToolEntry> entries_;
  std::map<WorkMaterial, Mm> chip_loads_;
};

}  // namespace passo
