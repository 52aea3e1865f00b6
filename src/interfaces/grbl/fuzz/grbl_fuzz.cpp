// Any bytes of a sender, on a Grbl controller around a session on a virtual machine: each line has at most one answer,
// replies are whole lines of ASCII, and a reset brings the machine to rest and greets.
//
// The first byte chooses how the machine begins. Bytes of 0xF8 and above, which mean nothing to grbl, let time pass.
#include <cstdint>
#include <string>

#include "kit/fuzzed_machine.hpp"

#include "passo/grbl/grbl_controller.hpp"

namespace passo::test {
namespace {

constexpr Seconds one_turn{0.005};
constexpr Seconds longest_play{20};  // of an input, on the machine's clock
constexpr Seconds longest_reset{60};

InterpreterOptions grbl_options() {
  InterpreterOptions options;
  options.dialect = Dialect::grbl;
  return options;
}

class Bench {
 public:
  explicit Bench(Trust trust) : world_(trust) {
    grbl_.keep_settings(fuzzed_machine_text, [](const std::string&, const std::string&) { return true; });
    grbl_.connect();
  }

  void take(std::uint8_t byte) {
    if (byte == '\n' || byte == '\r') ++line_ends_;
    const char c = static_cast<char>(byte);
    grbl_.receive({&c, 1});
    poll(Seconds(0));
  }
  void pass(Seconds time) {
    for (const Seconds end = session_.now() + time; session_.now() < end && session_.now() < longest_play;) {
      poll(one_turn);
    }
  }
  void come_to_rest() {
    greeted_ = false;
    take(0x18);
    const Seconds end = session_.now() + longest_reset;
    while (!greeted_ && session_.now() < end) poll(one_turn);
    require(greeted_, "a reset does not greet");
    // Start lines may move the machine again.
    pass(Seconds(1));
  }

 private:
  void poll(Seconds most) {
    session_.poll(most);
    grbl_.poll(session_.take_changes());
    for (const std::string& text : grbl_.take_replies()) look(text);
    require(answers_ <= line_ends_, "more answers than lines");
  }
  void look(const std::string& text) {
    require(text.ends_with("\r\n"), "a reply that is not whole lines");
    for (const char c : text) require(c == '\r' || c == '\n' || (c >= ' ' && c <= '~'), "a reply that is not ASCII");
    if (text.starts_with("ok") || text.starts_with("error:")) ++answers_;
    greeted_ = greeted_ || text.find("Grbl 1.1") != std::string::npos;
  }

  FuzzedSession world_;
  MachineSession& session_ = world_.session;
  StreamedProgram program_{fuzzed_machine(), grbl_options(), Point()};
  GrblController grbl_{fuzzed_machine(), session_, program_};
  std::size_t line_ends_ = 0;
  std::size_t answers_ = 0;
  bool greeted_ = false;
};

}  // namespace
}  // namespace passo::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  using passo::test::Bench;
  Bench bench(data[0] % 2 == 0 ? passo::Trust::commanded : passo::Trust::unknown);
  constexpr std::uint8_t first_pause = 0xF8;
  for (std::size_t i = 1; i < size; ++i) {
    if (data[i] < first_pause) {
      bench.take(data[i]);
    } else {
      bench.pass(passo::test::one_turn * static_cast<double>(1U << (data[i] - first_pause)));
    }
  }
  bench.come_to_rest();
  return 0;
}
