// The settings of each firmware: described, written one by one with read-back, saved, compared.
#include "passo/sender/firmware_settings.hpp"

#include "fake_pair.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Kind = FirmwareSetting::Kind;

struct SettingsPair : FakePair {
  explicit SettingsPair(test::FirmwareTraits traits) : FakePair(std::move(traits)) {}
  bool finish() {
    return play([&] { return !settings.busy(); }, [&] { settings.poll(); });
  }
  bool read() {
    if (!greet()) return false;
    settings.read();
    return finish();
  }
  SettingChange write(const char* name, const char* value) {
    settings.write(name, value);
    if (!finish()) return {.name = "not finished"};
    const auto changes = settings.take_changes();
    return changes.size() == 1 ? changes.front() : SettingChange{.name = "not one"};
  }
  FirmwareSettings settings{sender};
};

TEST(FirmwareSettings, of_grbl_are_described_by_the_table) {
  SettingsPair pair(test::grbl_mega_5x());
  ASSERT_TRUE(pair.read()) << pair.settings.trouble();
  EXPECT_EQ(pair.settings.all().size(), 22U + 4 * 5);
  const FirmwareSetting& rate = *pair.settings.find("113");
  EXPECT_EQ(rate.title, "Maximum rate of A");
  EXPECT_EQ(rate.unit, "deg/min");
  EXPECT_EQ(rate.value, "500.000");
  EXPECT_EQ(pair.settings.find("$100")->unit, "steps/mm");
  EXPECT_THAT(pair.settings.find("$3")->choices, ElementsAre("X", "Y", "Z", "A", "B"));
  EXPECT_EQ(pair.settings.find("$20")->kind, Kind::flag);
  EXPECT_EQ(pair.settings.find("$99"), nullptr);
  for (const FirmwareSetting& setting : pair.settings.all()) EXPECT_NE(setting.title, "") << setting.name;
  EXPECT_THAT(pair.board.lines(), Not(Contains(StartsWith("$E"))));
}

TEST(FirmwareSettings, of_grblhal_are_described_by_the_board) {
  SettingsPair pair(test::grblhal("XYZA"));
  ASSERT_TRUE(pair.read()) << pair.settings.trouble();
  const FirmwareSetting& blocks = *pair.settings.find("$398");
  EXPECT_EQ(blocks.title, "Planner buffer blocks");
  EXPECT_EQ(blocks.group, "General");
  EXPECT_EQ(blocks.meaning, "Number of blocks. NOTE: Restart the board.");
  EXPECT_EQ(blocks.least, 30);
  EXPECT_EQ(blocks.most, 1000);
  EXPECT_TRUE(blocks.needs_restart);
  EXPECT_EQ(pair.settings.find("$0")->least, 2) << "grblHAL's own range, not Grbl's";
  EXPECT_THAT(pair.settings.find("$10")->choices, ElementsAre("Position in machine coordinate", "", "Line numbers"));
  EXPECT_EQ(pair.settings.find("$341")->kind, Kind::choice);
  EXPECT_EQ(pair.settings.find("$74")->kind, Kind::password);
  EXPECT_THAT(pair.settings.find("$23")->choices, ElementsAre("X", "Y", "Z", "A"));
  // What it does not describe is in the table.
  EXPECT_EQ(pair.settings.find("$111")->title, "Maximum rate of Y");
  pair.settings.read();
  ASSERT_TRUE(pair.finish());
  EXPECT_EQ(std::ranges::count(pair.board.lines(), "$ES"), 1) << "asked once";
}

TEST(FirmwareSettings, are_written_one_by_one_and_read_back) {
  SettingsPair pair(test::grbl_mega());
  ASSERT_TRUE(pair.greet());
  pair.settings.write("$110", "600.5");
  pair.settings.write("24", "30");
  ASSERT_TRUE(pair.finish());
  const auto changes = pair.settings.take_changes();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].name, "$110");
  EXPECT_EQ(changes[0].before, "500.000");
  EXPECT_EQ(changes[0].after, "600.500");
  EXPECT_EQ(changes[0].trouble, "");
  EXPECT_EQ(changes[1].after, "30.000");
  EXPECT_EQ(pair.board.setting("110"), "600.500");
  EXPECT_EQ(pair.settings.find("110")->value, "600.500");
  EXPECT_EQ(pair.sender.machine().settings.at(110), 600.5);
  std::vector<std::string> sent;
  for (const std::string& line : pair.board.lines()) {
    if (line.starts_with("$1") || line.starts_with("$2") || line == "$$") sent.push_back(line);
  }
  EXPECT_THAT(sent, ElementsAre("$$", "$$", "$110=600.5", "$$", "$24=30", "$$"));
}

TEST(FirmwareSettings, a_bad_value_leaves_the_old_one_and_says_so) {
  SettingsPair pair(test::grbl_mega());
  ASSERT_TRUE(pair.read());
  for (const auto& [name, value, why] : std::vector<std::array<const char*, 3>>{
           {"$110", "-5", "$110=-5: $110 (Maximum rate of X) is at least 0.001 mm/min"},
           {"$0", "2", "$0=2: $0 (Step pulse) is 3 to 255 us"},
           {"$20", "2", "$20=2: $20 (Soft limits) is 0 to 1"},
           {"$2", "1.5", "$2=1.5: $2 (Step inversion) is a whole number"},
           {"$100", "abc", "$100=abc: $100 (Steps of X) is a number"},
           {"$100", "1\n$102=1", "$100=1\n$102=1: $100 (Steps of X) is a text of at most 200 characters"},
           {"$777", "1", "the board has no setting $777"}}) {
    const std::size_t lines = pair.board.lines().size();
    const SettingChange change = pair.write(name, value);
    EXPECT_EQ(change.trouble, why);
    EXPECT_EQ(pair.board.lines().size(), lines) << "nothing was sent";
  }
  EXPECT_EQ(pair.board.setting("110"), "500.000");

  // What the board itself rejects.
  pair.board.traits().store = [](const std::string&, std::string&) { return 10; };
  const SettingChange refused = pair.write("$20", "1");
  EXPECT_EQ(refused.trouble, "the board rejects $20=1: error:10, soft limits need homing");
  EXPECT_EQ(refused.after, "0");

  // A board that makes something else of it.
  pair.board.traits().store = [](const std::string&, std::string& value) {
    if (value == "100") value = "99";
    return 0;
  };
  const SettingChange changed = pair.write("$26", "100");
  EXPECT_EQ(changed.trouble, "the board did not take the value $26=100; $26 is 250 again");
  EXPECT_EQ(pair.board.setting("26"), "250");
  EXPECT_FALSE(pair.sender.fault());
  EXPECT_EQ(pair.write("$26", "101").trouble, "") << "it goes on";
}

TEST(FirmwareSettings, other_settings_that_change_with_one_are_told) {
  SettingsPair pair(test::grbl_mega());
  ASSERT_TRUE(pair.read());
  ASSERT_EQ(pair.write("$22", "1").trouble, "");
  ASSERT_EQ(pair.write("$20", "1").trouble, "");
  // Grbl disables soft limits together with homing.
  pair.board.traits().store = [&](const std::string& name, std::string&) {
    if (name == "22")
      std::ranges::find(pair.board.traits().settings, "20", [](const auto& one) { return one.first; })->second = "0";
    return 0;
  };
  const SettingChange change = pair.write("$22", "0");
  EXPECT_EQ(change.trouble, "");
  EXPECT_THAT(change.also, ElementsAre("$20: 1 -> 0"));
}

TEST(FirmwareSettings, of_fluidnc_are_in_its_yaml_file) {
  SettingsPair pair(test::fluidnc());
  ASSERT_TRUE(pair.read()) << pair.settings.trouble();
  EXPECT_TRUE(pair.settings.find("$110")->read_only);
  EXPECT_EQ(pair.write("$110", "600").trouble, "$110 is in the board's YAML file, and cannot be written by its number");
  EXPECT_EQ(pair.write("$10", "3").trouble, "");
  EXPECT_EQ(pair.board.setting("10"), "3");
}

TEST(FirmwareSettings, of_ucnc_are_saved_after_the_last_one) {
  SettingsPair pair(test::ucnc());
  ASSERT_TRUE(pair.greet());
  pair.settings.write("$110", "600");
  pair.settings.write("$111", "700");
  ASSERT_TRUE(pair.finish());
  EXPECT_EQ(pair.board.lines().back(), "$SS");
  EXPECT_EQ(std::ranges::count(pair.board.lines(), "$SS"), 1);
  EXPECT_EQ(pair.settings.take_changes().size(), 2U);
}

TEST(FirmwareSettings, a_password_is_written_and_not_compared) {
  SettingsPair pair(test::grblhal());
  ASSERT_TRUE(pair.read());
  EXPECT_EQ(pair.write("$74", "secret").trouble, "");
  const SettingChange hidden = pair.write("$74", "secret");
  EXPECT_EQ(hidden.wanted, "********");
  EXPECT_EQ(hidden.after, "********");
  EXPECT_EQ(pair.write("$398", "500").trouble, "");
  EXPECT_TRUE(pair.settings.needs_restart());
  EXPECT_EQ(pair.write("$398", "5").trouble, "$398=5: $398 (Planner buffer blocks) is 30 to 1000");
}

// A firmware that tells its passwords.
TEST(FirmwareSettings, passwords_are_never_shown) {
  test::FirmwareTraits traits = test::fluidnc();
  traits.settings.emplace_back("Sta/Password", "secret one");
  traits.settings.emplace_back("Sta/SSID", "workshop");
  traits.store = [](const std::string&, std::string& value) { return value == "too short" ? 80 : 0; };
  SettingsPair pair(traits);
  ASSERT_TRUE(pair.read());
  // FluidNC writes these by name.
  const FirmwareSetting& password = *pair.settings.find("$Sta/Password");
  EXPECT_EQ(password.kind, Kind::password);
  EXPECT_EQ(password.value, "********");
  EXPECT_EQ(pair.settings.find("$Sta/SSID")->value, "workshop");
  EXPECT_FALSE(password.read_only);
  const SettingChange change = pair.write("$Sta/Password", "secret two");
  EXPECT_EQ(change.trouble, "");
  EXPECT_EQ(pair.board.setting("Sta/Password"), "secret two");
  const SettingChange refused = pair.write("$Sta/Password", "too short");
  EXPECT_THAT(refused.trouble, HasSubstr("rejects $Sta/Password=********"));
  for (const SettingChange& one : {change, refused}) {
    for (const std::string& text : {one.before, one.wanted, one.after}) EXPECT_EQ(text, "********");
  }
  const std::string file = settings_text(pair.sender.machine(), pair.settings.all());
  EXPECT_THAT(file, HasSubstr("; passwords are not saved"));
  EXPECT_THAT(file, HasSubstr("$Sta/Password=********"));
  EXPECT_THAT(file, Not(HasSubstr("secret")));
  const auto read = parse_settings_text(file);
  ASSERT_TRUE(read);
  EXPECT_TRUE(differences(*read, pair.settings.all()).empty()) << "asterisks are not written back";
}

TEST(FirmwareSettings, an_alarm_ends_all_open_changes) {
  SettingsPair pair(test::grbl_mega());
  ASSERT_TRUE(pair.read());
  pair.settings.write("$110", "600");
  pair.settings.write("$111", "700");
  pair.sender.receive("ALARM:1\r\n", pair.now);
  pair.settings.poll();
  EXPECT_FALSE(pair.settings.busy());
  const auto changes = pair.settings.take_changes();
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_THAT(changes[0].trouble, HasSubstr("ALARM:1"));
  EXPECT_THAT(changes[1].trouble, HasSubstr("ALARM:1"));
}

TEST(SettingsFile, is_read_as_it_was_written) {
  SettingsPair pair(test::grblhal());
  ASSERT_TRUE(pair.read());
  const std::string text = settings_text(pair.sender.machine(), pair.settings.all());
  EXPECT_THAT(text, HasSubstr("[FIRMWARE:grblHAL]\n[AXS:3:XYZ]\n"));
  const auto read = parse_settings_text(text);
  ASSERT_TRUE(read) << read.error();
  EXPECT_EQ(read->size(), pair.settings.all().size());
  EXPECT_TRUE(differences(*read, pair.settings.all()).empty());

  ASSERT_EQ(pair.write("$111", "700").trouble, "");
  const auto found = differences(*read, pair.settings.all());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "$111");
  EXPECT_EQ(found[0].in_file, "500.000");
  EXPECT_EQ(found[0].on_board, "700.000");
}

TEST(SettingsFile, bad_ones_name_the_line) {
  const auto error = [](std::string_view text) {
    return parse_settings_text(text).has_value() ? "" : parse_settings_text(text).error();
  };
  EXPECT_EQ(error("$0=10\nG0 X1\n"), "line 2: expected a setting such as $110=500");
  EXPECT_EQ(error("; nothing\nok\n"), "expected at least one setting, such as $110=500");
  EXPECT_EQ(error("$=5\n"), "line 1: expected a setting such as $110=500");
  std::string many;
  for (int i = 0; i <= 2000; ++i) many += "$1=1\n";
  EXPECT_EQ(error(many), "line 2001: expected at most 2000 settings");
  const auto old = parse_settings_text("$$\r\n$110=500.000 (x max rate, mm/min)\r\nok\r\n");
  ASSERT_TRUE(old);
  EXPECT_EQ(old->front().value, "500.000");
  const auto missing = differences(*old, std::vector<FirmwareSetting>{{.name = "$5", .value = "1"}});
  ASSERT_EQ(missing.size(), 2U);
  EXPECT_EQ(missing[0].on_board, "");
  EXPECT_EQ(missing[1].in_file, "");
}

TEST(FirmwareSettings, broken_descriptions_describe_nothing) {
  SettingDescriptions descriptions;
  for (const char* line : {"[SETTING:]", "[SETTING:1", "[SETTING:5|x]", "[SETTINGGROUP:]", "[SETTING:6||||99|||||]",
                           "5\t", "7\ta\tb", "", "[", "[SETTING:8|1|Name|mm|6||nan|inf|1|]"}) {
    descriptions.hear(line);
  }
  FirmwareSetting setting{.name = "$8", .value = "4"};
  ASSERT_TRUE(descriptions.describe(setting, "XYZ"));
  EXPECT_EQ(setting.value, "4");
  EXPECT_EQ(setting.least, std::nullopt);
  FirmwareSetting none{.name = "$99", .value = "1"};
  EXPECT_FALSE(descriptions.describe(none, "XYZ"));
}

}  // namespace
}  // namespace passo
