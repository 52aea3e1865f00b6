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
      return "something answers on the link, but not as a Passo board does: it is another device, or the link echoes "
             "what is sent";
    case LinkError::wrong_version:
      return "the board uses another protocol version: firmware and passo must have the same version";
    case LinkError::too_few_motors: return "the board has fewer motors than the machine";
    case LinkError::cannot_set_up:
      return "the board does not support what [inputs] and [outputs] of the machine file require";
    case LinkError::cannot_time: return "the board's step timing does not meet the drivers' requirements";
    case LinkError::cannot_watch:
      return "the board cannot watch these limit switches at the same time: their pins are on several ports "
             "(docs/boards.md)";
    case LinkError::refused: return "the board rejected a message";
    case LinkError::was_reset: return "the board was reset, so the motor positions are unknown";
    case LinkError::stopped:
      return "the board stopped its motors instantly; steps may be lost, so the position is unreliable";
    case LinkError::drivers_off:
      return "the board received nothing from this computer for drivers_off_after_s and disabled the drivers: the axes "
             "may have moved";
    case LinkError::stood_still:
      return "the board stalled during motion, because it could not compute events in time; steps may be lost";
    case LinkError::too_few_places: return "the board's queue is too small for a stop ramp";
    case LinkError::manual: return "the board is in manual mode (keypad): press * there, and start again";
    case LinkError::no_encoder:
      return "the program follows the spindle, but the board has no encoder: use other firmware, or correct [spindle] "
             "in the machine file";
    case LinkError::spindle_stands:
      return "the spindle does not turn, or its encoder does not count, so no thread can follow it";
    case LinkError::encoder_wrong:
      return "the spindle encoder has no index, or the counts between index pulses differ from encoder_counts_per_turn";
    case LinkError::thread_lost:
      return "the link failed or was too slow during a thread: the machine stopped on the path with the spindle off, "
             "and the thread cannot continue";
    case LinkError::thread_outrun:
      return "the spindle turned faster than the axes can follow in a thread: the machine stopped on the path, spindle "
             "off; lower S, its override or the pitch";
  }
  return "the link to the board failed";
}

}  // namespace passo
