// TiffFile: the fields of the first picture in a TIFF file, and the bytes of its blocks. Private to carve/.
//
// A block is a strip of whole rows, or a tile. Supports classic TIFF and BigTIFF in both byte orders; blocks without
// compression or compressed by PackBits, LZW or Deflate. libtiff is not used: as Debian builds it, it loads a library
// that is under the GPL.
//
// Source: TIFF, Revision 6.0, Adobe, 1992; TIFF Technical Note 3 (predictor of floating-point numbers), 2005.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

enum class TiffField : std::uint16_t {
  width = 256,
  length = 257,
  bits = 258,
  compression = 259,
  photometric = 262,
  fill_order = 266,
  strip_offsets = 273,
  orientation = 274,
  samples = 277,
  rows_a_strip = 278,
  strip_sizes = 279,
  planes = 284,
  predictor = 317,
  colours = 320,
  tile_width = 322,
  tile_length = 323,
  tile_offsets = 324,
  tile_sizes = 325,
  extra_samples = 338,
  number_kind = 339,
  no_data = 42113,  // GDAL tag: the number, as text, that marks missing data
};

class TiffFile {
 public:
  static bool is_one(std::string_view bytes);

  // `bytes` must outlive this object. fault() describes the error if the file is corrupt.
  explicit TiffFile(std::string_view bytes);
  const std::string& fault() const { return fault_; }

  bool is_big_endian() const { return big_; }
  // Returns all numbers of a field; empty if the field is missing or corrupt.
  std::vector<std::uint64_t> numbers(TiffField field) const;
  std::uint64_t number(TiffField field, std::uint64_t otherwise) const;
  std::string text(TiffField field) const;

  // Returns the bytes of the file from an offset; truncated at the end of the file.
  std::string_view bytes_at(std::uint64_t offset, std::uint64_t size) const;

 private:
  struct Entry {
    std::uint16_t type = 0;
    std::uint64_t count = 0;
    std::uint64_t offset = 0;  // offset of its values in the file
  };
  std::uint64_t whole(std::uint64_t offset, std::size_t size) const;

  std::string_view bytes_;
  bool big_ = false;
  std::map<std::uint16_t, Entry> entries_;
  std::string fault_;
};

// Returns the name of an unsupported compression method; empty if it is supported.
std::string unread_compression(std::uint64_t compression);

// Decompresses a block to `size` bytes. Empty if the data is corrupt or too short. Memory grows with the actual data.
std::optional<std::string> unpacked(std::string_view block, std::uint64_t compression, std::size_t size);

}  // namespace passo
