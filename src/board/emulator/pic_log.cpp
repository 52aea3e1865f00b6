#include "pic_log.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace passo {
namespace {

unsigned value_on(const OutputPins& pins, unsigned port) {
  unsigned value = 0;
  for (unsigned i = 0; i < pins.bits.size(); ++i) {
    if (((port >> pins.bits[i] & 1) != 0) == pins.straight) value |= 1U << i;
  }
  return value;
}

}  // namespace

// A line with the cycle, then what the instruction did, "  Wrote: 0x00FD to portc(0x0007) was 0x0000".
void PicLog::read(const std::filesystem::path& log, FollowerRun& run) {
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("0x")) at_ = static_cast<Nanoseconds>(std::stoull(line, nullptr, 16)) * pins_.cycle;
    if (line.find("Read: ") != std::string::npos && line.find("from porta(") != std::string::npos) {
      if (sampled_ != 0) {
        run.longest_turn = std::max(run.longest_turn, static_cast<std::uint64_t>((at_ - sampled_) / pins_.cycle));
      }
      sampled_ = at_;
    }
    // If gpsim does not find the source, it ends no line after its number.
    const std::size_t written = line.find("Wrote: ");
    if (written != std::string::npos) read_write(line.substr(written), run);
  }
}

void PicLog::read_write(const std::string& words, FollowerRun& run) {
  has_writes_ = true;
  std::istringstream in(words);
  std::string wrote;
  std::string value;
  std::string to;
  std::string where;
  in >> wrote >> value >> to >> where;
  const std::string port = where.substr(0, where.find('('));
  const auto now = static_cast<unsigned>(std::stoul(value, nullptr, 16));
  for (const auto& [output, output_pins] : pins_.outputs) {
    if (output_pins.port != port) continue;
    const unsigned shown = value_on(output_pins, now);
    unsigned& before = values_.try_emplace(output, 0U).first->second;
    if (shown != before) {
      run.changes.push_back({at_, output, output_pins.bits.size() == 4 ? winding_text(shown) : std::to_string(shown)});
    }
    before = shown;
  }
}

}  // namespace passo
