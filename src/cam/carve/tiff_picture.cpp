#include "tiff_picture.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "pixel_level.hpp"
#include "tiff_file.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

enum class NumberKind : std::uint8_t { without_sign = 1, with_sign = 2, floating = 3 };
enum class Photometric : std::uint8_t { white_is_zero, black_is_zero, colour, palette };

// What the fields say.
struct TiffLayout {
  std::size_t columns = 0;
  std::size_t rows = 0;
  unsigned bits = 8;           // of a sample
  unsigned samples = 1;        // of a pixel
  unsigned used = 1;           // of them: colours, and alpha where it counts
  unsigned alpha = 0;          // which sample is alpha; 0: none
  bool is_multiplied = false;  // colours are multiplied by alpha already
  bool is_planar = false;      // blocks have one sample of each pixel
  NumberKind kind = NumberKind::without_sign;
  Photometric photometric = Photometric::black_is_zero;
  std::uint64_t compression = 1;
  std::uint64_t predictor = 1;
  bool is_reversed = false;  // the lowest bit of a byte comes first
  std::size_t block_columns = 0;
  std::size_t block_rows = 0;
  bool is_tiled = false;

  bool is_measured() const { return kind != NumberKind::without_sign; }
  unsigned samples_in_block() const { return is_planar ? 1 : samples; }
  std::size_t row_bytes() const { return (block_columns * samples_in_block() * bits + 7) / 8; }
  std::size_t across() const { return (columns + block_columns - 1) / block_columns; }
  std::size_t down() const { return (rows + block_rows - 1) / block_rows; }
};

class TiffReading {
 public:
  TiffReading(std::string_view bytes, PixelLevel level) : file_(bytes), level_(level), fault_(file_.fault()) {}

  LevelPicture read();
  const std::string& fault() const { return fault_; }

 private:
  bool refuse(std::string why) {
    if (fault_.empty()) fault_ = std::move(why);
    return false;
  }
  bool read_size();
  bool read_samples();
  bool read_blocks();
  bool read_colours();
  bool unpack(std::size_t index, std::size_t plane, std::size_t rows, std::string& out);
  void undo_predictor(std::string& block, std::size_t rows) const;
  void take_block(std::size_t index, const std::vector<std::string>& planes, std::size_t rows);
  std::uint32_t sample(const std::string& block, std::size_t row, std::size_t index) const;
  std::uint16_t widened(std::uint32_t sample) const;
  std::uint16_t level_of(const std::uint32_t* samples) const;
  float measured(std::uint32_t sample) const;
  void stretch();
  std::string kind_words() const;

  TiffFile file_;
  PixelLevel level_;
  std::string fault_;
  TiffLayout layout_;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint16_t> palette_;  // levels
  LevelPicture picture_;
  std::vector<float> heights_;  // where they are measured
};

bool TiffReading::read_size() {
  const std::uint64_t columns = file_.number(TiffField::width, 0);
  const std::uint64_t rows = file_.number(TiffField::length, 0);
  if (columns == 0 || rows == 0) return refuse("it has no size");
  if (columns < 2 || rows < 2) return refuse("it has fewer than two rows or columns");
  if (columns > most_pixels_a_side || rows > most_pixels_a_side || columns * rows > most_pixels) {
    return refuse("it has more than 64 million pixels, or more than 65,535 per side");
  }
  layout_.columns = columns;
  layout_.rows = rows;
  return true;
}

bool TiffReading::read_samples() {
  const std::uint64_t samples = file_.number(TiffField::samples, 1);
  constexpr std::uint64_t most_samples = 16;
  if (samples == 0 || samples > most_samples)
    return refuse(fmt::format("{} samples per pixel are not supported", samples));
  layout_.samples = static_cast<unsigned>(samples);
  std::vector<std::uint64_t> bits = file_.numbers(TiffField::bits);
  if (bits.empty()) bits = {1};
  if (std::any_of(bits.begin(), bits.end(), [&](std::uint64_t size) { return size != bits.front(); })) {
    return refuse("its samples differ in size");
  }
  if (bits.front() > 32 || !std::has_single_bit(bits.front())) {
    return refuse(fmt::format("samples of {} are not supported", counted(bits.front(), "bit")));
  }
  layout_.bits = static_cast<unsigned>(bits.front());
  const std::uint64_t kind = file_.number(TiffField::number_kind, 1);
  if (kind == 0 || kind > 4) return refuse("complex samples are not supported");
  layout_.kind = kind == 4 ? NumberKind::without_sign : static_cast<NumberKind>(kind);
  if (layout_.kind == NumberKind::floating && layout_.bits != 32) {
    return refuse(fmt::format("floating-point samples of {} are not supported", counted(layout_.bits, "bit")));
  }
  if (layout_.kind == NumberKind::with_sign && layout_.bits < 8)
    return refuse("signed samples of this size are not supported");
  const std::uint64_t photometric = file_.number(TiffField::photometric, 1);
  if (photometric > 3) return refuse("its colours are not greyscale, RGB or a palette");
  layout_.photometric = static_cast<Photometric>(photometric);
  const bool is_colour = layout_.photometric == Photometric::colour;
  const unsigned colours = is_colour ? 3 : 1;
  if (layout_.samples < colours) return refuse("its pixels have fewer than three colour samples");
  if (layout_.is_measured() && layout_.photometric != Photometric::black_is_zero) {
    return refuse("signed or floating-point samples are only supported in greyscale");
  }
  const std::vector<std::uint64_t> extra = file_.numbers(TiffField::extra_samples);
  if (!extra.empty() && layout_.samples > colours && (extra.front() == 1 || extra.front() == 2)) {
    layout_.alpha = colours;
    layout_.is_multiplied = extra.front() == 1;
  }
  if (level_ == PixelLevel::alpha && layout_.alpha == 0) return refuse("it has no alpha channel");
  layout_.used = colours + (layout_.alpha > 0 ? 1 : 0);
  return true;
}

bool TiffReading::read_blocks() {
  layout_.compression = file_.number(TiffField::compression, 1);
  if (const std::string name = unread_compression(layout_.compression); !name.empty()) {
    return refuse(
        fmt::format("its compression ({}) is not supported: save it uncompressed, or with LZW or Deflate", name));
  }
  layout_.predictor = file_.number(TiffField::predictor, 1);
  const bool is_floating = layout_.predictor == 3;
  if (layout_.predictor > 3 || layout_.predictor == 0 || (layout_.predictor == 2 && layout_.bits < 8) ||
      (is_floating && layout_.kind != NumberKind::floating)) {
    return refuse("its predictor does not suit its samples");
  }
  layout_.is_reversed = file_.number(TiffField::fill_order, 1) == 2;
  layout_.is_planar = file_.number(TiffField::planes, 1) == 2 && layout_.samples > 1;
  layout_.is_tiled = !file_.numbers(TiffField::tile_offsets).empty();
  layout_.block_columns = layout_.is_tiled ? file_.number(TiffField::tile_width, 0) : layout_.columns;
  layout_.block_rows = layout_.is_tiled
                           ? file_.number(TiffField::tile_length, 0)
                           : std::min<std::uint64_t>(file_.number(TiffField::rows_a_strip, layout_.rows), layout_.rows);
  constexpr std::size_t most_block = 400'000'000;  // bytes
  if (layout_.block_columns == 0 || layout_.block_rows == 0 || layout_.block_columns > 2 * most_pixels_a_side ||
      layout_.block_rows > 2 * most_pixels_a_side || layout_.row_bytes() * layout_.block_rows > most_block) {
    return refuse("its strips or tiles have no size, or more than 400 MB");
  }
  offsets_ = file_.numbers(layout_.is_tiled ? TiffField::tile_offsets : TiffField::strip_offsets);
  sizes_ = file_.numbers(layout_.is_tiled ? TiffField::tile_sizes : TiffField::strip_sizes);
  const std::size_t blocks = layout_.across() * layout_.down() * (layout_.is_planar ? layout_.samples : 1);
  // Very old files have one strip, and do not say how long it is.
  if (sizes_.empty() && offsets_.size() == 1) sizes_ = {std::numeric_limits<std::uint32_t>::max()};
  if (offsets_.size() < blocks || sizes_.size() < blocks) return refuse("offsets of its strips or tiles are missing");
  // No kind of compression makes more of a byte.
  constexpr std::uint64_t most_of_a_byte = 4000;
  std::uint64_t packed = 0;
  for (std::size_t i = 0; i < blocks; ++i) packed += file_.bytes_at(offsets_[i], sizes_[i]).size();
  if (packed * most_of_a_byte < layout_.columns * layout_.rows * layout_.bits / 8) {
    return refuse("the file ends too early");
  }
  return true;
}

bool TiffReading::read_colours() {
  if (layout_.photometric != Photometric::palette) return true;
  if (layout_.bits > 8) return refuse("its palette has too many colours");
  const std::vector<std::uint64_t> colours = file_.numbers(TiffField::colours);
  const std::size_t count = std::size_t{1} << layout_.bits;
  if (colours.size() < 3 * count) return refuse("its palette is missing");
  // Some programs write 8 bits.
  const bool is_narrow = std::all_of(colours.begin(), colours.end(), [](std::uint64_t colour) { return colour < 256; });
  const std::uint64_t scale = is_narrow ? 257 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    palette_.push_back(static_cast<std::uint16_t>(
        luminance_of(colours[i] * scale, colours[count + i] * scale, colours[2 * count + i] * scale)));
  }
  return true;
}

bool TiffReading::unpack(std::size_t index, std::size_t plane, std::size_t rows, std::string& out) {
  const std::size_t block = plane * layout_.across() * layout_.down() + index;
  std::string_view bytes = file_.bytes_at(offsets_[block], sizes_[block]);
  std::string turned;
  if (layout_.is_reversed) {
    for (const char c : bytes) {
      unsigned reversed = 0;
      for (unsigned bit = 0; bit < 8; ++bit) reversed |= ((static_cast<unsigned>(c) >> bit) & 1U) << (7 - bit);
      turned += static_cast<char>(reversed);
    }
    bytes = turned;
  }
  std::optional<std::string> plain = unpacked(bytes, layout_.compression, layout_.row_bytes() * rows);
  if (!plain) return refuse("its data is damaged or truncated");
  out = std::move(*plain);
  undo_predictor(out, rows);
  return true;
}

// Each sample was written as its difference from the one to its left.
void TiffReading::undo_predictor(std::string& block, std::size_t rows) const {
  if (layout_.predictor == 1) return;
  const std::size_t row_bytes = layout_.row_bytes();
  const std::size_t samples = layout_.samples_in_block();
  const std::size_t size = layout_.bits / 8;
  std::string planes(row_bytes, 0);
  for (std::size_t row = 0; row < rows; ++row) {
    char* const at = block.data() + row * row_bytes;
    if (layout_.predictor == 3) {
      // First all first bytes of the row's numbers, then all second ones: each byte a difference.
      for (std::size_t i = samples; i < row_bytes; ++i) at[i] = static_cast<char>(at[i] + at[i - samples]);
      std::copy_n(at, row_bytes, planes.begin());
      const std::size_t count = row_bytes / size;
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t b = 0; b < size; ++b) {
          at[i * size + (file_.is_big_endian() ? b : size - 1 - b)] = planes[b * count + i];
        }
      }
      continue;
    }
    for (std::size_t i = samples; i < row_bytes / size; ++i) {
      unsigned carry = 0;
      for (std::size_t b = 0; b < size; ++b) {
        const std::size_t digit = file_.is_big_endian() ? size - 1 - b : b;
        const unsigned sum = static_cast<std::uint8_t>(at[i * size + digit]) +
                             static_cast<std::uint8_t>(at[(i - samples) * size + digit]) + carry;
        at[i * size + digit] = static_cast<char>(sum & 0xFFU);
        carry = sum >> 8U;
      }
    }
  }
}

std::uint32_t TiffReading::sample(const std::string& block, std::size_t row, std::size_t index) const {
  const char* const begin = block.data() + row * layout_.row_bytes();
  if (layout_.bits < 8) {
    const std::size_t bit = index * layout_.bits;
    const unsigned shift = 8 - layout_.bits - static_cast<unsigned>(bit % 8);
    return (static_cast<std::uint8_t>(begin[bit / 8]) >> shift) & ((1U << layout_.bits) - 1);
  }
  const std::size_t size = layout_.bits / 8;
  std::uint32_t value = 0;
  for (std::size_t b = 0; b < size; ++b) {
    value = value << 8U | static_cast<std::uint8_t>(begin[index * size + (file_.is_big_endian() ? b : size - 1 - b)]);
  }
  return value;
}

std::uint16_t TiffReading::widened(std::uint32_t sample) const {
  if (layout_.bits == 32) return static_cast<std::uint16_t>(sample >> 16U);
  return static_cast<std::uint16_t>(sample * (65535U / ((1U << layout_.bits) - 1)));
}

std::uint16_t TiffReading::level_of(const std::uint32_t* samples) const {
  const std::uint16_t alpha = layout_.alpha > 0 ? widened(samples[layout_.alpha]) : std::uint16_t{65535};
  if (level_ == PixelLevel::alpha) return alpha;
  std::uint64_t luminance = 0;
  switch (layout_.photometric) {
    case Photometric::white_is_zero: luminance = 65535U - widened(samples[0]); break;
    case Photometric::black_is_zero: luminance = widened(samples[0]); break;
    case Photometric::colour:
      luminance = luminance_of(widened(samples[0]), widened(samples[1]), widened(samples[2]));
      break;
    case Photometric::palette: luminance = palette_[samples[0]]; break;
  }
  return layout_.is_multiplied ? static_cast<std::uint16_t>(luminance) : faded(luminance, alpha);
}

float TiffReading::measured(std::uint32_t sample) const {
  if (layout_.kind == NumberKind::floating) return std::bit_cast<float>(sample);
  const unsigned shift = 32 - layout_.bits;
  return static_cast<float>(static_cast<std::int32_t>(sample << shift) >> shift);
}

void TiffReading::take_block(std::size_t index, const std::vector<std::string>& planes, std::size_t rows) {
  const std::size_t left = index % layout_.across() * layout_.block_columns;
  const std::size_t top = index / layout_.across() * layout_.block_rows;
  const std::size_t columns = std::min(layout_.block_columns, layout_.columns - left);
  std::uint32_t samples[4] = {};
  for (std::size_t row = 0; row < std::min(rows, layout_.rows - top); ++row) {
    const std::size_t to = (top + row) * layout_.columns + left;
    for (std::size_t x = 0; x < columns; ++x) {
      for (unsigned i = 0; i < layout_.used; ++i) {
        samples[i] = layout_.is_planar ? sample(planes[i], row, x) : sample(planes[0], row, x * layout_.samples + i);
      }
      if (layout_.is_measured()) {
        heights_[to + x] = measured(samples[0]);
      } else {
        picture_.levels[to + x] = level_of(samples);
      }
    }
  }
}

// The least height becomes black, the greatest white. Where nothing was measured it is black.
void TiffReading::stretch() {
  const std::string words = file_.text(TiffField::no_data);
  float nothing = std::numeric_limits<float>::quiet_NaN();
  std::from_chars(words.data(), words.data() + words.size(), nothing);
  float least = std::numeric_limits<float>::infinity();
  float most = -least;
  for (float& height : heights_) {
    if (!std::isfinite(height) || height == nothing) height = std::numeric_limits<float>::quiet_NaN();
    least = std::min(least, std::isnan(height) ? least : height);
    most = std::max(most, std::isnan(height) ? most : height);
  }
  if (!(least < most)) {
    refuse("all its heights are the same, or none is a number");
    return;
  }
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const double share = (static_cast<double>(heights_[i]) - static_cast<double>(least)) /
                         (static_cast<double>(most) - static_cast<double>(least));
    picture_.levels[i] = std::isnan(heights_[i]) ? std::uint16_t{0} : static_cast<std::uint16_t>(share * 65535 + 0.5);
  }
  picture_.kind += fmt::format(" from {:g} to {:g}", least, most);
}

std::string TiffReading::kind_words() const {
  if (layout_.kind == NumberKind::floating) return "floating-point heights";
  if (layout_.kind == NumberKind::with_sign) return fmt::format("{} bit heights", layout_.bits);
  const bool is_grey = layout_.photometric != Photometric::colour && layout_.photometric != Photometric::palette;
  return fmt::format("{} bit {}{}", layout_.bits, is_grey ? "grey" : "colour", layout_.alpha > 0 ? " with alpha" : "");
}

// Turns the picture so that its first row is the upper one. Turned by a quarter, rows and columns change places.
void turn(LevelPicture& picture, std::uint64_t orientation) {
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  const bool is_quarter = orientation >= 5 && orientation <= 8;
  if (!from_right && !from_below && !is_quarter) return;
  const std::size_t columns = is_quarter ? picture.rows : picture.columns;
  const std::size_t rows = is_quarter ? picture.columns : picture.rows;
  std::vector<std::uint16_t> levels(picture.levels.size());
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t across = from_right ? columns - 1 - x : x;
      const std::size_t down = from_below ? rows - 1 - y : y;
      levels[y * columns + x] =
          picture.levels[is_quarter ? across * picture.columns + down : down * picture.columns + across];
    }
  }
  picture.columns = columns;
  picture.rows = rows;
  picture.levels = std::move(levels);
}

LevelPicture TiffReading::read() {
  if (!fault_.empty() || !read_size() || !read_samples() || !read_blocks() || !read_colours()) return {};
  picture_.columns = layout_.columns;
  picture_.rows = layout_.rows;
  picture_.kind = kind_words();
  picture_.levels.resize(layout_.columns * layout_.rows);
  if (layout_.is_measured()) heights_.resize(picture_.levels.size());
  std::vector<std::string> planes(layout_.is_planar ? layout_.used : 1);
  for (std::size_t i = 0; i < layout_.across() * layout_.down(); ++i) {
    // The last strip is shorter, the last tile is not.
    const std::size_t top = i / layout_.across() * layout_.block_rows;
    const std::size_t rows = layout_.is_tiled ? layout_.block_rows : std::min(layout_.block_rows, layout_.rows - top);
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
      if (!unpack(i, plane, rows, planes[plane])) return {};
    }
    take_block(i, planes, rows);
  }
  if (layout_.is_measured()) stretch();
  if (!fault_.empty()) return {};
  turn(picture_, file_.number(TiffField::orientation, 1));
  return std::move(picture_);
}

}  // namespace

LevelPicture read_tiff(std::string_view bytes, PixelLevel level, std::string& fault) {
  TiffReading reading(bytes, level);
  LevelPicture picture = reading.read();
  fault = reading.fault();
  return picture;
}

}  // namespace passo
