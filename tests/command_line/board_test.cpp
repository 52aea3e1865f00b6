// passo board: what it says of boards, against the virtual one in the network, and what it would have avrdude do.
#include "kit/served_board.hpp"
#include "kit/system_files.hpp"
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;

class Boards : public passo::test::ServedBoard {
 protected:
  // An avrdude that notes how it was called, and writes the backup. `code`: how reading ends, `write_code`: writing.
  std::string fake_avrdude(int code = 0, int write_code = 0) const {
    std::filesystem::create_directories(path("bin"));
    const std::string file =
        write("bin/avrdude", "#!/bin/sh\necho \"$@\" >> " + path("calls") +
                                 "\nfor last; do :; done\ncase $last in flash:r:*) : > " + path("old.hex") + "; exit " +
                                 std::to_string(code) + ";; esac\nexit " + std::to_string(write_code) + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return "PATH=" + path("bin") + ":$PATH";
  }
  std::string image() const { return write("new.hex", ":10000000000102030405060708090A0B0C0D0E0F78\n:00000001FF\n"); }
};

TEST_F(Boards, that_answer_say_what_they_are_and_how_they_are) {
  const std::string board = serve();
  const Outcome info = passo("board info " + board);
  ASSERT_EQ(info.code, 0) << info.err;
  EXPECT_NE(info.out.find("no host has connected"), std::string::npos) << info.out;
  const auto json = nlohmann::json::parse(passo("board info --json " + board).out);
  EXPECT_EQ(json["status"]["positions"].size(), 8);
  EXPECT_EQ(json["status"]["moves"], false);

  const Outcome watched = passo("board monitor " + board + " --count 3 --every 0.01 --json");
  ASSERT_EQ(watched.code, 0) << watched.err;
  EXPECT_EQ(std::count(watched.out.begin(), watched.out.end(), '\n'), 3);
  EXPECT_EQ(nlohmann::json::parse(watched.out.substr(0, watched.out.find('\n')))["switches"].size(), 0);
}

TEST_F(Boards, are_emulated_too) {
  const Outcome info = passo("board info --json sim:uno");
  if (passo::test::lacks_an_emulator(info)) GTEST_SKIP() << info.err;
  ASSERT_EQ(info.code, 0) << info.err;
  const auto json = nlohmann::json::parse(info.out);
  EXPECT_EQ(json["about"]["highest_event_rate_hz"], 150'000) << info.out;
  EXPECT_EQ(json["status"]["positions"].size(), 8);
  const auto mega = nlohmann::json::parse(passo("board info --json sim:mega").out);
  EXPECT_EQ(mega["about"]["highest_event_rate_hz"], 110'000);

  const auto windings = nlohmann::json::parse(passo("board info --json sim:uno_half_step").out);
  EXPECT_EQ(windings["about"]["name"], "uno windings");

  const Outcome none = passo("board info sim:none");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("there are emulators of uno, uno_two_on"), std::string::npos) << none.err;
}

TEST_F(Boards, run_a_program_by_their_firmware_on_an_emulated_chip) {
  const std::string uno = (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "uno.toml").string();
  const std::string program = write("p.ngc", "G21 G90 F3000\nG1 X3 Y1\nG2 X5 Y1 I1 J0\nG1 X1 Z-1\nM2\n");
  const std::string command = "run " + program + " --json -m " + uno;
  const Outcome outcome = passo(command + " --board sim:uno");
  if (passo::test::lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["steps"], nlohmann::json::parse(passo(command).out)["steps"]);
}

TEST_F(Boards, run_a_program_with_the_windings_on_their_own_pins) {
  const std::string machine =
      (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "windings.toml").string();
  const std::string program = write("p.ngc", "G21 G90 F600\nG1 X3 Y1\nG2 X5 Y1 I1 J0\nG1 X1 Z-1\nM2\n");
  const std::string command = "run " + program + " --json -m " + machine;
  for (const std::string board : {"sim:uno_half_step", "sim:uno_wave", "sim:mega_two_on"}) {
    const Outcome outcome = passo(command + " --board " + board);
    if (passo::test::lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(outcome.out)["steps"], nlohmann::json::parse(passo(command).out)["steps"]) << board;
  }
}

// The emulated spindle turns as the board's outputs say, and its encoder is on the board's pins.
TEST_F(Boards, thread_with_an_encoder_on_their_pins_or_say_that_they_have_none) {
  std::string machine = read(std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "uno.toml");
  const std::size_t rate = machine.find("150_000");
  ASSERT_NE(rate, std::string::npos);
  machine.replace(rate, 7, "100_000");
  const std::string spindle = "[spindle]\n";
  machine.insert(machine.find(spindle) + spindle.size(), "encoder_counts_per_turn = 1024\nripple_percent = 3\n");
  const std::string program = write("p.ngc", "G21 S600 M3\nG0 Z1\nG33 Z-8 K1.5\nG0 X1\nZ1\nM5\nM2\n");
  const std::string command = "run " + program + " --json -m " + write("lathe.toml", machine);
  const Outcome outcome = passo(command + " --board sim:mega");
  if (passo::test::lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["steps"], nlohmann::json::parse(passo(command).out)["steps"]);
  const Outcome refused = passo(command + " --board sim:uno");
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("has no spindle encoder"), std::string::npos) << refused.err;
}

// What the machine file asks of a board, and the board cannot do, is refused before anything moves.
TEST_F(Boards, that_are_too_slow_or_make_too_short_pulses_are_refused_in_words) {
  const std::string uno = read(std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "uno.toml");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = uno;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return write("m.toml", text.replace(at, from.size(), to));
  };
  const std::string command = "run " + write("p.ngc", "G21 G1 F600 X1\nM2\n") + " -m ";
  // Without the key pulses last as long as the manual says: 2.5 microseconds.
  for (const char* key : {"", "step_pulse_us = 2.5"}) {
    const Outcome pulse = passo(command + with("step_pulse_us = 1.0", key) + " --board sim:uno");
    if (passo::test::lacks_an_emulator(pulse)) GTEST_SKIP() << pulse.err;
    EXPECT_EQ(pulse.code, 1);
    EXPECT_NE(pulse.err.find(" events/s with step pulses of 2.5 us and directions set 0.6875 us before a step"),
              std::string::npos)
        << pulse.err;
    EXPECT_NE(pulse.err.find("[board.event-rate]"), std::string::npos) << pulse.err;
  }
  const Outcome setup =
      passo(command + with("step_pulse_us = 1.0", "step_pulse_us = 1\ndirection_setup_us = 15") + " --board sim:uno");
  EXPECT_EQ(setup.code, 1);
  EXPECT_NE(setup.err.find("directions set 15 us before a step"), std::string::npos) << setup.err;
  std::string slower = read(with("step_pulse_us = 1.0", ""));
  slower.replace(slower.find("150_000"), 7, "100_000");
  const Outcome slow = passo(command + write("slower.toml", slower) + " --board sim:uno");
  EXPECT_EQ(slow.code, 0) << slow.err;
  const Outcome rate = passo(command + with("step_pulse_us = 1.0", "step_pulse_us = 1") + " --board sim:mega");
  EXPECT_EQ(rate.code, 1);
  EXPECT_NE(rate.err.find("it makes at most 110000 events/s, fewer than max_event_rate_hz = 150000"), std::string::npos)
      << rate.err;
}

// 67 seconds are the longest item, and an Uno holds 42: it goes on with the next refill.
TEST_F(Boards, that_hold_little_dwell_for_hours) {
  const std::string uno = (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "uno.toml").string();
  const std::string program = write("p.ngc", "G21 G90 F600\nG1 X5\nG4 P10800\nG1 X0\nM2\n");
  const Outcome outcome = passo("run " + program + " --json -m " + uno + " --cut-cable-at 99999:1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["steps"], nlohmann::json::parse(passo("run " + program + " --json -m " + uno).out)["steps"]);
}

TEST_F(Boards, probe_by_their_firmware_what_stands_on_an_emulated_machine) {
  const std::string uno = (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "uno.toml").string();
  const std::string program = write("p.ngc", "G21 G90 F300\nG38.2 Z-5\nF60 G38.4 Z0\nG0 Z1\nX[0-#5063]\nM2\n");
  const Outcome outcome = passo("run " + program + " --json -m " + uno + " --touch Z:-1.5 --board sim:uno");
  if (passo::test::lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["probes"]["touched"], 2);
  // Free again a step above the plate.
  EXPECT_DOUBLE_EQ(json["probes"]["last_contact_mm"]["Z"], -1.5 + 1.0 / 640);
  EXPECT_EQ(json["steps"]["X"]["net"], 640 * 1.5 - 1);
  // What was sent and not executed, after the contact, is in no total.
  EXPECT_NEAR(json["time_s"], json["board"]["end_s"], 0.001);
  const auto ways = [](const nlohmann::json& of) {
    const double total = of["steps"]["X"]["total"].get<double>() + of["steps"]["Z"]["total"].get<double>();
    return std::pair{of["distance_mm"]["cutting"].get<double>() + of["distance_mm"]["rapid"].get<double>(),
                     total / 640};
  };
  const std::string alone = passo("run " + program + " --json -m " + uno + " --touch Z:-1.5").out;
  const auto [way, stepped] = ways(json);
  const auto [way_alone, stepped_alone] = ways(nlohmann::json::parse(alone));
  EXPECT_NE(way, way_alone) << "over a line the way past each contact is another";
  EXPECT_NEAR(way - way_alone, stepped - stepped_alone, 0.01);
}

TEST_F(Boards, run_a_program_as_the_virtual_machine_does) {
  const std::string router =
      (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / "router.toml").string();
  const std::string program = write("p.ngc", "G21 G90 F3000\nG1 X3 Y1\nG2 X5 Y1 I1 J0\nG1 X1 Z-1\nM2\n");
  const std::string command = "run " + program + " --json -m " + router;
  const auto alone = nlohmann::json::parse(passo(command).out);
  const std::string board = serve("18000000");
  const Outcome outcome = passo(command + from_here + " --board " + board);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["steps"], alone["steps"]);
  const auto counted = nlohmann::json::parse(passo("board info --json " + board).out)["status"]["positions"];
  EXPECT_EQ(counted[0], alone["steps"]["X"]["net"]);
  EXPECT_EQ(counted[2], alone["steps"]["Z"]["net"]);
}

TEST_F(Boards, that_do_not_suit_a_machine_are_refused_with_words) {
  const std::filesystem::path machines = std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines";
  const std::string program = write("p.ngc", "G21 G1 X1 F600\nM2\n");
  const std::string board = serve("18000000");
  const Outcome clock =
      passo("run " + program + " -m " + (machines / "bench.toml").string() + from_here + " --board " + board);
  EXPECT_EQ(clock.code, 1);
  EXPECT_NE(clock.err.find("its clock has 18000000 Hz"), std::string::npos) << clock.err;
  const std::string probing = write("q.ngc", "G21 G38.2 Z-1 F60\nM2\n");
  const Outcome probe =
      passo("run " + probing + " -m " + (machines / "router.toml").string() + " --touch Z:-0.5 --board " + board);
  EXPECT_EQ(probe.code, 2);
  EXPECT_NE(probe.err.find("--touch is only for the simulated machine"), std::string::npos) << probe.err;
}

TEST_F(Boards, that_are_not_there_are_said_to_be_missing) {
  EXPECT_EQ(passo("board info tcp:127.0.0.1:1").code, 1);
  const Outcome nonsense = passo("board info nonsense");
  EXPECT_EQ(nonsense.code, 2);
  EXPECT_NE(nonsense.err.find("expected virtual, serial:DEVICE"), std::string::npos) << nonsense.err;
  const Outcome list = passo("board list /dev/null --json");
  EXPECT_EQ(list.code, 0);
  EXPECT_NE(list.out.find("not a serial port"), std::string::npos) << list.out;
}

// Opening the port would restart an Arduino, also under another program's job.
TEST_F(Boards, are_listed_without_opening_their_ports) {
  const passo::test::SystemFiles files(path("system"));
  files.plug_in("ttyACM0", {.bus = "1-2", .vendor = "2341", .product = "0043", .product_name = "Arduino Uno"});
  files.name_lastingly("ttyACM0", "usb-Arduino_Uno-if00");
  files.plug_in("ttyUSB0", {.bus = "1-3", .vendor = "1a86", .product = "7523", .product_name = "USB Serial"});
  files.begin(4711, "cncjs", "ttyUSB0");
  const std::string list = "board list --system " + path("system");
  const Outcome listed = passo(list);
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_NE(listed.out.find("dev/serial/by-id/usb-Arduino_Uno-if00\n"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("2341:0043 Arduino Uno\n  state   no program is known"), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find("in use by cncjs (process 4711)"), std::string::npos) << listed.out;
  EXPECT_EQ(listed.out.find("not a serial port"), std::string::npos) << "a port was opened: " << listed.out;
  EXPECT_NE(listed.err.find("no port was opened"), std::string::npos) << listed.err;

  const auto json = nlohmann::json::parse(passo(list + " --ask --json").out);
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["usb"]["vendor"], "2341");
  EXPECT_NE(json[0]["says"].get<std::string>().find("not a serial port"), std::string::npos) << json;
  EXPECT_EQ(json[1]["users"][0]["program"], "cncjs");
  EXPECT_FALSE(json[1].contains("says")) << "a port that is in use was opened: " << json;
  const Outcome busy = passo(list + " " + files.path("dev/ttyUSB0"));
  EXPECT_NE(busy.out.find("in use by cncjs"), std::string::npos) << busy.out;
  EXPECT_EQ(busy.out.find("not a serial port"), std::string::npos) << busy.out;
}

TEST_F(Boards, of_a_computer_without_ports_are_none) {
  const passo::test::SystemFiles files(path("system"));
  const Outcome listed = passo("board list --system " + path("system"));
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_EQ(listed.out, "No USB serial port found.\n");
  EXPECT_EQ(passo("board list --json --system " + path("system")).out, "[]\n");
  EXPECT_EQ(passo("board list --system " + path("nowhere")).code, 2);
}

// Six motors of a Mega, faster than 90 kHz.
TEST_F(Boards, that_stand_still_amid_motion_are_told_of) {
  std::string machine =
      "name = 'six'\n[board]\nclock_hz = 16e6\nmax_event_rate_hz = 110e3\nstep_pulse_us = 1\nheld_items = 100\n";
  for (const std::string letter : {"X", "Y", "Z", "U", "V", "W"}) {
    machine += "[axis." + letter +
               "]\nsteps_per_mm = 640\nmax_velocity_mm_s = 171.8\nmax_acceleration_mm_s2 = 2000\ntravel_mm = [0, 99]\n";
  }
  const std::string files =
      write("p.ngc", "G21 G90\nG0 X80 Y79 Z78 U77 V76 W75\nM2\n") + " -m " + write("m.toml", machine);
  const Outcome run = passo("run --json --from-here --board sim:mega " + files);
  if (passo::test::lacks_an_emulator(run)) GTEST_SKIP() << run.err;
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.err.find("it stalled during motion in line 2"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("[board.slipped]"), std::string::npos) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["board"]["stood_still"], true) << run.out;
  EXPECT_EQ(json["board"]["stood_still_line"], 2) << run.out;
  const Outcome slow = passo("run --from-here --board sim:uno " + write("q.ngc", "G21 F600 G1 X0.5\nM2\n") +
                             " -m " PASSO_SOURCE_DIR "/examples/machines/uno.toml");
  EXPECT_EQ(slow.err.find("stopped during motion"), std::string::npos) << slow.err;
}

// A rapid of one axis at the Uno's highest rate: hundreds of standstills at first.
TEST_F(Boards, never_stand_still_in_a_long_rapid_at_their_highest_rate) {
  const std::string cases = PASSO_SOURCE_DIR "/../shared/cases/boards/uno150";
  if (!std::filesystem::exists(cases + ".ngc")) GTEST_SKIP() << "there is no ../shared/cases";
  const Outcome run = passo("run --json --from-here --board sim:uno " + cases + ".ngc -m " + cases + ".toml");
  if (passo::test::lacks_an_emulator(run)) GTEST_SKIP() << run.err;
  if (run.code == 0) {
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["board"]["stood_still"], false) << run.out;
    EXPECT_EQ(json["board"]["rests"], 0) << run.out;
  } else {
    EXPECT_NE(run.err.find("[board.event-rate]"), std::string::npos) << run.err;
  }
}

TEST_F(Boards, are_flashed_by_avrdude_after_what_they_held_was_kept) {
  const Outcome outcome =
      passo("board flash uno -d /dev/x --backup " + path("old.hex") + " --image " + image(), fake_avrdude());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string common = "-p atmega328p -c arduino -P /dev/x -b 115200 -D -U flash:";
  EXPECT_EQ(read(path("calls")), common + "r:" + path("old.hex") + ":i\n" + common + "w:" + path("new.hex") + ":i\n");
  EXPECT_NE(outcome.out.find("To restore the old firmware: avrdude"), std::string::npos);
  // A second attempt would keep our own program as what was there before.
  const Outcome again =
      passo("board flash uno -d /dev/x --backup " + path("old.hex") + " --image " + image(), fake_avrdude());
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("already exists"), std::string::npos);
}

TEST_F(Boards, are_not_touched_when_the_first_look_fails_or_when_it_is_only_tried) {
  const std::string flash = "board flash mega -d /dev/x --backup " + path("old.hex") + " --image ";
  const Outcome failed = passo(flash + image(), fake_avrdude(1));
  EXPECT_EQ(failed.code, 1);
  EXPECT_NE(failed.err.find("is unchanged"), std::string::npos) << failed.err;
  EXPECT_FALSE(std::filesystem::exists(path("old.hex"))) << "what failed is no way back";
  std::filesystem::remove(path("calls"));
  EXPECT_EQ(passo(flash + image() + " --dry-run", fake_avrdude()).code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("calls")));
}

// What was kept before the write that failed stays, and is not read again: the board's firmware may be incomplete by
// now.
TEST_F(Boards, are_flashed_again_after_a_write_that_failed) {
  const std::string flash = "board flash uno -d /dev/x --backup " + path("old.hex") + " --image " + image();
  for (int i = 0; i < 2; ++i) {
    const Outcome failed = passo(flash, fake_avrdude(0, 1));
    EXPECT_EQ(failed.code, 1);
    EXPECT_NE(failed.err.find("firmware may be incomplete. Repeat the command"), std::string::npos) << failed.err;
    EXPECT_NE(failed.err.find("is kept in " + path("old.hex")), std::string::npos) << failed.err;
    write("old.hex", "what it held");
  }
  std::filesystem::remove(path("calls"));
  const Outcome again = passo(flash, fake_avrdude());
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read(path("old.hex")), "what it held");
  EXPECT_EQ(read(path("calls")).find("flash:r"), std::string::npos);
  EXPECT_NE(again.out.find("To restore the old firmware: avrdude"), std::string::npos);
  // Done is done: from now on the file is the way back, and another flash may not overwrite it.
  const Outcome later = passo(flash, fake_avrdude());
  EXPECT_EQ(later.code, 2);
  EXPECT_NE(later.err.find("already exists"), std::string::npos) << later.err;
}

TEST_F(Boards, are_given_no_image_that_is_damaged_or_too_large) {
  const std::string flash = "board flash uno -d /dev/x --dry-run --image ";
  const Outcome damaged = passo(flash + write("a.hex", ":10000000000102030405060708090A0B0C0D0E0F79\n:00000001FF\n"));
  EXPECT_EQ(damaged.code, 2);
  EXPECT_NE(damaged.err.find("a.hex:1: not a record"), std::string::npos) << damaged.err;
  const Outcome cut = passo(flash + write("b.hex", ":10000000000102030405060708090A0B0C0D0E0F78\n"));
  EXPECT_NE(cut.err.find("has no end record"), std::string::npos) << cut.err;
  const Outcome large = passo(flash + write("c.hex", ":017E00000081\n:00000001FF\n"));
  EXPECT_EQ(large.code, 2);
  EXPECT_NE(large.err.find("has room for 32256"), std::string::npos) << large.err;
}

// A UF2 file of one block.
std::string uf2_block(std::uint32_t family = 0xe48bff56) {
  std::string block(512, 'x');
  const auto put = [&block](std::size_t at, std::uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) block[at + i] = static_cast<char>(value >> 8 * i);
  };
  const std::uint32_t head[] = {0x0a324655, 0x9e5d5157, 0x2000, 0x10000000, 256, 0, 1, family};
  for (std::size_t word = 0; word < 8; ++word) put(4 * word, head[word]);
  put(508, 0x0ab16f30);
  return block;
}

TEST_F(Boards, that_show_themselves_as_a_drive_are_flashed_by_copying) {
  std::filesystem::create_directories(path("drive"));
  const std::string flash = "board flash pico -d " + path("drive") + " --image ";
  const std::string image = write("new.uf2", uf2_block());
  const Outcome other = passo(flash + image);
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("is not the drive of a Pico"), std::string::npos) << other.err;
  EXPECT_FALSE(std::filesystem::exists(path("drive/passo.uf2")));

  write("drive/INFO_UF2.TXT", "UF2 Bootloader v3.0\nModel: Raspberry Pi RP2\nBoard-ID: RPI-RP2\n");
  EXPECT_EQ(passo(flash + image + " --dry-run").code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("drive/passo.uf2")));
  const Outcome done = passo(flash + image);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(read(path("drive/passo.uf2")), uf2_block());
}

TEST_F(Boards, that_show_themselves_as_a_drive_get_no_file_for_another_chip) {
  const std::string flash = "board flash pico -d " + path("drive") + " --image ";
  const Outcome other = passo(flash + write("other.uf2", uf2_block(0xe48bff59)));
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("is not for the RP2040"), std::string::npos) << other.err;
  const Outcome cut = passo(flash + write("cut.uf2", uf2_block().substr(0, 500)));
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.err.find("this is not a UF2 file, or it is truncated"), std::string::npos) << cut.err;
}

}  // namespace
