// ToolCodes: the codes and words of tools (T, M6, M61, G43, G49, G10 L0, L1, L10, L11): the tool in the spindle, its
// offset, and its entry in the tool table.
#pragma once

#include "code_family.hpp"
#include "frame_codes.hpp"
#include "spindle_codes.hpp"

namespace passo {

class ToolCodes : private CodeFamily {
 public:
  ToolCodes(BlockContext& block, FrameCodes& frame, SpindleCodes& spindles)
      : CodeFamily(block), frame_(frame), spindles_(spindles) {}

  bool select();
  bool change(CodeNumber code);
  bool set_length(CodeNumber code);
  bool set_table();

 private:
  bool reload_tools();
  bool set_tool_table_entry();
  bool find_tool(std::int32_t number, Span span, const Tool*& tool);
  void load_tool(std::int32_t number);
  bool tool_offset(Point& offset);
  bool check_tool_entry_words(Tool*& tool);
  void set_tool_offsets(Tool& tool);

  FrameCodes& frame_;
  SpindleCodes& spindles_;
  bool missing_table_told_ = false;
  bool was_loaded_ = false;
};

}  // namespace passo
