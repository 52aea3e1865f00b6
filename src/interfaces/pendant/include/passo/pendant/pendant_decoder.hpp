// PendantDecoder: finds what has changed on a pendant from its reports.
//
// Position in the pipeline: PendantDevice -> PendantDecoder -> PendantControl. Reports are untrusted: one of the wrong
// length or with another id is ignored.
//
// Invariant: the first report gives only the positions of selectors, wheel and keys. A key that is held when the
// pendant is connected does nothing until it is pressed again, and so does a ring that is turned.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passo/pendant/pendant_table.hpp"

namespace passo {

struct PendantEvent {
  enum class Kind : std::uint8_t {
    wheel,      // `number`: detents, signed
    ring,       // `number`: position, signed; 0: let go
    axis,       // `axis`: the selected one; empty: off
    step,       // `number`: index of the selected step; negative: none
    press,      // `key`
    release,    // `key`
    link_lost,  // the transmitter has lost the pendant, or it is switched off
    link_is_back,
  };
  Kind kind = Kind::wheel;
  int number = 0;
  std::optional<Axis> axis = {};
  const PendantKey* key = nullptr;  // of the table
};
// Returns "wheel +2", "key Stop pressed".
std::string describe(const PendantEvent& event, const PendantTable& table);

class PendantDecoder {
 public:
  // `table` must outlive the decoder and its events.
  explicit PendantDecoder(const PendantTable& table) : table_(table) {}

  std::vector<PendantEvent> decode(std::span<const std::uint8_t> report);
  // The pendant was disconnected: the next report is the first one again.
  void forget() { last_.clear(); }

 private:
  bool says_no_link(std::span<const std::uint8_t> report) const;
  bool is_held(std::span<const std::uint8_t> report, const PendantKey& key) const;
  void decode_wheel(std::span<const std::uint8_t> report, std::vector<PendantEvent>& events) const;
  void decode_keys(std::span<const std::uint8_t> report, std::vector<PendantEvent>& events) const;
  void decode_selectors(std::span<const std::uint8_t> report, std::vector<PendantEvent>& events) const;

  const PendantTable& table_;
  std::vector<std::uint8_t> last_;  // empty: none yet
  bool has_link_ = true;
};

}  // namespace passo
