#include "tiff_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <zlib.h>

namespace passo {
namespace {

constexpr std::uint16_t ascii_type = 2;

// Bytes of a number of this type; 0: no whole number, or none that is known.
std::size_t size_of_type(std::uint16_t type) {
  switch (type) {
    case 1:
    case ascii_type: return 1;
    case 3: return 2;
    case 4: return 4;
    case 16: return 8;
    default: return 0;
  }
}

std::uint8_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

bool unpack_bits(std::string_view block, std::size_t size, std::string& out) {
  for (std::size_t i = 0; i < block.size() && out.size() < size;) {
    const unsigned head = byte_at(block, i++);
    if (head == 128) continue;
    if (head < 128) {
      const std::size_t count = std::min<std::size_t>(head + 1, block.size() - i);
      out.append(block.substr(i, count));
      i += count;
    } else if (i < block.size()) {
      out.append(257 - head, block[i++]);
    }
  }
  return out.size() >= size;
}

bool inflate_block(std::string_view block, std::size_t size, std::string& out) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return false;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(block.data()));  // NOLINT: zlib does not write there
  stream.avail_in = static_cast<uInt>(std::min<std::size_t>(block.size(), 0xFFFF'FFFFU));
  std::array<char, 65536> piece{};
  int state = Z_OK;
  while (state == Z_OK && out.size() < size) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = piece.size();
    state = inflate(&stream, Z_NO_FLUSH);
    out.append(piece.data(), piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return out.size() >= size;
}

// Codes of 9 to 12 bits, the highest bit first. A string of the table is what an earlier one was, and a byte more: so
// it is a piece of what was written already.
class LzwReader {
 public:
  LzwReader(std::string_view block, std::string& out) : block_(block), out_(out) {}

  bool read(std::size_t size) {
    constexpr unsigned clear = 256;
    constexpr unsigned end = 257;
    bool is_first = true;
    while (out_.size() < size) {
      const std::optional<unsigned> code = next();
      if (!code || *code == end) return false;
      if (*code == clear) {
        count_ = 0;
        width_ = 9;
        is_first = true;
        continue;
      }
      const std::size_t begin = out_.size();
      if (!put(*code, is_first)) return false;
      if (!is_first && count_ < strings_.size()) {
        strings_[count_++] = {last_, begin - last_ + 1};
        // A code becomes wider one string before it must.
        const std::size_t next_code = first_string + count_ + 1;
        width_ = next_code >= 2048 ? 12 : next_code >= 1024 ? 11 : next_code >= 512 ? 10 : 9;
      }
      last_ = begin;
      is_first = false;
    }
    return true;
  }

 private:
  static constexpr std::size_t first_string = 258;
  struct String {
    std::size_t begin = 0;
    std::size_t size = 0;
  };

  std::optional<unsigned> next() {
    while (held_ < width_) {
      if (at_ == block_.size()) return std::nullopt;
      bits_ = (bits_ << 8U) | byte_at(block_, at_++);
      held_ += 8;
    }
    held_ -= width_;
    const unsigned code = (bits_ >> held_) & ((1U << width_) - 1);
    bits_ &= (1U << held_) - 1;
    return code;
  }
  bool put(unsigned code, bool is_first) {
    if (code < 256) {
      out_ += static_cast<char>(code);
      return true;
    }
    const std::size_t index = code - first_string;
    if (is_first || index > count_) return false;
    String string;
    if (index < count_) {
      string = strings_[index];
    } else {
      string = {last_, out_.size() - last_ + 1};  // the last one, and its first byte again
    }
    for (std::size_t i = 0; i < string.size; ++i) out_ += out_[string.begin + i];
    return true;
  }

  std::string_view block_;
  std::string& out_;
  std::array<String, 4096 - first_string> strings_{};
  std::size_t count_ = 0;
  std::size_t last_ = 0;  // where the last string began
  std::size_t at_ = 0;
  unsigned bits_ = 0;
  unsigned held_ = 0;
  unsigned width_ = 9;
};

}  // namespace

bool TiffFile::is_one(std::string_view bytes) {
  using namespace std::string_view_literals;
  const std::string_view mark = bytes.substr(0, 4);
  return mark == "II*\0"sv || mark == "MM\0*"sv || mark == "II+\0"sv || mark == "MM\0+"sv;
}

TiffFile::TiffFile(std::string_view bytes) : bytes_(bytes) {
  if (bytes_.size() < 16) {
    fault_ = "the file ends too early";
    return;
  }
  big_ = bytes_[0] == 'M';
  const bool is_large = whole(2, 2) == 43;  // BigTIFF: places of 8 bytes
  const std::uint64_t directory = is_large ? whole(8, 8) : whole(4, 4);
  const std::size_t count_size = is_large ? 8 : 2;
  const std::size_t entry_size = is_large ? 20 : 12;
  const std::size_t place_size = is_large ? 8 : 4;
  if (directory >= bytes_.size() || bytes_.size() - directory < count_size) {
    fault_ = "the file ends before its directory";
    return;
  }
  const std::uint64_t count = whole(directory, count_size);
  if (count > (bytes_.size() - directory - count_size) / entry_size) {
    fault_ = "the file ends within its directory";
    return;
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t at = directory + count_size + i * entry_size;
    Entry entry{.type = static_cast<std::uint16_t>(whole(at + 2, 2)), .count = whole(at + 4, place_size)};
    const std::size_t size = size_of_type(entry.type);
    if (size == 0) continue;
    const std::uint64_t values = at + 4 + place_size;
    entry.offset = entry.count <= place_size / size ? values : whole(values, place_size);
    entries_.emplace(static_cast<std::uint16_t>(whole(at, 2)), entry);
  }
}

std::uint64_t TiffFile::whole(std::uint64_t offset, std::size_t size) const {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t at = offset + (big_ ? i : size - 1 - i);
    value = value << 8U | byte_at(bytes_, at);
  }
  return value;
}

std::vector<std::uint64_t> TiffFile::numbers(TiffField field) const {
  const auto found = entries_.find(static_cast<std::uint16_t>(field));
  if (found == entries_.end()) return {};
  const Entry& entry = found->second;
  const std::size_t size = size_of_type(entry.type);
  constexpr std::uint64_t most = 4'000'000;
  if (entry.count > most || entry.offset >= bytes_.size()) return {};
  if (entry.count > (bytes_.size() - entry.offset) / size) return {};
  std::vector<std::uint64_t> all(entry.count);
  for (std::uint64_t i = 0; i < entry.count; ++i) all[i] = whole(entry.offset + i * size, size);
  return all;
}

std::uint64_t TiffFile::number(TiffField field, std::uint64_t otherwise) const {
  const std::vector<std::uint64_t> all = numbers(field);
  return all.empty() ? otherwise : all.front();
}

std::string TiffFile::text(TiffField field) const {
  std::string words;
  for (const std::uint64_t letter : numbers(field)) words += static_cast<char>(letter);
  return words.substr(0, words.find('\0'));
}

std::string_view TiffFile::bytes_at(std::uint64_t offset, std::uint64_t size) const {
  return offset < bytes_.size() ? bytes_.substr(offset, size) : std::string_view();
}

std::string unread_compression(std::uint64_t compression) {
  switch (compression) {
    case 1:
    case 5:
    case 8:
    case 32773:
    case 32946: return "";
    case 2:
    case 3:
    case 4: return "fax compression";
    case 6:
    case 7: return "JPEG";
    case 34712: return "JPEG 2000";
    case 34925: return "LZMA";
    case 50000: return "Zstandard";
    case 50001: return "WebP";
    default: return fmt::format("number {}", compression);
  }
}

std::optional<std::string> unpacked(std::string_view block, std::uint64_t compression, std::size_t size) {
  std::string out;
  const bool is_whole = compression == 5       ? LzwReader(block, out).read(size)
                        : compression == 32773 ? unpack_bits(block, size, out)
                        : compression == 1     ? (out = block.substr(0, size)).size() == size
                                               : inflate_block(block, size, out);
  if (!is_whole) return std::nullopt;
  out.resize(size);
  return out;
}

}  // namespace passo
