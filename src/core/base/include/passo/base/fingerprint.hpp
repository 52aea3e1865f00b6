// Fingerprint: a hash of 64 bits for comparing two pieces of data. It detects accidental changes, not forgery.
//
// FNV-1a (Fowler, Noll, Vo) over words of eight bytes instead of single bytes. A shift after each word mixes high bits
// into the low ones.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace passo {

class Fingerprint {
 public:
  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x100000001B3U;
    state_ ^= state_ >> 32U;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  // The length is added too, so that "ab" and "c" differ from "a" and "bc".
  void add(std::string_view bytes) {
    add(std::uint64_t{bytes.size()});
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
      add(word);
    }
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325U;
};

}  // namespace passo
