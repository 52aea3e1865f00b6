// TriangleWriter: writes a solid as a binary STL file. Private to report/.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "passo/report/output_file.hpp"

namespace passo {

using Corner = std::array<float, 3>;

class TriangleWriter {
 public:
  // Without a file the triangles are only counted.
  explicit TriangleWriter(OutputFile* file) : file_(file) {}

  void add(const Corner& a, const Corner& b, const Corner& c) {
    ++count_;
    if (file_ == nullptr) return;
    for (const float part : normal_of(a, b, c)) append(part);
    for (const Corner* corner : {&a, &b, &c}) {
      for (const float part : *corner) append(part);
    }
    append(std::uint16_t{0});
    constexpr std::size_t written_at_once = 1 << 16;
    if (bytes_.size() >= written_at_once) flush();
  }
  void square(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    add(a, b, c);
    add(a, c, d);
  }
  void flush() {
    if (file_ != nullptr) file_->write(bytes_);
    bytes_.clear();
  }
  std::uint64_t count() const { return count_; }

  // Appends a number in little-endian order.
  template <class Number>
  void append(Number number) {
    static_assert(std::endian::native == std::endian::little);
    char raw[sizeof number];  // NOLINT
    std::memcpy(raw, &number, sizeof number);
    bytes_.append(raw, sizeof number);
  }
  void head(std::string_view words, std::uint64_t triangles) {
    constexpr std::size_t head_size = 80;
    bytes_ = words;
    bytes_.resize(head_size, ' ');
    append(static_cast<std::uint32_t>(triangles));
  }

 private:
  static Corner normal_of(const Corner& a, const Corner& b, const Corner& c) {
    const Corner u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Corner v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    Corner n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& part : n) part = size > 0 ? part / size : 0;
    return n;
  }

  OutputFile* file_;
  std::string bytes_;
  std::uint64_t count_ = 0;
};

// Writes the triangles that `write` adds to a TriangleWriter; returns their number. `write` is called twice, because
// the file begins with the number.
template <class Write>
std::uint64_t write_triangles(std::string_view words, OutputFile& file, Write&& write) {
  TriangleWriter counter(nullptr);
  write(counter);
  TriangleWriter writer(&file);
  writer.head(words, counter.count());
  write(writer);
  writer.flush();
  return counter.count();
}

}  // namespace passo
