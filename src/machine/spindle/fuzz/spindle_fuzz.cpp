// Any bytes as the reply of a Huanyang drive, and as the table file of a drive: either they are refused, with a reason,
// or what they mean is sound.
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "kit/require.hpp"

#include "passo/spindle/huanyang_frames.hpp"
#include "passo/spindle/vfd_table.hpp"

namespace passo {
namespace {

using test::require;

void check_reply(std::span<const std::uint8_t> bytes) {
  static constexpr std::array tasks = {VfdTask::set_speed, VfdTask::run_forward, VfdTask::stop, VfdTask::read_speed,
                                       VfdTask::read_current};
  for (const VfdTask task : tasks) {
    const auto value = parse_huanyang_reply(bytes, huanyang_request(1, task, 0x1234));
    if (value) {
      require(bytes.size() >= 6 && bytes.size() <= 8 && bytes[0] == 1, "a reply of another length or drive");
      require(modbus_checksum(bytes) == 0, "a reply with a wrong checksum");
      require(task != VfdTask::set_speed || *value == 0x1234, "another frequency");
    } else {
      require(value.error().kind == VfdTrouble::Kind::refused || !value.error().words.empty(), "refused without words");
    }
  }
}

void check_register(const VfdRegister& one, bool writes) {
  require(std::isfinite(one.scale) && one.scale > 0, "scale");
  require(writes ? one.function == 6 || one.function == 16 : one.function == 3 || one.function == 4, "function");
}

void check_table(std::string_view text) {
  Diagnostics diagnostics;
  const auto table = parse_vfd_table(text, "fuzz.toml", diagnostics);
  require(table.has_value() == !diagnostics.any_error(), "refused without a word, or taken with an error");
  for (const Diagnostic& finding : diagnostics.all()) {
    require(finding.code.starts_with("vfd.") && !finding.message.empty(), "a finding without words");
    static_cast<void>(render(finding, true));
  }
  if (!table) return;
  check_register(table->speed, true);
  check_register(table->actual_speed, false);
  if (table->current) check_register(*table->current, false);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_reply({data, size});
  passo::check_table({reinterpret_cast<const char*>(data), size});
  return 0;
}
