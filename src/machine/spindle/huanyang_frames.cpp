#include "passo/spindle/huanyang_frames.hpp"

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t checksum_size = 2;
constexpr std::size_t head_size = 3;  // address, function, length
constexpr std::uint8_t write_control = 3;
constexpr std::uint8_t read_state = 4;
constexpr std::uint8_t write_frequency = 5;
constexpr std::uint8_t exception_bit = 0x80;

Failure<VfdTrouble> bad(std::string words) {
  return Failure{VfdTrouble{.kind = VfdTrouble::Kind::bad_reply, .words = std::move(words)}};
}

std::uint16_t word(std::uint8_t high, std::uint8_t low) {
  return static_cast<std::uint16_t>(high << 8U | low);
}

}  // namespace

std::uint16_t modbus_checksum(std::span<const std::uint8_t> bytes) {
  unsigned sum = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    sum ^= byte;
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? sum >> 1U ^ 0xA001U : sum >> 1U;
  }
  return static_cast<std::uint16_t>(sum);
}

std::vector<std::uint8_t> huanyang_request(int address, VfdTask task, std::uint16_t value) {
  const auto to = static_cast<std::uint8_t>(address);
  const auto read = [to](std::uint8_t index) { return std::vector<std::uint8_t>{to, read_state, 3, index, 0, 0}; };
  const auto control = [to](std::uint8_t bits) { return std::vector<std::uint8_t>{to, write_control, 1, bits}; };
  switch (task) {
    case VfdTask::set_speed:
      return {to, write_frequency, 2, static_cast<std::uint8_t>(value >> 8U), static_cast<std::uint8_t>(value & 0xFFU)};
    case VfdTask::run_forward: return control(0x01);
    case VfdTask::run_reverse: return control(0x11);
    case VfdTask::stop: return control(0x08);
    case VfdTask::read_speed: return read(1);
    case VfdTask::read_current: return read(2);
    default: return {};
  }
}

std::optional<std::size_t> huanyang_reply_length(std::span<const std::uint8_t> begin) {
  if (begin.size() < head_size) return {};
  if ((begin[1] & exception_bit) != 0) return head_size + checksum_size;
  const std::size_t length = head_size + begin[2] + checksum_size;
  return length <= longest_huanyang_frame ? length : 0;
}

Result<std::uint16_t, VfdTrouble> parse_huanyang_reply(std::span<const std::uint8_t> reply,
                                                       std::span<const std::uint8_t> request) {
  const auto length = huanyang_reply_length(reply);
  if (!length || reply.size() != *length || request.size() < head_size) return bad("it has a wrong length");
  const std::size_t end = reply.size() - checksum_size;
  if (modbus_checksum(reply.first(end)) != word(reply[end + 1], reply[end])) return bad("its checksum is wrong");
  if (reply[0] != request[0]) return bad(fmt::format("it comes from address {}", reply[0]));
  if (reply[1] == (request[1] | exception_bit)) {
    return Failure{VfdTrouble{.kind = VfdTrouble::Kind::refused, .exception = reply[2]}};
  }
  if (reply[1] != request[1]) return bad("it answers another request");
  const std::span<const std::uint8_t> data = reply.subspan(head_size, end - head_size);
  switch (request[1]) {
    case write_control:
      if (data.size() != 1) break;
      return data[0];
    case write_frequency:
      if (data.size() != 2) break;
      if (word(data[0], data[1]) != word(request[3], request[4])) return bad("it confirms another frequency");
      return word(data[0], data[1]);
    case read_state:
      if (data.size() != 3) break;
      if (data[0] != request[3]) return bad("it answers another request");
      return word(data[1], data[2]);
    default: break;
  }
  return bad("it has a wrong length");
}

}  // namespace passo
