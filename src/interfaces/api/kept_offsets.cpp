#include "kept_offsets.hpp"

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {

KeptOffsets::KeptOffsets(ProgramStore& programs, const ApiOptions& options) : programs_(programs), options_(options) {
  programs_.set_offsets(options.parameters, options.tools);
}

// Without a tool table, programs have none.
void KeptOffsets::adopt(const SavedParameters& parameters, const ToolTable& all_tools) {
  const ToolTable& tools = programs_.tools().name.empty() ? programs_.tools() : all_tools;
  const bool changed = parameters != programs_.parameters() || tools != programs_.tools();
  programs_.set_offsets(parameters, ToolTable(tools));
  if (changed) write();
}

bool KeptOffsets::adopt(const SavedParameters& parameters) {
  SavedParameters all = programs_.parameters();
  replace_persistent_offsets(all, parameters);
  if (all == programs_.parameters()) return false;
  programs_.set_offsets(all, programs_.tools());
  return true;
}

bool KeptOffsets::set_work_zero(const Point& zero) {
  const SavedParameters before = programs_.parameters();
  programs_.set_work_zero(zero);
  write();
  if (trouble_.empty()) return true;
  const std::string why = trouble_;
  programs_.set_offsets(before, programs_.tools());
  write();
  return false;
}

bool KeptOffsets::write_again() {
  if (!trouble_.empty()) write();
  return trouble_.empty();
}

void KeptOffsets::write() {
  if (options_.keep_offsets) trouble_ = options_.keep_offsets(programs_.parameters(), programs_.tools());
}

}  // namespace passo
