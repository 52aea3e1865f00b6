// SmallJobsApi: jobs whose programs are made on request: framing a job, going to a known place, and macros. They are
// checked and run by the JobRunner like any other program. Private to api/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"
#include "pressed_buttons.hpp"

#include "passo/macro/macro.hpp"

namespace passo {

class SmallJobsApi {
 public:
  // Both must outlive this object.
  SmallJobsApi(const ApiShared& shared, JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer frame(const ApiCall& call);
  WebAnswer go_to(const ApiCall& call);
  WebAnswer list_macros(const ApiCall& call);
  WebAnswer run_macro(const ApiCall& call);
  // Starts the macro of a button of the board.
  void poll();

 private:
  static constexpr Seconds between_looks{0.01};

  WebAnswer go_to_cross_hair();
  void start_macro_of(std::string_view input);
  WebAnswer run(const Macro& macro, const MacroValues& values);

  // Why the machine cannot begin a small job now. Empty: it can.
  std::optional<WebAnswer> refuse() const;
  WebAnswer run(std::string name, std::string text);
  // The macros of the folder as it is now; while something moves, as they were.
  const MacroFolder& macros();

  const ApiShared& shared_;
  JobRunner& jobs_;
  std::uint64_t last_ = 0;  // the program of the last small job; the next one replaces it
  MacroFolder macros_;
  bool has_read_macros_ = false;
  PressedButtons buttons_;
  Seconds looked_at_{0};
  std::string refused_macro_;  // that a button could not start; empty: none
  Json refusal_;               // the error
};

}  // namespace passo
