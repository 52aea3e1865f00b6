#include "passo/grbl/grbl_store.hpp"

#include <utility>

namespace passo {

void GrblStore::remember(GrblMemory memory, WriteMemory write) {
  memory_ = std::move(memory);
  write_memory_ = std::move(write);
}

bool GrblStore::keep(const GrblMemory& memory) {
  if (write_memory_ && !write_memory_(memory)) return false;
  memory_ = memory;
  return true;
}

void GrblStore::keep_settings(std::string text, WriteFile write) {
  settings_.emplace(std::move(text));
  write_file_ = std::move(write);
}

std::optional<std::string> GrblStore::keep(int number, double value) {
  std::string reason;
  auto after = settings_->with(number, value, reason);
  if (!after) return reason;
  if (!write_file_(settings_->text(), *after)) return "The machine file cannot be written, or was changed meanwhile";
  settings_->set_text(std::move(*after));
  return {};
}

}  // namespace passo
