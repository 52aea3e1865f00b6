// FrameCodes: the codes that move the work frame (G54 to G59.3, G10 L2 and L20, G52, G92, G51), and the codes that need
// the whole frame (G28, G30). The tool does not move; only its coordinates change.
#pragma once

#include "code_family.hpp"
#include "modal_snapshot.hpp"

namespace passo {

class FrameCodes : private CodeFamily {
 public:
  explicit FrameCodes(BlockContext& block) : CodeFamily(block) {}

  // Restores the frame of the last run from the parameters: the work coordinate system and the offsets.
  void start();
  bool select_work_system(CodeNumber code);
  void activate_system(int system, bool with_g92);
  bool go_home(int parameter);
  bool store_home(int parameter);
  bool set_work_offset();
  bool set_g92(CodeNumber code);
  bool set_scaling();
  void use_tool_offset(const Point& offset);
  // Moves the zero of all work coordinate systems along Z, e.g. to the tip of another tool.
  void shift_work_z(double way);
  void restore_tool_offset(const ModalSnapshot& saved);

 private:
  bool check_work_offset_words(int& system);
  Point active_g92() const;
  template <class... Operations>
  void change_frame(const Operations&... operations);
};

}  // namespace passo
