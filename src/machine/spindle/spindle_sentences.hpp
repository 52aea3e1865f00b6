// The faults of a spindle on a bus, for people. The page has the same codes. Private to spindle/.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::spindle_says {

inline constexpr SentenceRow no_answer{"spindle.no-answer",
                                       "the spindle's drive at {device}, address {address}, does not answer"};
inline constexpr SentenceRow bad_answer{"spindle.bad-answer",
                                        "the replies of the spindle's drive at {device} are damaged: {why}"};
inline constexpr SentenceRow port{"spindle.port", "the serial port {device} of the spindle's drive failed: {why}"};
inline constexpr SentenceRow refused{"spindle.refused",
                                     "the spindle's drive refuses commands (Modbus exception {number})"};
inline constexpr SentenceRow drive_fault{"spindle.drive-fault", "the spindle's drive reports fault {number}: {text}"};
inline constexpr SentenceRow not_reached{
    "spindle.not-reached", "the spindle did not reach {wanted} rpm in {time} s: its drive reports {rpm} rpm"};
inline constexpr SentenceRow slowed{"spindle.slowed",
                                    "the spindle slowed down from {wanted} to {rpm} rpm: its drive shows the reason"};
inline constexpr SentenceRow no_reverse{"spindle.no-reverse", "the spindle's drive has no command for reverse (M4)"};

}  // namespace passo::spindle_says
