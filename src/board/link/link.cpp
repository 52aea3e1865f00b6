#include "passo/link/link.hpp"

namespace passo {

std::string_view code_of(LinkError error) {
  switch (error) {
    case LinkError::no_answer: return "link.no-answer";
    case LinkError::no_progress: return "link.no-progress";
    case LinkError::wrong_version: return "link.wrong-version";
    case LinkError::too_few_motors: return "link.too-few-motors";
    case LinkError::cannot_set_up: return "link.cannot-set-up";
    case LinkError::cannot_time: return "link.cannot-time";
    case LinkError::cannot_watch: return "link.cannot-watch";
    case LinkError::refused: return "link.refused";
    case LinkError::was_reset: return "link.was-reset";
    case LinkError::stopped: return "link.stopped";
    case LinkError::drivers_off: return "link.drivers-off";
    case LinkError::stood_still: return "link.stood-still";
    case LinkError::too_few_places: return "link.too-few-places";
    case LinkError::manual: return "link.manual";
    case LinkError::no_encoder: return "link.no-encoder";
    case LinkError::spindle_stands: return "link.spindle-stands";
    case LinkError::encoder_wrong: return "link.encoder-wrong";
    case LinkError::thread_lost: return "link.thread-lost";
    case LinkError::thread_outrun: return "link.thread-outrun";
  }
  return "link";
}

std::string_view message_of(LinkError error) {
  switch (error) {
    case LinkError::no_answer: return "the board does not answer";
    case LinkError::no_progress:
      return "something talks on the line, but does not do what it is told: it is no board of Passo's, or the line "
             "returns "
             "what is sent";
    case LinkError::wrong_version:
      return "the board speaks another version of the protocol: its firmware and passo must be of one version";
    case LinkError::too_few_motors: return "the board has fewer motors than the machine";
    case LinkError::cannot_set_up: return "the board cannot do what [inputs] and [outputs] of the machine file say";
    case LinkError::cannot_time: return "the board does not time its steps as the drivers need it";
    case LinkError::cannot_watch:
      return "the board cannot watch these limit switches at once: their pins are on several ports (docs/boards.md)";
    case LinkError::refused: return "the board refused what was sent to it";
    case LinkError::was_reset: return "the board was reset, and does not know any more where the motors are";
    case LinkError::stopped: return "the board has stopped its motors at once, and where they are is not certain";
    case LinkError::drivers_off:
      return "the board did not hear this computer for drivers_off_after_s and has switched the drivers off: the axes "
             "may have moved";
    case LinkError::stood_still:
      return "the board stood still amid motion, because it could not make its events in time: a motor that is stopped "
             "so suddenly may have lost steps";
    case LinkError::too_few_places: return "the board cannot hold as much as it takes to bring the machine to rest";
    case LinkError::manual:
      return "the board was put into manual mode by its keypad: leave it there by *, and start again";
    case LinkError::no_encoder:
      return "the program follows the spindle, and the board has no encoder: it needs other firmware, or [spindle] of "
             "the machine file is not this machine's";
    case LinkError::spindle_stands:
      return "the spindle does not turn, or its encoder does not count: nothing can follow it";
    case LinkError::encoder_wrong:
      return "the spindle's encoder does not count encoder_counts_per_turn from index to index, or there is no index";
    case LinkError::thread_lost:
      return "the line was broken in a thread, or too slow for it: the machine has come to rest on the path, spindle "
             "off, and the thread cannot go on there";
    case LinkError::thread_outrun:
      return "the spindle turned faster in a thread than the axes can follow: the machine has come to rest on the "
             "path, spindle off, and the thread cannot go on; S, its override or the pitch is too high";
  }
  return "the link to the board failed";
}

}  // namespace passo
