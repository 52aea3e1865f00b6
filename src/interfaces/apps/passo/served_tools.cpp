#include "served_tools.hpp"

#include <filesystem>

#include "program_input.hpp"
#include "tool_life.hpp"

namespace passo {

std::unique_ptr<ServedTools> ServedTools::open(const ServeArguments& arguments, int& code) {
  std::unique_ptr<ServedTools> tools(new ServedTools);
  if (!arguments.tool_library.empty()) {
    Diagnostics findings;
    tools->library_ = ToolLibrary::read(arguments.tool_library, findings);
    show(findings);
    if (!tools->library_) {
      code = exit_bad_program;
      return nullptr;
    }
  }
  if (arguments.data.empty()) return tools;
  tools->records_ = open_tool_records((std::filesystem::path(arguments.data) / "tools.sqlite").string(), code);
  return tools->records_ ? std::move(tools) : nullptr;
}

}  // namespace passo
