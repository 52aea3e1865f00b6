// TraceBuffer: collects the text of a trace and passes it on in large pieces.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "passo/report/trace.hpp"

namespace passo {

class TraceBuffer {
 public:
  explicit TraceBuffer(TraceSink sink) : sink_(std::move(sink)), text_(std::make_unique<char[]>(size)) {}

  // At most `longest` bytes may be added between two calls of make_room().
  void make_room() {
    if (used_ > size - longest) flush();
  }
  void put(char c) { text_[used_++] = c; }
  void put(std::string_view text) {
    std::memcpy(&text_[used_], text.data(), text.size());
    used_ += text.size();
  }
  void put(std::uint64_t number) {
    char* const from = &text_[used_];
    used_ += static_cast<std::size_t>(std::to_chars(from, from + 20, number).ptr - from);
  }
  // Writes a decimal point and nine digits.
  void put_decimals(std::uint64_t billionths) {
    put(1'000'000'000 + billionths);
    text_[used_ - 10] = '.';
  }
  void flush() {
    if (used_ != 0) sink_({text_.get(), used_});
    used_ = 0;
  }

  static constexpr std::size_t longest = 1024;

 private:
  static constexpr std::size_t size = 65536;

  TraceSink sink_;
  std::unique_ptr<char[]> text_;
  std::size_t used_ = 0;
};

}  // namespace passo
