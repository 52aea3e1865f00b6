// Job files are edited in their text: what is edited changes, and all else stays byte for byte.
#include <algorithm>
#include <functional>
#include <random>
#include <sstream>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/part_job/part_job.hpp"
#include "passo/part_job/part_kinds.hpp"
#include "passo/toml/toml_text.hpp"

namespace passo {
namespace {

using Edit = std::function<Status<TomlTextError>(TomlText&)>;

std::string edited(const std::string& text, const Edit& edit) {
  auto toml = TomlText::read(text);
  EXPECT_TRUE(toml) << text;
  if (!toml) return "";
  const auto done = edit(*toml);
  return done ? toml->text() : "refused: " + done.error().message;
}
Edit move(std::size_t from, std::size_t to) {
  return [=](TomlText& toml) { return toml.move_table("operation", from, to); };
}
Edit copy(std::size_t number) {
  return [=](TomlText& toml) { return toml.copy_table("operation", number); };
}
Edit removal(std::size_t number) {
  return [=](TomlText& toml) { return toml.remove_table("operation", number); };
}
Edit words(const std::string& path, const std::string& value) {
  return [=](TomlText& toml) { return toml.set_words(path, value); };
}
Edit without(const std::string& path) {
  return [=](TomlText& toml) { return toml.remove(path); };
}

// The lines with content, sorted: a move keeps them all.
std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  }
  std::ranges::sort(lines);
  return lines;
}

constexpr const char* awkward = R"(# A job.
[job]   # the head
drawing = "plate.svg"
mine = { unknown = 1, list = [1,2] }

# Above the first.
# Two lines.
[[operation]] # pocket
kind = "pocket"
tab = [  # over lines
  [10, 0], # one
  # [20, 0],
  [40, 0],
]
  depth   =  -3   # aligned
[operation.notes]
by = "me" # "quoted" # twice
# Below the first.

# Between blank lines.

  [[ "operation" ]]
kind = 'drill'
extra.dotted = 2
extra.more = 3

[[stamp]]
x = 1
[[operation]]
kind = "profile"
layer = ["a#b", "c"] # both
)";

TEST(PartJobText, sets_keys_of_operations) {
  const std::string text(awkward);
  const auto line_of = [](std::string all, const std::string& was, const std::string& is) {
    all.replace(all.find(was), was.size(), is);
    return all;
  };
  EXPECT_EQ(edited(text, words("operation.1.depth", "-4.25")), line_of(text, "-3   # aligned", "-4.25 # aligned"));
  EXPECT_EQ(edited(text, words("operation.2.depth", "-1")),
            line_of(text, "extra.more = 3\n", "extra.more = 3\ndepth = -1\n"));
  EXPECT_EQ(edited(text, words("operation.2.extra.dotted", "\"x\"")), line_of(text, "dotted = 2", "dotted = \"x\""));
  EXPECT_EQ(edited(text, words("operation.3.layer", "\"c\"")),
            line_of(text, "[\"a#b\", \"c\"] # both", "\"c\"          # both"));
  EXPECT_EQ(edited(text, words("operation.1.notes.by", "\"you\"")), line_of(text, "\"me\" #", "\"you\" #"));
  EXPECT_EQ(edited(text, words("operation.1.step", "1")),
            line_of(text, "-3   # aligned\n", "-3   # aligned\n  step = 1\n"));
  EXPECT_EQ(edited("[[operation]]\r\nkind = \"drill\"", words("operation.1.tool", "2")),
            "[[operation]]\r\nkind = \"drill\"\r\ntool = 2\r\n");
  EXPECT_EQ(edited("[[operation]]\n[tool]\n", words("operation.1.tool", "2")), "[[operation]]\ntool = 2\n[tool]\n");
  EXPECT_EQ(edited("operation = [ {kind = \"face\"}, {} ] # all\n", words("operation.1.tool", "2")),
            "operation = [ {kind = \"face\", tool = 2}, {} ] # all\n");
}

TEST(PartJobText, refuses_values_and_paths_that_are_none) {
  const std::string text(awkward);
  for (const char* const value : {"", "1\ny = 2", "1 # no", "{", "1, 2", "nan nan"}) {
    EXPECT_TRUE(edited(text, words("operation.1.depth", value)).starts_with("refused: ")) << value;
  }
  for (const char* const path :
       {"operation", "operation.1", "operation.0.depth", "operation.4.depth", "operation.x.depth", "operation.1.kind.a",
        "operation.99999999999999999999.depth", "operation.1.notes", "operation.1.a b", "job.drawing.x", ""}) {
    EXPECT_TRUE(edited(text, words(path, "1")).starts_with("refused: ")) << path;
  }
  EXPECT_TRUE(edited(text, words("operation.1.tab", "[1, 2]")).find("comments inside") != std::string::npos);
}

TEST(PartJobText, removes_keys) {
  EXPECT_EQ(edited("[[operation]]\na = 1 # one\nb = 2\n", without("operation.1.a")), "[[operation]]\nb = 2\n");
  EXPECT_EQ(edited("[[operation]]\na = [\n 1, # x\n 2]\nb = 2\n", without("operation.1.a")), "[[operation]]\nb = 2\n");
  EXPECT_EQ(edited("[job]\na = { b = 1, c = \",\", d = 3 }\n", without("job.a.b")),
            "[job]\na = { c = \",\", d = 3 }\n");
  EXPECT_EQ(edited("[job]\na = { b = 1, c = 2 }\n", without("job.a.c")), "[job]\na = { b = 1 }\n");
  EXPECT_EQ(edited("[job]\na = { b = 1 }\n", without("job.a.b")), "[job]\na = { }\n");
  EXPECT_EQ(edited("[job]\nb.c = 1\nd = 2\n", without("job.b.c")), "[job]\nd = 2\n");
  for (const char* const path : {"job.other", "operation.9.depth", "operation.2.other"}) {
    EXPECT_EQ(edited(awkward, without(path)), awkward) << path;
  }
  for (const char* const path : {"job", "operation", "operation.1.notes", "stamp"}) {
    EXPECT_TRUE(edited(awkward, without(path)).starts_with("refused: ")) << path;
  }
}

TEST(PartJobText, moves_an_operation_with_its_comments) {
  const std::string text = "[job]\nx = 1\n\n# A\n[[operation]]\nn = 1 # one\n\n# float\n\n[[operation]]\nn = 2\n# end";
  EXPECT_EQ(edited(text, move(1, 2)),
            "[job]\nx = 1\n\n# float\n\n[[operation]]\nn = 2\n# end\n\n# A\n[[operation]]\nn = 1 # one\n");
  EXPECT_EQ(edited(text, move(2, 1)),
            "[job]\nx = 1\n\n[[operation]]\nn = 2\n# end\n\n# A\n[[operation]]\nn = 1 # one\n\n# float\n");
  EXPECT_EQ(edited(text, move(1, 1)), text);
  EXPECT_TRUE(edited(text, move(1, 3)).starts_with("refused: "));
  EXPECT_TRUE(edited(text, move(0, 1)).starts_with("refused: "));
  const std::string dos = "[[operation]]\r\nn = 1\r\n\r\n[[operation]]\r\nn = 2\r\n";
  EXPECT_EQ(edited(dos, move(2, 1)), "[[operation]]\r\nn = 2\r\n\r\n[[operation]]\r\nn = 1\r\n");
}

TEST(PartJobText, keeps_every_line_of_an_awkward_file_when_operations_move) {
  for (std::size_t from = 1; from <= 3; ++from) {
    for (std::size_t to = 1; to <= 3; ++to) {
      const std::string moved = edited(awkward, move(from, to));
      EXPECT_EQ(lines_of(moved), lines_of(awkward)) << from << " to " << to << "\n" << moved;
    }
  }
}

TEST(PartJobText, copies_inserts_and_removes_operations) {
  const std::string text = "# A\n[[operation]]\nn = 1\n[operation.sub]\nm = 2\n\n# B\n[[operation]]\nn = 2\n";
  EXPECT_EQ(edited(text, copy(1)),
            "# A\n[[operation]]\nn = 1\n[operation.sub]\nm = 2\n\n[[operation]]\nn = 1\n[operation.sub]\nm = 2\n\n"
            "# B\n[[operation]]\nn = 2\n");
  EXPECT_EQ(edited(text, removal(1)), "# B\n[[operation]]\nn = 2\n");
  EXPECT_EQ(edited(text, removal(2)), "# A\n[[operation]]\nn = 1\n[operation.sub]\nm = 2\n");
  EXPECT_EQ(edited("[job]\n",
                   [](TomlText& toml) {
                     return toml.insert_table("operation", 1, {{"n", "1"}});
                   }),
            "[job]\n\n[[operation]]\nn = 1\n");
  const auto insert = [&](std::size_t number) {
    return edited(text, [=](TomlText& toml) { return toml.insert_table("operation", number, {{"n", "3"}}); });
  };
  EXPECT_EQ(insert(2),
            "# A\n[[operation]]\nn = 1\n[operation.sub]\nm = 2\n\n[[operation]]\nn = 3\n\n# B\n[[operation]]\nn = 2\n");
  EXPECT_EQ(insert(3), text + "\n[[operation]]\nn = 3\n");
  EXPECT_TRUE(insert(4).starts_with("refused: "));
  const std::string in_line = "operation = [ {n = 1}, {n = 2} ]\n";
  EXPECT_EQ(edited(in_line, move(1, 2)), "refused: the tables of operation have no heads [[operation]]");
}

TEST(PartJobText, removes_a_table_with_the_tables_below_it) {
  const auto without_table = [](const std::string& text, const std::string& path) {
    return edited(text, [&](TomlText& toml) { return toml.remove_table(path); });
  };
  const std::string text =
      "[job]\nx = 1\n\n# A drill.\n[tool.3] # \"[tool.4]\"\nshape = \"drill\"\n\n[tool.3.chip_load_mm]\nmdf = 0.1\n# "
      "end\n\n"
      "# The next.\n[ tool . \"30\" ]\nshape = \"flat\"\n\n# float\n\n[[operation]]\ntool = 3\n[tool.3.more]\ny = 2\n";
  EXPECT_EQ(without_table(text, "tool.3"),
            "[job]\nx = 1\n\n# The next.\n[ tool . \"30\" ]\nshape = \"flat\"\n\n# float\n\n[[operation]]\ntool = 3\n");
  EXPECT_EQ(without_table(text, "tool.3.more"), text.substr(0, text.find("[tool.3.more]")));
  EXPECT_EQ(without_table("[tool.1]\r\na = 1\r\n", "tool.1"), "");
  EXPECT_EQ(without_table("[tool]\n1 = { a = 1 }\n2 = { a = 2 }\n", "tool.1"), "[tool]\n2 = { a = 2 }\n");
  EXPECT_EQ(without_table("[tool]\n1.a = 1\n", "tool.1"), "refused: tool.1 is a table");
  EXPECT_EQ(without_table(text, "tool.4"), "refused: there is no tool.4");
  EXPECT_EQ(without_table(text, "job.x"), "refused: job.x is no table");
  EXPECT_EQ(without_table(text, "operation"), "refused: operation is no table");
  EXPECT_EQ(without_table(text, "operation.1"), "refused: there is no operation.1");
  EXPECT_EQ(without_table(text, ""), "refused: there is no ");
  // A head inside of a value is none.
  const std::string quoted = "[tool.1]\na = [\n[1],\n]\nb = \"\"\"\n[tool.2]\n\"\"\"\n[tool.2]\nc = 1\n";
  EXPECT_EQ(without_table(quoted, "tool.2").starts_with("refused") ||
                without_table(quoted, "tool.2") == quoted.substr(0, quoted.rfind("[tool.2]")),
            true);
}

// Any file that is built from awkward pieces: after each edit the reader finds the change, and all other lines are
// there.
TEST(PartJobText, survives_random_edits) {
  const std::vector<std::string> pieces = {"# comment\n",
                                           "\n",
                                           "[[operation]]\nkind = \"drill\"\n",
                                           "[[operation]] # [[operation]]\n  tab = [\n  [1, 2],\n # x\n]\n",
                                           "[[ operation ]]\na.b = 1\na.c = '[x]' # y\n",
                                           "[other{}]\nz = \"[[operation]]\"\n",
                                           "  # indented\n",
                                           "[[operation]]\n",
                                           "[[list]]\nq = [[1], [2]]\n"};
  std::mt19937_64 random(test::seed());
  const auto below = [&](std::size_t most) { return static_cast<std::size_t>(random() % most); };
  for (int trial = 0; trial < 300; ++trial) {
    std::string text;
    for (int i = 0; i < 12; ++i) {
      std::string piece = pieces[below(pieces.size())];
      if (const auto at = piece.find("{}"); at != std::string::npos) piece.replace(at, 2, std::to_string(i));
      text += piece;
    }
    if (trial % 3 == 0) {
      for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
    }
    const std::size_t count = [&] {
      std::size_t all = 0;
      std::istringstream stream(text);
      for (std::string line; std::getline(stream, line);)
        all += line.starts_with("[[") && line.find("oper") < 4 ? 1U : 0U;
      return all;
    }();
    if (count == 0) continue;
    const std::size_t from = 1 + below(count);
    const std::size_t to = 1 + below(count);
    const std::string moved = edited(text, move(from, to));
    EXPECT_EQ(lines_of(moved), lines_of(text)) << text << "\n---" << from << " to " << to << "\n" << moved;
    EXPECT_EQ(edited(moved, move(to, from)).starts_with("refused"), false);
    const std::string set = edited(text, words("operation." + std::to_string(from) + ".depth", "-1"));
    EXPECT_EQ(edited(set, without("operation." + std::to_string(from) + ".depth")),
              text.ends_with('\n') ? text : text + "\n");
  }
}

TEST(PartKinds, have_the_options_that_the_reader_takes) {
  for (const PartKindKeys& keys : keys_of_part_kinds()) {
    EXPECT_FALSE(keys.options.empty());
    const bool draws = keys.kind != PartKind::relief;
    EXPECT_EQ(std::ranges::count(keys.options, "layer"), draws ? 1 : 0) << name_of(keys.kind);
    for (const char* const of_command : {"output", "nest", "most-sheets"}) {
      EXPECT_EQ(std::ranges::count(keys.options, of_command), 0) << of_command;
    }
  }
}

}  // namespace
}  // namespace passo
