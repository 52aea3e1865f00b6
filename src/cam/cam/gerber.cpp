#include "passo/cam/gerber.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "gerber_apertures.hpp"
#include "gerber_attributes.hpp"
#include "gerber_old_codes.hpp"
#include "text_lines.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr int draw_code = 1;
constexpr int move_code = 2;
constexpr int flash_code = 3;

// A letter and the text of its number.
struct GerberWord {
  char letter = 0;
  std::string_view number;
  std::size_t at = 0;  // of the letter, in the command's words
};

class GerberReader {
 public:
  GerberReader(const std::string& name, std::string_view text, Diagnostics& diagnostics, std::size_t most_points)
      : file_(name),
        text_(text),
        findings_(file_, text_, diagnostics),
        attributes_(layer_),
        old_codes_(findings_, numbers_),
        plotter_(layer_, findings_, most_points),
        apertures_(layer_, findings_, numbers_, plotter_) {
    find_unit(text);
  }

  GerberLayer read();

 private:
  void find_unit(std::string_view text);
  void read_plain();
  bool read_words();
  void obey(const GerberWord& word);
  void obey_g(const GerberWord& word);
  void obey_d(const GerberWord& word);
  void operate();
  std::optional<int> code_of(const GerberWord& word);
  bool read_place(DrawnPoint& place, ArcWords& arc);

  void read_extended();
  void read_format();
  void read_unit();
  void read_polarity();
  void read_transformation();
  void read_repeat();
  void read_block();
  void finish();

  std::string_view words() const { return findings_.command.words; }

  std::string file_;
  GerberText text_;
  GerberLayer layer_;
  GerberFindings findings_;
  GerberNumbers numbers_;
  GerberAttributes attributes_;
  GerberOldCodes old_codes_;
  GerberPlotter plotter_;
  GerberApertures apertures_;

  std::vector<GerberWord> line_;  // the words of a plain command
  int operation_ = 0;             // the last D01, D02 or D03
  Nanometres x_;                  // the last coordinates, as the file has them
  Nanometres y_;
  bool in_macro_ = false;
  bool has_format_ = false;
  bool has_unit_ = false;
  bool ended_ = false;
};

// Apertures may be defined before a late MO or G71 names the unit.
void GerberReader::find_unit(std::string_view text) {
  constexpr std::array units = {"%MOIN", "%MOMM", "G70*", "G71*", "*MOIN*", "*MOMM*"};
  std::size_t first = text.size();
  for (const std::string_view unit : units) {
    const std::size_t at = text.substr(0, first).find(unit);
    if (at == std::string_view::npos) continue;
    first = at;
    numbers_.is_inch = unit.find("IN") != std::string_view::npos || unit == "G70*";
    has_unit_ = true;
  }
  if (!has_unit_) findings_.note("the file does not give its unit; inch is assumed, as in old files");
}

GerberLayer GerberReader::read() {
  layer_.strokes.file = file_;
  while (!ended_ && !findings_.full() && !plotter_.is_full() && text_.next(findings_.command)) {
    if (findings_.command.is_extended) {
      read_extended();
    } else {
      in_macro_ = false;
      read_plain();
    }
  }
  finish();
  return std::move(layer_);
}

void GerberReader::finish() {
  GerberImage image = plotter_.finish();
  if (old_codes_.quarter_turns() != 0) {
    GerberPlacement placement;
    placement.radians = old_codes_.quarter_turns() * std::numbers::pi / 2;
    GerberImage turned_image;
    turned_image.add(image, placement, true);
    image = std::move(turned_image);
  }
  layer_.pads = std::move(image.pads);
  layer_.named = std::move(image.named);
  layer_.strokes.paths = std::move(image.strokes);
  for (const GerberAperture& aperture : layer_.apertures)
    layer_.strokes.layers.push_back(fmt::format("D{}", aperture.code));
  if (!ended_ && !findings_.any_error()) findings_.note("the file does not end with M02, so it may be truncated");
  if (!findings_.full() && !plotter_.is_full()) {
    if (std::optional<Region> dark = composed(std::move(image), plotter_.budget())) {
      layer_.dark = std::move(*dark);
    } else {
      findings_.refuse(0, 0, "gerber.too-large", "the lines of this layer cross too often to be merged", "fewer lines");
    }
  }
  layer_.is_negative = layer_.is_negative != old_codes_.is_negative();
  if (layer_.is_negative) findings_.note("the layer is a negative: the drawn areas are those without copper");
  layer_.strokes.notes = findings_.take_notes();
}

void GerberReader::read_plain() {
  if (words().starts_with("G04") || words().starts_with("G4 ") || words() == "G4") {
    attributes_.read_comment(words());
    return;
  }
  if (!read_words()) return;
  for (const GerberWord& word : line_) {
    if (ended_) return;
    obey(word);
  }
  const auto is_place = [](const GerberWord& word) { return word.letter == 'X' || word.letter == 'Y'; };
  const auto is_operation = [](const GerberWord& word) { return word.letter == 'O'; };
  if (std::ranges::any_of(line_, is_place) || std::ranges::any_of(line_, is_operation)) operate();
}

// Splits the command. D01 to D03 get the letter O, for operation, so that D is an aperture alone.
bool GerberReader::read_words() {
  line_.clear();
  const std::string_view all = words();
  for (std::size_t at = 0; at < all.size();) {
    const char letter = all[at];
    if (letter == ' ') {
      ++at;
      continue;
    }
    const std::size_t end = std::min(all.find_first_not_of("+-.0123456789", at + 1), all.size());
    const bool is_letter = std::string_view("NGDMXYIJ").find(letter) != std::string_view::npos;
    if (!is_letter || end == at + 1) {
      return findings_.refuse(at, 1, "gerber.unknown-command", "this is not a Gerber command",
                              "coordinates and a code, e.g. X100Y200D01*, or %...*%");
    }
    const std::string_view number = all.substr(at + 1, end - at - 1);
    const bool is_operation = letter == 'D' && (number == "1" || number == "01" || number == "2" || number == "02" ||
                                                number == "3" || number == "03");
    line_.push_back({is_operation ? 'O' : letter, number, at});
    at = end;
  }
  return !line_.empty();
}

std::optional<int> GerberReader::code_of(const GerberWord& word) {
  int value = 0;
  const char* const end = word.number.data() + word.number.size();
  const auto [stop, error] = std::from_chars(word.number.data(), end, value);
  if (error == std::errc() && stop == end && value >= 0) return value;
  findings_.refuse(word.at, word.number.size() + 1, "gerber.bad-number",
                   fmt::format("'{}' is not a code", word.number.substr(0, 60)), "digits only");
  return std::nullopt;
}

void GerberReader::obey(const GerberWord& word) {
  switch (word.letter) {
    case 'G': return obey_g(word);
    case 'D':
    case 'O': return obey_d(word);
    case 'M': {
      const std::optional<int> code = code_of(word);
      if (code && (*code == 0 || *code == 2 || *code == 30)) ended_ = true;
      return;
    }
    default: return;  // N counts lines; X, Y, I and J are for operate()
  }
}

void GerberReader::obey_g(const GerberWord& word) {
  const std::optional<int> code = code_of(word);
  if (!code) return;
  switch (*code) {
    case 0:
    case 1: plotter_.interpolation = Interpolation::linear; return;
    case 2: plotter_.interpolation = Interpolation::clockwise; return;
    case 3: plotter_.interpolation = Interpolation::counterclockwise; return;
    case 36: return plotter_.begin_region();
    case 37: return plotter_.end_region();
    case 54:  // a D code follows
    case 55: return;
    case 70:
    case 71: numbers_.is_inch = *code == 70; return;
    case 74: plotter_.quadrants = Quadrants::single; return;
    case 75: plotter_.quadrants = Quadrants::multi; return;
    case 90:
    case 91: numbers_.format.is_incremental = *code == 91; return;
    default:
      findings_.refuse(word.at, word.number.size() + 1, "gerber.unknown-command",
                       fmt::format("G{:02} is not supported", *code),
                       "G01 to G04, G36, G37, G54, G55, G70, G71, G74, G75, G90 or G91");
  }
}

void GerberReader::obey_d(const GerberWord& word) {
  const std::optional<int> code = code_of(word);
  if (!code) return;
  if (*code >= 10) {
    plotter_.select(static_cast<std::uint32_t>(*code));
  } else if (*code >= draw_code && *code <= flash_code) {
    operation_ = *code;
  } else if (*code != 0) {
    findings_.refuse(word.at, word.number.size() + 1, "gerber.unknown-command",
                     fmt::format("there is no D{:02}", *code), "D01, D02, D03, or an aperture from D10 on");
  }
}

bool GerberReader::read_place(DrawnPoint& place, ArcWords& arc) {
  if (!has_format_) {
    findings_.note("the file does not give its number format (FS); 2.4 digits are assumed");
    has_format_ = true;
  }
  Nanometres i;
  Nanometres j;
  Nanometres x = numbers_.format.is_incremental ? Nanometres{} : x_;
  Nanometres y = numbers_.format.is_incremental ? Nanometres{} : y_;
  for (const GerberWord& word : line_) {
    const bool is_across = word.letter == 'X' || word.letter == 'I';
    if (!is_across && word.letter != 'Y' && word.letter != 'J') continue;
    const std::optional<Nanometres> value = is_across ? numbers_.x(word.number) : numbers_.y(word.number);
    if (!value) {
      return findings_.refuse(word.at, word.number.size() + 1, "gerber.bad-number",
                              fmt::format("'{}' is not a coordinate", word.number.substr(0, 60)),
                              "a sign and digits, at most 100 m; check the unit and the format");
    }
    if (word.number.find('.') != std::string_view::npos) {
      findings_.note("numbers with a decimal point are read as written");
    }
    arc.has_any = arc.has_any || word.letter == 'I' || word.letter == 'J';
    (word.letter == 'X' ? x : word.letter == 'Y' ? y : word.letter == 'I' ? i : j) = *value;
  }
  if (numbers_.format.is_incremental) {
    x = x + x_;
    y = y + y_;
  }
  const auto is_far = [](Nanometres length) {
    return length < Nanometres{-farthest_drawn.count} || length > farthest_drawn;
  };
  if (is_far(x) || is_far(y)) {
    return findings_.refuse(0, 0, "drawing.too-far", "this position is over 100 m from zero",
                            "coordinates within 100 m; check the unit");
  }
  x_ = x;
  y_ = y;
  place = old_codes_.placed(x, y);
  const DrawnPoint zero = old_codes_.placed({}, {});
  const DrawnPoint centre = old_codes_.placed(i, j);
  arc.ij = {static_cast<double>((centre.x - zero.x).count), static_cast<double>((centre.y - zero.y).count)};
  return true;
}

void GerberReader::operate() {
  DrawnPoint place;
  ArcWords arc;
  if (!read_place(place, arc)) return;
  switch (operation_) {
    case draw_code: plotter_.net = attributes_.net(); return plotter_.draw_to(place, arc);
    case flash_code: return plotter_.flash(place, attributes_.net());
    case move_code: return plotter_.move_to(place);
    default:
      findings_.note("coordinates before the first D01, D02 or D03 are read as moves");
      return plotter_.move_to(place);
  }
}

void GerberReader::read_extended() {
  const std::string_view all = words();
  const std::string_view code = all.substr(0, 2);
  if (in_macro_) {
    in_macro_ = !findings_.command.is_last;
    return apertures_.add_statement();
  }
  if (code == "AM") {
    in_macro_ = !findings_.command.is_last;
    return apertures_.begin_macro();
  }
  if (code == "AD") return apertures_.define(attributes_.aperture_function());
  if (code == "FS") return read_format();
  if (code == "MO") return read_unit();
  if (code == "LP") return read_polarity();
  if (code == "LM" || code == "LR" || code == "LS") return read_transformation();
  if (code == "SR") return read_repeat();
  if (code == "AB") return read_block();
  if (code == "TF" || code == "TA" || code == "TO" || code == "TD") return attributes_.read(all);
  if (old_codes_.read()) return;
  const bool is_plain = !code.empty() && std::string_view("GDMXYN").find(code[0]) != std::string_view::npos &&
                        code.size() == 2 && (code[1] == '-' || (code[1] >= '0' && code[1] <= '9'));
  if (is_plain) return read_plain();
  // Of a second * within the % of a command, as in %ADD10C,.031*X.015%.
  const bool is_rest = code.size() == 2 && code[0] == 'X';
  if (is_rest) return findings_.note(fmt::format("'{}' after the end of a command is ignored", all.substr(0, 20)));
  findings_.refuse(0, 0, "gerber.unknown-command", fmt::format("'{}' is not supported", code),
                   "FS, MO, AD, AM, AB, LP, LM, LR, LS, SR, TF, TA, TO, TD or an old code");
}

void GerberReader::read_format() {
  const std::optional<GerberFormat> format = read_gerber_format(words().substr(2));
  if (!format) {
    findings_.refuse(0, 0, "gerber.bad-format", "this is not a number format", "e.g. FSLAX46Y46");
    return;
  }
  numbers_.format = *format;
  has_format_ = true;
}

void GerberReader::read_unit() {
  const std::string_view unit = trimmed(words().substr(2));
  if (unit != "IN" && unit != "MM") {
    findings_.refuse(0, 0, "gerber.bad-format", fmt::format("'{}' is not a unit", unit.substr(0, 60)), "MOMM or MOIN");
    return;
  }
  numbers_.is_inch = unit == "IN";
}

void GerberReader::read_polarity() {
  const std::string_view polarity = trimmed(words().substr(2));
  if (polarity != "D" && polarity != "C") {
    findings_.refuse(0, 0, "gerber.bad-mode", fmt::format("'{}' is not a polarity", polarity.substr(0, 60)),
                     "LPD, dark, or LPC, clear");
    return;
  }
  plotter_.set_dark(polarity == "D");
}

void GerberReader::read_transformation() {
  GerberPlacement modal = plotter_.modal();
  const std::string_view value = trimmed(words().substr(2));
  const std::optional<double> number = read_gerber_decimal(value);
  const char kind = words()[1];
  const bool is_mirror = kind == 'M' && (value == "N" || value == "X" || value == "Y" || value == "XY");
  const bool is_turn = kind == 'R' && number && std::abs(*number) <= 1e6;
  const bool is_scale = kind == 'S' && number && *number >= 1e-6 && *number <= 1e6;
  if (!is_mirror && !is_turn && !is_scale) {
    findings_.refuse(0, 0, "gerber.bad-mode",
                     fmt::format("'{}' is not an aperture transformation", value.substr(0, 60)),
                     "LMN, LMX, LMY, LMXY, LR and degrees, or LS and a factor above 0");
    return;
  }
  if (is_mirror) {
    modal.mirrors_x = value.starts_with('X');
    modal.mirrors_y = value.ends_with('Y');
  }
  if (is_turn) modal.radians = *number * std::numbers::pi / 180;
  if (is_scale) modal.scale = *number;
  plotter_.set_modal(modal);
}

// "SRX3Y2I5.0J4": columns, rows and how far they are apart. "SR" ends the block.
void GerberReader::read_repeat() {
  const std::string_view all = words();
  double counts[2] = {1, 1};
  Nanometres steps[2];
  for (std::size_t at = 2; at < all.size();) {
    const std::size_t end = std::min(all.find_first_of("XYIJ", at + 1), all.size());
    const std::string_view number = all.substr(at + 1, end - at - 1);
    const std::optional<double> value = read_gerber_decimal(number);
    const std::optional<Nanometres> length = numbers_.length(number);
    const bool counts_here = all[at] == 'X' || all[at] == 'Y';
    const bool is_wrong = std::string_view("XYIJ").find(all[at]) == std::string_view::npos || !value || !length ||
                          (counts_here && !(*value >= 0 && *value <= 1e6));
    if (is_wrong) {
      findings_.refuse(at, end - at, "gerber.bad-block", "this step and repeat is empty",
                       "e.g. SRX3Y2I5.0J4.0, or SR to end it");
      return;
    }
    const std::size_t axis = all[at] == 'X' || all[at] == 'I' ? 0 : 1;
    if (counts_here) counts[axis] = std::max(1.0, std::floor(*value));
    if (!counts_here) steps[axis] = *length;
    at = end;
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double reach = counts[axis] * std::abs(static_cast<double>(steps[axis].count));
    if (reach <= static_cast<double>(farthest_drawn.count)) continue;
    findings_.refuse(0, 0, "drawing.too-far", "the repeats extend over more than 100 m",
                     "coordinates within 100 m; check the unit");
    return;
  }
  plotter_.end_repeat();
  const auto across = static_cast<std::int64_t>(counts[0]);
  const auto up = static_cast<std::int64_t>(counts[1]);
  if (across * up > 1) plotter_.begin_repeat(across, up, {steps[0], steps[1]});
}

// "ABD12" begins a block, "AB" ends it.
void GerberReader::read_block() {
  const std::string_view name = trimmed(words().substr(2));
  if (name.empty()) return plotter_.end_block();
  const std::optional<double> code = name.front() == 'D' ? read_gerber_decimal(name.substr(1)) : std::nullopt;
  if (!code || !(*code >= 10 && *code <= 999'999'999)) {
    findings_.refuse(0, 0, "gerber.bad-block", "this does not name an aperture block", "e.g. ABD12, or AB to end it");
    return;
  }
  plotter_.begin_block(static_cast<std::uint32_t>(*code));
}

}  // namespace

GerberLayer read_gerber(const std::string& name, std::string_view text, Diagnostics& diagnostics,
                        std::size_t most_points) {
  return GerberReader(name, text, diagnostics, most_points).read();
}

bool looks_like_gerber(std::string_view text) {
  constexpr std::size_t looked_at = 65'536;
  text = text.substr(0, looked_at);
  constexpr std::array marks = {"%FS", "%AD", "%MO", "%AM", "%LP", "D02*", "D01*", "D03*", "D2*"};
  return std::ranges::any_of(marks, [text](const char* mark) { return text.find(mark) != std::string_view::npos; });
}

}  // namespace passo
