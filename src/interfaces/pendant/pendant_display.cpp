#include "passo/pendant/pendant_display.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

using Bytes = std::vector<std::uint8_t>;

// As the XHC pendants do: bits 0 and 1 are the mode, bit 7 marks machine coordinates.
constexpr std::uint8_t mode_continuous = 0;
constexpr std::uint8_t mode_step = 1;
constexpr std::uint8_t mode_machine_place = 0x80;
constexpr double fractions = 1e4;
constexpr unsigned sign_bit = 0x8000;
constexpr double largest_word = 0xFFFF;

void add_word(Bytes& bytes, unsigned word) {
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFF));
}

unsigned as_word(double value) {
  return std::isfinite(value) ? static_cast<unsigned>(std::clamp(std::round(std::abs(value)), 0.0, largest_word)) : 0;
}

// The whole part, then four digits of the fraction with the sign.
void add_place(Bytes& bytes, double value) {
  const double most = largest_word * fractions;
  const double rounded = std::isfinite(value) ? std::min(std::round(std::abs(value) * fractions), most) : 0;
  const auto whole = static_cast<unsigned>(rounded / fractions);
  const auto fraction = static_cast<unsigned>(rounded - whole * fractions);
  add_word(bytes, whole);
  add_word(bytes, fraction | (value < 0 && rounded > 0 ? sign_bit : 0U));
}

void add(Bytes& bytes, const PendantTable::DisplayField& field, const PendantView& view) {
  using Kind = PendantTable::DisplayField::Kind;
  const std::size_t group = view.axis ? index_of(*view.axis) / 3 * 3 : 0;
  switch (field.kind) {
    case Kind::literal: return bytes.push_back(field.literal);
    case Kind::mode:
      return bytes.push_back(static_cast<std::uint8_t>((view.is_continuous ? mode_continuous : mode_step) |
                                                       (view.is_machine_place ? mode_machine_place : 0)));
    case Kind::axis: return add_place(bytes, view.place.values[group + field.axis - 1]);
    case Kind::feed: return add_word(bytes, as_word(view.feed));
    case Kind::spindle: return add_word(bytes, as_word(view.spindle));
  }
}

}  // namespace

std::vector<Bytes> display_reports(const PendantTable& table, const PendantView& view) {
  std::vector<Bytes> reports;
  if (!table.display) return reports;
  Bytes bytes;
  for (const PendantTable::DisplayField& field : table.display->fields) add(bytes, field, view);
  const std::size_t in_each = table.display->length - 1;
  for (std::size_t at = 0; at < bytes.size(); at += in_each) {
    Bytes report{table.display->id};
    report.insert(report.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + in_each, bytes.size())));
    report.resize(table.display->length);
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace passo
