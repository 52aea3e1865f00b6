// ModeCodes: the codes that set modes, the feed rate F, and the codes that switch the overrides and the coolant.
#pragma once

#include "code_family.hpp"

namespace passo {

class ModeCodes : private CodeFamily {
 public:
  explicit ModeCodes(BlockContext& block) : CodeFamily(block) {}

  // Sets a mode without other effects: its row of the table defines the canonical call.
  bool set(const CodeEntry& entry);
  bool set_feed_mode(const CodeEntry& entry);
  bool set_feed_rate();
  bool set_path_mode(CodeNumber code);
  void restore_path_mode(CodeNumber code, const PathTolerance& tolerance);
  bool switch_coolant(CodeNumber code);
  bool switch_overrides(CodeNumber code);

 private:
  void emit_path_mode();
  bool opens_collet(CodeNumber code) const;
};

}  // namespace passo
