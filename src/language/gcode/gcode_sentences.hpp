// The sentences of what is found in the text of a program. A row is a stable code, by which clients translate
// it, and the English text. The page has the same codes (page/src/lang/LANGUAGE/findings.ts). A test compares the two.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::gcode_says {

inline constexpr SentenceRow bracket_open{"gcode.unclosed-bracket", "the bracket that opens here is not closed"};
inline constexpr SentenceRow comment_open{"gcode.unclosed-comment", "the comment that starts here is not closed"};
inline constexpr SentenceRow close_on_line{"expected.comment-closed", "')' on the same line"};
inline constexpr SentenceRow comment_in_comment{"gcode.nested-comment", "a comment inside a comment"};
inline constexpr SentenceRow lone_number{"gcode.unexpected-text.number", "a number without a letter before it"};
inline constexpr SentenceRow letter_and_value{"expected.letter-and-value", "a letter with a value, as in X12.5"};
inline constexpr SentenceRow no_meaning{"gcode.bad-character", "{what} has no meaning in G-code"};
inline constexpr SentenceRow not_a_word{"gcode.unexpected-text.word", "{what} where a word should start"};
inline constexpr SentenceRow not_a_value{"gcode.missing-value.character", "{what} where a value should be"};
inline constexpr SentenceRow no_value{"gcode.missing-value", "{what} has no value"};
inline constexpr SentenceRow comma{"gcode.bad-character.comma", "',' in a number"};
inline constexpr SentenceRow decimal_point{"expected.decimal-point", "a decimal point"};
inline constexpr SentenceRow second_point{"gcode.unexpected-text.point", "a second decimal point in a number"};
inline constexpr SentenceRow one_point{"expected.one-decimal-point", "one decimal point"};
inline constexpr SentenceRow second_line_number{"gcode.repeated-word.line-number", "a second {letter} in one block"};
inline constexpr SentenceRow no_function{"gcode.unknown-function", "there is no function {name}"};
inline constexpr SentenceRow fanuc_word{"gcode.fanuc-macro", "{name} belongs to Fanuc's macro language"};
inline constexpr SentenceRow for_while{"expected.fanuc-while",
                                       "o1 while [...] on one line, and o1 endwhile instead of END"};
inline constexpr SentenceRow for_goto{"expected.fanuc-goto",
                                      "o1 if [...] and o1 endif around the lines to skip, because there is no GOTO"};
inline constexpr SentenceRow for_then{"expected.fanuc-then",
                                      "o1 if [...], the assignment on the next line, and o1 endif"};
inline constexpr SentenceRow for_end{"expected.fanuc-end", "o1 endwhile, with the label of its o1 while"};
inline constexpr SentenceRow for_if{"expected.fanuc-if",
                                    "o1 if [...] on one line, and o1 endif after the last conditional line"};
inline constexpr SentenceRow letter_o{"expected.o-for-colon",
                                      "O instead of ':', as in O0491; on some controls ':' starts a program number"};
inline constexpr SentenceRow empty_file{"file.empty", "the file is empty"};
inline constexpr SentenceRow gcode_file{"expected.gcode", "G-code"};
inline constexpr SentenceRow not_gcode{"file.not-gcode", "this is {what}, not G-code"};
inline constexpr SentenceRow for_a_printer{"file.not-gcode.printer", "this is a program for a 3D printer, not G-code"};
inline constexpr SentenceRow from_cam{
    "expected.gcode-that-cuts", "G-code for a cutting machine, from a CAM program; Passo has no heaters or extruders"};
inline constexpr SentenceRow not_text{"file.binary", "the file is not text"};
inline constexpr SentenceRow plain_text{"expected.plain-text", "a G-code program, which is plain text"};

}  // namespace passo::gcode_says
