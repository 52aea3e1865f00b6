// The only file that uses fontconfig.
#include "passo/cam/font_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>

#include "passo/base/trimmed.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

struct FontconfigEnd {
  void operator()(FcConfig* config) const { FcConfigDestroy(config); }
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
  void operator()(FcObjectSet* objects) const { FcObjectSetDestroy(objects); }
  void operator()(FcFontSet* fonts) const { FcFontSetDestroy(fonts); }
};
template <class T>
using Fontconfig = std::unique_ptr<T, FontconfigEnd>;

const FcChar8* fc_text(const char* text) {
  return reinterpret_cast<const FcChar8*>(text);
}

// The name in lower case and without spaces, for comparisons.
std::string folded(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c != ' ') text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

struct InstalledFont {
  std::vector<std::string> families;
  std::vector<std::string> styles;
  std::string path;
  int face = 0;
  int weight = FC_WEIGHT_REGULAR;
  int slant = FC_SLANT_ROMAN;
  int width = FC_WIDTH_NORMAL;
};

// The requested properties. Empty: any.
struct FontStyle {
  std::string name;  // after "style="
  std::optional<int> weight;
  std::optional<int> slant;
  std::optional<int> width;
};

std::vector<std::string> texts_of(const FcPattern* font, const char* object) {
  std::vector<std::string> all;
  FcChar8* text = nullptr;
  for (int i = 0; FcPatternGetString(font, object, i, &text) == FcResultMatch; ++i) {
    all.emplace_back(reinterpret_cast<const char*>(text));
  }
  return all;
}

int number_of(const FcPattern* font, const char* object, int otherwise) {
  int value = otherwise;
  return FcPatternGetInteger(font, object, 0, &value) == FcResultMatch ? value : otherwise;
}

std::vector<InstalledFont> installed_fonts(FcConfig* config) {
  const Fontconfig<FcPattern> pattern(FcPatternCreate());
  FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
  FcPatternAddBool(pattern.get(), FC_VARIABLE, FcFalse);  // of variable fonts, their instances
  const Fontconfig<FcObjectSet> objects(FcObjectSetBuild(FC_FAMILY, FC_STYLE, FC_FILE, FC_INDEX, FC_WEIGHT, FC_SLANT,
                                                         FC_WIDTH, FC_FONTFORMAT, static_cast<char*>(nullptr)));
  const Fontconfig<FcFontSet> fonts(FcFontList(config, pattern.get(), objects.get()));
  std::vector<InstalledFont> all;
  for (int i = 0; fonts && i < fonts->nfont; ++i) {
    const FcPattern* const font = fonts->fonts[i];
    const std::vector<std::string> formats = texts_of(font, FC_FONTFORMAT);
    const std::vector<std::string> files = texts_of(font, FC_FILE);
    const bool has_outlines = !formats.empty() && (formats[0] == "TrueType" || formats[0] == "CFF");
    if (!has_outlines || files.empty()) continue;
    all.push_back({texts_of(font, FC_FAMILY), texts_of(font, FC_STYLE), files[0], number_of(font, FC_INDEX, 0),
                   number_of(font, FC_WEIGHT, FC_WEIGHT_REGULAR), number_of(font, FC_SLANT, FC_SLANT_ROMAN),
                   number_of(font, FC_WIDTH, FC_WIDTH_NORMAL)});
  }
  // Fontconfig lists fonts in the order of the folders.
  std::ranges::sort(all, [](const InstalledFont& a, const InstalledFont& b) {
    return std::tie(a.path, a.face) < std::tie(b.path, b.face);
  });
  return all;
}

bool has_name(const std::vector<std::string>& names, const std::string& wanted) {
  return std::ranges::any_of(names, [&](const std::string& name) { return folded(name) == wanted; });
}

// Reads the words after the family. Returns the first unknown one; empty: all are known.
std::string read_style(std::string_view words, FontStyle& style) {
  while (!words.empty()) {
    const std::string word(trimmed(words.substr(0, words.find(':'))));
    words.remove_prefix(
        std::min(words.size(), words.find(':') == std::string_view::npos ? words.size() : words.find(':') + 1));
    constexpr std::string_view named = "style=";
    const std::string small = folded(word);
    if (small.starts_with(named)) {
      style.name = small.substr(named.size());
      continue;
    }
    const FcConstant* const constant = FcNameGetConstant(fc_text(small.c_str()));
    const std::string_view object = constant == nullptr ? "" : constant->object;
    if (object == FC_WEIGHT) {
      style.weight = constant->value;
    } else if (object == FC_SLANT) {
      style.slant = constant->value;
    } else if (object == FC_WIDTH) {
      style.width = constant->value;
    } else if (!word.empty()) {
      return word;
    }
  }
  return "";
}

// The difference between the font and the request. Empty: the font does not match at all.
std::optional<int> distance_of(const InstalledFont& font, const FontStyle& style) {
  if (!style.name.empty() && !has_name(font.styles, style.name)) return std::nullopt;
  constexpr int near_weight = 20;  // semibold for bold
  constexpr int near_width = 12;
  const int weight = std::abs(font.weight - style.weight.value_or(FC_WEIGHT_REGULAR));
  const int width = std::abs(font.width - style.width.value_or(FC_WIDTH_NORMAL));
  const bool leans = font.slant != FC_SLANT_ROMAN;  // italic and oblique are alike
  const bool shall_lean = style.slant.value_or(FC_SLANT_ROMAN) != FC_SLANT_ROMAN;
  if (style.weight && weight > near_weight) return std::nullopt;
  if (style.width && width > near_width) return std::nullopt;
  if (style.slant && leans != shall_lean) return std::nullopt;
  constexpr int of_lean = 1000;
  return weight + width + (leans != shall_lean ? of_lean : std::abs(font.slant - style.slant.value_or(font.slant)));
}

// The number of letters to change, add or drop (Levenshtein).
std::size_t changes_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t before = std::exchange(row[0], i);
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t other = before + (a[i - 1] == b[k - 1] ? 0 : 1);
      before = row[k];
      row[k] = std::min({row[k] + 1, row[k - 1] + 1, other});
    }
  }
  return row[b.size()];
}

// "Lato, Lora or Noto Sans": the families whose names are the most similar.
std::string similar_families(const std::string& wanted, const std::vector<InstalledFont>& fonts) {
  std::set<std::tuple<std::size_t, std::string>> ranked;
  for (const InstalledFont& font : fonts) {
    for (const std::string& family : font.families) {
      const std::string name = folded(family);
      const bool is_part = name.find(wanted) != std::string::npos || wanted.find(name) != std::string::npos;
      ranked.emplace(is_part ? 1 : changes_between(wanted, name), family);
    }
  }
  constexpr std::size_t most_named = 4;
  std::string names;
  for (const auto& [distance, family] : ranked) {
    static_cast<void>(distance);
    if (std::ranges::count(names, ',') + 1 >= static_cast<std::ptrdiff_t>(most_named) && !names.empty()) break;
    names += (names.empty() ? "" : ", ") + family;
  }
  return names;
}

// The system's family for a generic name; empty: the name is not generic.
std::string generic_family(const std::string& wanted, FcConfig* config) {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> generic = {{{"sans", "sans-serif"},
                                                                                {"sans-serif", "sans-serif"},
                                                                                {"serif", "serif"},
                                                                                {"mono", "monospace"},
                                                                                {"monospace", "monospace"},
                                                                                {"cursive", "cursive"}}};
  const auto found = std::ranges::find(generic, wanted, &std::pair<std::string_view, const char*>::first);
  if (found == generic.end()) return "";
  const Fontconfig<FcPattern> pattern(FcPatternCreate());
  FcPatternAddString(pattern.get(), FC_FAMILY, fc_text(found->second));
  FcPatternAddBool(pattern.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(config, pattern.get(), FcMatchPattern);
  FcDefaultSubstitute(pattern.get());
  FcResult result = FcResultNoMatch;
  const Fontconfig<FcPattern> font(FcFontMatch(config, pattern.get(), &result));
  const std::vector<std::string> families = font ? texts_of(font.get(), FC_FAMILY) : std::vector<std::string>();
  return families.empty() ? "" : folded(families.front());
}

}  // namespace

bool names_font_file(const std::string& text) {
  constexpr std::string_view endings[] = {".ttf", ".otf", ".ttc", ".otc", ".lff", ".jhf", ".pfb", ".woff", ".woff2"};
  const std::string small = folded(text);
  return text.find('/') != std::string::npos ||
         std::ranges::any_of(endings, [&](std::string_view ending) { return small.ends_with(ending); });
}

std::optional<FontFile> find_font(const std::string& wanted, Diagnostics& diagnostics) {
  const auto refuse = [&](const char* code, std::string message, std::string expected) {
    diagnostics.add(of_file(code, wanted, std::move(message), std::move(expected)));
    return std::nullopt;
  };
  const std::string_view asked(wanted);
  const std::string_view family_name = trimmed(asked.substr(0, asked.find(':')));
  FontStyle style;
  const Fontconfig<FcConfig> config(FcInitLoadConfigAndFonts());
  if (!config) return refuse("engrave.no-family", "the installed fonts cannot be listed", "the file of a font");
  const std::string wrong =
      read_style(family_name.size() == asked.size() ? "" : asked.substr(asked.find(':') + 1), style);
  if (!wrong.empty()) {
    return refuse("engrave.no-style", fmt::format("'{}' is not a style", wrong),
                  "words such as bold, italic, light or condensed, or style=NAME");
  }
  const std::vector<InstalledFont> fonts = installed_fonts(config.get());
  std::string family = folded(family_name);
  const auto is_of_family = [&](const InstalledFont& font) { return has_name(font.families, family); };
  if (std::ranges::none_of(fonts, is_of_family)) {
    const std::string generic = generic_family(family, config.get());
    if (generic.empty() || family_name.empty()) {
      const std::string similar = similar_families(family, fonts);
      return refuse("engrave.no-family", fmt::format("no installed font has the family '{}'", family_name),
                    similar.empty() ? "the file of a font: no font is installed" : "a family such as " + similar);
    }
    family = generic;
  }
  const InstalledFont* best = nullptr;
  int least = 0;
  std::set<std::string> styles;
  for (const InstalledFont& font : fonts) {
    if (!is_of_family(font)) continue;
    if (!font.styles.empty()) styles.insert(font.styles.front());
    const std::optional<int> distance = distance_of(font, style);
    if (!distance || (best != nullptr && *distance >= least)) continue;
    best = &font;
    least = *distance;
  }
  if (best == nullptr) {
    return refuse("engrave.no-style", "the family has no such style",
                  fmt::format("style= and one of {}", fmt::join(styles, ", ")));
  }
  const std::string own_style = best->styles.empty() ? "" : " " + best->styles.front();
  return FontFile{best->path, best->families.front() + own_style, best->face};
}

}  // namespace passo
