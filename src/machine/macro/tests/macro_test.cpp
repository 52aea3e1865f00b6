#include "passo/macro/macro.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::string face = R"(; title = "Face the stock"
; key = "F6"
; [value.width]
; title = "Width"
; unit = "mm"
; least = 1
; most = 400
; default = 100
; [value.passes]
; least = 1
; most = 9
; whole = true
G21 G91 G1 X#<width> F1000
)";

std::optional<Macro> macro_of(const std::string& text, std::string* codes = nullptr) {
  Diagnostics diagnostics;
  auto macro = parse_macro(text, "face", "face.ngc", diagnostics);
  for (const Diagnostic& one : diagnostics.all()) {
    if (codes != nullptr) *codes += one.code + " ";
  }
  EXPECT_EQ(macro.has_value(), !diagnostics.any_error()) << render(diagnostics, false);
  return macro;
}

std::string codes_of(const std::string& text) {
  std::string codes;
  macro_of(text, &codes);
  return codes;
}

TEST(Macro, has_a_title_a_key_and_values_with_ranges) {
  const auto macro = macro_of(face);
  ASSERT_TRUE(macro);
  EXPECT_EQ(macro->name, "face");
  EXPECT_EQ(macro->title, "Face the stock");
  EXPECT_EQ(macro->key, "F6");
  ASSERT_EQ(macro->values.size(), 2U);
  EXPECT_EQ(macro->values[0].title, "Width");
  EXPECT_EQ(macro->values[0].unit, "mm");
  EXPECT_EQ(macro->values[0].usual, 100);
  EXPECT_EQ(macro->values[1].title, "passes") << "its name";
  EXPECT_TRUE(macro->values[1].is_whole);
  EXPECT_FALSE(macro->values[1].usual);
}

TEST(Macro, becomes_a_program_with_its_values_and_its_line_numbers) {
  const auto text = macro_program(*macro_of(face), {{"passes", 3}});
  ASSERT_TRUE(text) << text.error().text;
  EXPECT_TRUE(text->starts_with("%\n#<width> = 100.000000\n#<passes> = 3.000000\n"));
  EXPECT_TRUE(text->ends_with("\nG21 G91 G1 X#<width> F1000\n%\n"));
  const auto line_of = [](const std::string& all) {
    return std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.find("G21")), '\n');
  };
  EXPECT_EQ(line_of(*text), line_of(face));
}

TEST(Macro, does_not_run_without_its_values) {
  const auto code = [](const MacroValues& values) {
    const auto text = macro_program(*macro_of(face), values);
    return text ? std::string() : text.error().code;
  };
  EXPECT_EQ(code({{"passes", 1}}), "");
  EXPECT_EQ(code({}), "macro.missing-value");
  EXPECT_EQ(code({{"passes", 0}}), "macro.wrong-value");
  EXPECT_EQ(code({{"passes", std::nan("")}}), "macro.wrong-value");
  EXPECT_EQ(code({{"passes", 1.5}}), "macro.whole-value");
  EXPECT_EQ(code({{"passes", 1}, {"width", 401}}), "macro.wrong-value");
  EXPECT_EQ(code({{"passes", 1}, {"depth", 1}}), "macro.unknown-value");
}

TEST(Macro, tells_what_is_wrong_with_its_head) {
  EXPECT_EQ(codes_of("; title = \"a\"\nG0 X1\n"), "");
  EXPECT_EQ(codes_of("; title = 5\n"), "macro.wrong-type ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; key = \"Enter\"\n"), "macro.key ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; input = \"cycle_start\"\n"), "");
  EXPECT_EQ(codes_of("; title = \"a\"\n; input = \"limit 3\"\n"), "macro.input ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; colour = 1\n"), "macro.unknown-key ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; [value.A]\n; least = 0\n; most = 1\n"), "macro.value-name ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; [value.a]\n; least = 0\n"), "macro.missing-key ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; [value.a]\n; least = 2\n; most = 1\n"), "macro.range ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; [value.a]\n; least = 0\n; most = 1\n; default = 2\n"), "macro.range ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; [value.a]\n; least = 0\n; most = 1\n; unit = \"mile\"\n"), "macro.unit ");
  EXPECT_EQ(codes_of("; title = \"a\"\n%\nG0 X1\n"), "macro.percent ");
  EXPECT_EQ(codes_of("; title = \"a\"\n; value = {a={least=0,most=1},b={least=0,most=1}}\n"), "macro.short-head ");
  EXPECT_THAT(codes_of("; title = \"a\n"), testing::StartsWith("macro.")) << "no TOML";
}

TEST(MacroFolder, has_the_macros_in_order_and_what_is_wrong_with_the_others) {
  const std::filesystem::path folder = test::scratch_folder();
  std::ofstream(folder / "b.ngc") << face;
  std::ofstream(folder / "a.ngc") << "; title = \"A\"\nG4 P0\n";
  std::ofstream(folder / "wrong.ngc") << "; title = \"\n";
  std::ofstream(folder / "m120.ngc") << "; Not a macro: a subroutine\no<m120> sub\no<m120> endsub\n";
  std::ofstream(folder / "notes.txt") << face;
  const MacroFolder all = read_macro_folder(folder.string());
  ASSERT_EQ(all.macros.size(), 2U);
  EXPECT_EQ(all.macros[0].name, "a");
  EXPECT_EQ(all.macros[1].name, "b");
  ASSERT_FALSE(all.findings.all().empty());
  EXPECT_EQ(all.findings.all()[0].file, "wrong.ngc");
  EXPECT_TRUE(read_macro_folder((folder / "none").string()).macros.empty());
}

}  // namespace
}  // namespace passo
