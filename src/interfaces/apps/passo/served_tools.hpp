// ServedTools: the tool library of `passo serve --tool-table`, and the records of its --data folder.
#pragma once

#include <memory>
#include <optional>

#include "commands.hpp"

#include "passo/job/tool_records.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {

class ServedTools {
 public:
  // Null, with messages and `code`, if a file cannot be read.
  static std::unique_ptr<ServedTools> open(const ServeArguments& arguments, int& code);

  // Null: nothing is counted.
  ToolRecords* records() const { return records_.get(); }
  // Null: none was given.
  const ToolLibrary* library() const { return library_ ? &*library_ : nullptr; }

 private:
  ServedTools() = default;

  std::unique_ptr<ToolRecords> records_;
  std::optional<ToolLibrary> library_;
};

}  // namespace passo
